// The trees, the marks, and the searches for what is marked; see tree_pairs.h.
//
// A pair of two marked ids is told once: an endless box tells what it meets in the trees, what
// moves tells what stands still, and within a tree the place in it decides. All marked leaves of a
// node go down a tree together, since siblings are near each other and most of the way is the same.

#include "broad/tree_pairs.h"

#include <algorithm>

#include "broad/sort_pairs.h"

namespace cairn {

namespace {

// Beyond this a box counts as endless: the squares of its sides, summed up for eight boxes, would
// come near the largest number.
constexpr float most_reach = 1e18f;

bool is_endless(const Aabb& box) {
    const float reach = most_reach;
    return !contains({{-reach, -reach, -reach}, {reach, reach, reach}}, box);
}

Pair make_sorted(std::uint32_t a, std::uint32_t b) { return a < b ? Pair{a, b} : Pair{b, a}; }

}  // namespace

bool TreePairs::is_valid(const Aabb& box) {
    return box.lower.x <= box.upper.x && box.lower.y <= box.upper.y && box.lower.z <= box.upper.z;
}

bool TreePairs::make_pair(std::uint32_t a, std::uint32_t b) const {
    return a != b && is_there(a) && is_there(b) && (moves(a) || moves(b)) && overlap(a, b);
}

void TreePairs::mark(std::uint32_t id) {
    states_[id] |= marked;
    if (states_[id] & listed) return;
    states_[id] |= listed;
    marked_.push_back(id);
}

void TreePairs::add(std::uint32_t id, const Aabb& box, bool moves, bool to_tree) {
    boxes_[id] = box;
    states_[id] |= std::uint8_t(there | (moves ? moving : 0));
    if (is_endless(box)) {
        states_[id] |= endless;
        endless_[moves].push_back(id);
    } else if (to_tree) {
        trees_[moves].insert(id, box);
    }
    mark(id);
}

void TreePairs::take_out(std::uint32_t id) {
    const bool moves = (states_[id] & moving) != 0;
    if (states_[id] & endless) {
        std::vector<std::uint32_t>& list = endless_[moves];
        *std::find(list.begin(), list.end(), id) = list.back();
        list.pop_back();
    } else {
        trees_[moves].remove(id);
    }
    // What is listed stays in the list until the next search, there or not.
    states_[id] &= listed;
}

void TreePairs::make_room(std::uint32_t end) {
    if (end <= states_.size()) return;
    reserve_sparingly(states_, end);
    reserve_sparingly(boxes_, end);
    states_.resize(end, 0);
    boxes_.resize(end);
}

bool TreePairs::insert(std::uint32_t id, const Aabb& fat, bool moves) {
    if (!is_valid(fat) || is_there(id)) return false;
    make_room(id + 1);
    add(id, fat, moves, true);
    return true;
}

bool TreePairs::insert_many(std::span<const Proxy> proxies) {
    std::uint32_t end = 0;
    for (const Proxy& proxy : proxies) end = std::max(end, proxy.id + 1);
    make_room(end);
    marked_.reserve(marked_.size() + proxies.size());

    bool all_valid = true;
    LargeArray<std::uint32_t> ids[2];
    for (const Proxy& proxy : proxies) {
        if (!is_valid(proxy.box) || is_there(proxy.id)) {
            all_valid = false;
            continue;
        }
        add(proxy.id, proxy.box, proxy.moves, false);
        if (!(states_[proxy.id] & endless)) ids[proxy.moves].push_back(proxy.id);
    }
    for (const bool moves : {false, true}) build_or_insert(moves, ids[moves]);
    return all_valid;
}

void TreePairs::build_or_insert(bool moves, std::span<const std::uint32_t> ids) {
    BoxTree& tree = trees_[moves];
    if (ids.size() <= tree.size()) {
        for (const std::uint32_t id : ids) tree.insert(id, boxes_[id]);
        return;
    }
    LargeArray<std::uint32_t> all;
    all.reserve(tree.size() + ids.size());
    tree.list_leaves(all);
    all.insert(all.end(), ids.begin(), ids.end());
    tree.build(all, boxes_);
}

void TreePairs::remove(std::uint32_t id) {
    if (is_there(id)) take_out(id);
}

void TreePairs::set_moves(std::uint32_t id, bool moves) {
    if (!is_there(id) || this->moves(id) == moves) return;
    take_out(id);
    add(id, boxes_[id], moves, true);
}

bool TreePairs::update(std::uint32_t id, const Aabb& tight, const Aabb& fat) {
    if (!is_there(id) || contains(boxes_[id], tight) || !is_valid(fat)) return false;
    const bool moves = (states_[id] & moving) != 0;
    if ((states_[id] & endless) || is_endless(fat)) {
        take_out(id);
        add(id, fat, moves, true);
        return true;
    }
    boxes_[id] = fat;
    trees_[moves].move(id, fat);
    mark(id);
    return true;
}

std::size_t TreePairs::prepare_search() {
    for (BoxTree& tree : trees_) tree.settle(boxes_);
    searches_.clear();
    for (const std::uint32_t id : marked_) {
        states_[id] &= std::uint8_t(~listed);
        if (!(states_[id] & marked)) continue;
        const bool moves = (states_[id] & moving) != 0;
        if (states_[id] & endless) {
            searches_.push_back({id, true, moves});
        } else if (const std::uint32_t node = trees_[moves].mark(id); node != BoxTree::none) {
            searches_.push_back({node, false, moves});
        }
    }
    // In the order of the trees, whose nodes are near each other in memory where they are in space.
    std::sort(searches_.begin(), searches_.end(),
              [](const Search& a, const Search& b) { return a.index < b.index; });
    return searches_.size();
}

void TreePairs::search(std::size_t begin, std::size_t end, LargeArray<Pair>& pairs) const {
    for (std::size_t i = begin; i < end; ++i) {
        const Search& sought = searches_[i];
        if (sought.is_endless) {
            search_endless(sought.index, pairs);
        } else {
            search_node(trees_[sought.moves].node(sought.index), sought.moves, pairs);
        }
    }
}

void TreePairs::search_node(const BoxNode& node, bool moves, LargeArray<Pair>& pairs) const {
    using Marked = BoxTree::Marked;
    const auto meet = [&](std::uint32_t a, std::uint32_t b) { pairs.push_back(make_sorted(a, b)); };
    if (moves) trees_[false].meet(node, Marked::All, meet);
    trees_[true].meet(node, moves ? Marked::OnlyOneWay : Marked::None, meet);

    for (const bool others_move : {false, true}) {
        if (!moves && !others_move) continue;
        for (const std::uint32_t other : endless_[others_move]) {
            if (states_[other] & marked) continue;
            std::uint32_t hits = node.marks & find_overlaps(node, clamp_to_finite(boxes_[other]));
            for (; hits != 0; hits &= hits - 1) meet(node.child[std::countr_zero(hits)], other);
        }
    }
}

void TreePairs::search_endless(std::uint32_t id, LargeArray<Pair>& pairs) const {
    const Aabb& box = boxes_[id];
    const auto meet = [&](std::uint32_t other) { pairs.push_back(make_sorted(id, other)); };
    for (const bool others_move : {false, true}) {
        if (!moves(id) && !others_move) continue;
        trees_[others_move].query(box, meet);
        for (const std::uint32_t other : endless_[others_move]) {
            if ((states_[other] & marked) && other <= id) continue;
            if (overlaps(boxes_[other], box)) meet(other);
        }
    }
}

void TreePairs::finish_search(LargeArray<Pair>& pairs) {
    sort_pairs(pairs, sorting_);
    for (const Search& sought : searches_) {
        if (!sought.is_endless) trees_[sought.moves].unmark_node(sought.index);
    }
    searches_.clear();
    for (const std::uint32_t id : marked_) states_[id] &= std::uint8_t(~marked);
    forget(marked_);
}

void TreePairs::find_new_pairs(LargeArray<Pair>& pairs) {
    pairs.clear();
    const std::size_t count = prepare_search();
    search(0, count, pairs);
    finish_search(pairs);
}

bool TreePairs::is_sound() const {
    for (std::uint32_t id = 0; id < states_.size(); ++id) {
        if (!is_there(id)) continue;
        const bool in_list = std::count(endless_[moves(id)].begin(), endless_[moves(id)].end(), id);
        if (in_list != ((states_[id] & endless) != 0)) return false;
    }
    return trees_[0].is_sound() && trees_[1].is_sound();
}

std::size_t TreePairs::byte_count() const {
    return sizeof(*this) + trees_[0].byte_count() + trees_[1].byte_count() +
           boxes_.capacity() * sizeof(Aabb) + states_.capacity() +
           (endless_[0].capacity() + endless_[1].capacity() + marked_.capacity()) *
               sizeof(std::uint32_t) +
           searches_.capacity() * sizeof(Search) + sorting_.capacity() * sizeof(Pair);
}

}  // namespace cairn

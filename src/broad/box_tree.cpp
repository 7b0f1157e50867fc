// Leaves in, out and elsewhere, one at a time; see box_tree.h. box_tree_build.cpp has what is done
// to many at once.

#include "broad/box_tree.h"

namespace cairn {

namespace {

constexpr int width = BoxNode::width;

// Where nine entries are best cut in two: the order of them, and how many come first.
struct Cut {
    int order[width + 1];
    int first_count = 0;
};

void sort_along(const BoxTree::Entry (&entries)[width + 1], int axis, int (&order)[width + 1]) {
    float keys[width + 1];
    for (int i = 0; i <= width; ++i) {
        const Aabb& box = entries[i].box;
        const float key = component(box.lower, axis) + component(box.upper, axis);
        // Few and often nearly sorted: by insertion, equal keys in the order they came.
        int at = i;
        for (; at > 0 && key < keys[at - 1]; --at) {
            keys[at] = keys[at - 1];
            order[at] = order[at - 1];
        }
        keys[at] = key;
        order[at] = i;
    }
}

// Least size of both parts, each counted as often as it has entries.
Cut find_cut(const BoxTree::Entry (&entries)[width + 1], int min_count) {
    Cut best;
    float best_cost = BoxNode::infinite;
    for (int axis = 0; axis < 3; ++axis) {
        int order[width + 1];
        sort_along(entries, axis, order);
        float size_from[width + 1];
        Aabb box = entries[order[width]].box;
        for (int i = width; i > 0; --i) {
            box = unite(box, entries[order[i]].box);
            size_from[i] = measure(box);
        }
        box = entries[order[0]].box;
        for (int count = 1; count <= width + 1 - min_count; ++count) {
            box = unite(box, entries[order[count - 1]].box);
            const float cost =
                float(count) * measure(box) + float(width + 1 - count) * size_from[count];
            // Always the first of the cuts that cost alike; not even infinite costs leave none.
            if (count < min_count || (cost >= best_cost && best.first_count != 0)) continue;
            best_cost = cost;
            best.first_count = count;
            for (int i = 0; i <= width; ++i) best.order[i] = order[i];
        }
    }
    return best;
}

}  // namespace

std::uint32_t BoxTree::add_node(int level) {
    std::uint32_t index = free_;
    if (index == none) {
        index = std::uint32_t(nodes_.size());
        reserve_sparingly(nodes_, nodes_.size() + 1);
        nodes_.emplace_back();
    } else {
        free_ = nodes_[index].parent;
    }
    BoxNode& node = nodes_[index];
    node = BoxNode{};
    node.level = std::uint8_t(level);
    for (int i = 0; i < width; ++i) clear_slot(node, i);
    return index;
}

void BoxTree::free_node(std::uint32_t node) {
    nodes_[node].is_free = true;
    nodes_[node].dirty = false;
    nodes_[node].parent = free_;
    free_ = node;
}

void BoxTree::free_all() {
    nodes_.clear();
    dirty_.clear();
    root_ = free_ = none;
    size_ = worn_ = 0;
}

void BoxTree::put(std::uint32_t node, int slot, const Entry& entry) {
    set_slot_box(nodes_[node], slot, entry.box);
    nodes_[node].child[slot] = entry.ref;
    if (nodes_[node].level == 0) {
        places_[entry.ref] = std::uint32_t(width) * node + std::uint32_t(slot);
    } else {
        nodes_[entry.ref].parent = node;
        nodes_[entry.ref].slot = std::uint8_t(slot);
    }
}

void BoxTree::append(std::uint32_t node, const Entry& entry) {
    put(node, nodes_[node].count++, entry);
    nodes_[node].size_in_order = 0;
}

void BoxTree::take(std::uint32_t node, int slot) {
    const int last = --nodes_[node].count;
    if (slot != last) put(node, slot, {slot_box(nodes_[node], last), nodes_[node].child[last]});
    clear_slot(nodes_[node], last);
    nodes_[node].size_in_order = 0;
}

void BoxTree::insert(std::uint32_t id, const Aabb& box) {
    if (id >= places_.size()) {
        reserve_sparingly(places_, id + 1);
        places_.resize(id + 1, none);
    }
    place({box, id}, 0);
    ++size_;
}

void BoxTree::place(const Entry& entry, int level) {
    if (root_ == none) root_ = add_node(0);
    std::uint32_t at = root_;
    while (nodes_[at].level > level) {
        BoxNode& node = nodes_[at];
        const int slot = find_cheapest_slot(node, entry.box);
        set_slot_box(node, slot, unite(slot_box(node, slot), entry.box));
        at = node.child[slot];
    }
    add_or_split(at, entry);
}

void BoxTree::add_or_split(std::uint32_t node, const Entry& entry) {
    if (nodes_[node].count < width) {
        append(node, entry);
        return;
    }
    Entry entries[width + 1];
    for (int i = 0; i < width; ++i) entries[i] = {slot_box(nodes_[node], i), nodes_[node].child[i]};
    entries[width] = entry;
    const Cut cut = find_cut(entries, min_count);

    const std::uint32_t twin = add_node(nodes_[node].level);
    for (int i = 0; i < width; ++i) clear_slot(nodes_[node], i);
    nodes_[node].count = 0;
    for (int i = 0; i <= width; ++i)
        append(i < cut.first_count ? node : twin, entries[cut.order[i]]);

    const Entry half = {node_box(nodes_[node]), node};
    const Entry other_half = {node_box(nodes_[twin]), twin};
    if (node == root_) {
        root_ = add_node(nodes_[node].level + 1);
        append(root_, half);
        append(root_, other_half);
    } else {
        const std::uint32_t parent = nodes_[node].parent;
        set_slot_box(nodes_[parent], nodes_[node].slot, half.box);
        add_or_split(parent, other_half);
    }
}

void BoxTree::remove(std::uint32_t id) {
    const std::uint32_t where = places_[id];
    places_[id] = none;
    --size_;
    remove_slot(where / width, int(where % width));
}

void BoxTree::remove_slot(std::uint32_t node, int slot) {
    take(node, slot);
    if (node == root_ || nodes_[node].count >= min_count) {
        tighten_above(node);
        shrink_root();
    } else {
        dissolve(node);
    }
}

void BoxTree::dissolve(std::uint32_t node) {
    Entry orphans[width + max_levels * (min_count - 1)];
    int orphan_levels[width + max_levels * (min_count - 1)];
    int orphan_count = 0;
    do {
        const BoxNode& poor = nodes_[node];
        for (int i = 0; i < poor.count; ++i) {
            orphan_levels[orphan_count] = poor.level;
            orphans[orphan_count++] = {slot_box(poor, i), poor.child[i]};
        }
        const std::uint32_t parent = poor.parent;
        const int slot_in_parent = poor.slot;
        free_node(node);
        take(parent, slot_in_parent);
        node = parent;
    } while (node != root_ && nodes_[node].count < min_count);
    tighten_above(node);
    shrink_root();
    // The highest first; the root is still above the level of each.
    while (orphan_count-- > 0) place(orphans[orphan_count], orphan_levels[orphan_count]);
}

void BoxTree::tighten_above(std::uint32_t node) {
    for (std::uint32_t at = node; nodes_[at].parent != none; at = nodes_[at].parent) {
        BoxNode& parent = nodes_[nodes_[at].parent];
        const Aabb box = node_box(nodes_[at]);
        const Aabb old = slot_box(parent, nodes_[at].slot);
        if (box.lower == old.lower && box.upper == old.upper) return;
        set_slot_box(parent, nodes_[at].slot, box);
    }
}

void BoxTree::shrink_root() {
    while (nodes_[root_].level > 0 && nodes_[root_].count == 1) {
        const std::uint32_t child = nodes_[root_].child[0];
        free_node(root_);
        root_ = child;
        nodes_[root_].parent = none;
        nodes_[root_].slot = 0;
    }
    if (nodes_[root_].count == 0) {
        free_node(root_);
        root_ = none;
    }
}

void BoxTree::move(std::uint32_t id, const Aabb& box) {
    std::uint32_t at = places_[id] / width;
    set_slot_box(nodes_[at], int(places_[id] % width), box);
    if (!nodes_[at].dirty) {
        nodes_[at].dirty = true;
        dirty_.push_back(at);
    }
    while (nodes_[at].parent != none) {
        BoxNode& parent = nodes_[nodes_[at].parent];
        const Aabb around = slot_box(parent, nodes_[at].slot);
        if (contains(around, box)) return;
        set_slot_box(parent, nodes_[at].slot, unite(around, box));
        at = nodes_[at].parent;
    }
}

std::uint32_t BoxTree::mark(std::uint32_t id) {
    const std::uint32_t node = places_[id] / width;
    const std::uint8_t before = nodes_[node].marks;
    nodes_[node].marks |= std::uint8_t(1u << (places_[id] % width));
    return before == 0 ? node : none;
}

void BoxTree::list_leaves(LargeArray<std::uint32_t>& ids) const {
    query(whole_space, [&](std::uint32_t id) { ids.push_back(id); });
}

}  // namespace cairn

#pragma once
// The production broad phase: which fat boxes overlap that did not before.
//
// Two trees, one of what moves and one of what does not, so that a million boxes that stand still
// are neither kept up nor searched from. A shape is given a box with room around it; nothing
// happens until its tight box leaves that. Only what is new, escaped or changed its tree is looked
// up, so an idle world costs nothing. Boxes without end (planes) would make every box of a tree
// as large: they stand in a list and are tested against all that is looked up.
//
// The caller keeps the pairs that it was told and drops those that no longer make_pair(): these
// are at any time exactly the pairs among the fat boxes, as brute_force.h defines them. No pair
// is ever left out, and the pairs come sorted, so that nothing depends on the trees' shape.
//
// A value: a copy is complete. All that it does follows from the sequence of calls.

#include <array>
#include <span>

#include "base/large_array.h"
#include "broad/box_tree.h"
#include "broad/proxy.h"

namespace cairn {

class TreePairs {
public:
    // A box that can be stored: no NaN, no lower face beyond its upper one.
    static bool is_valid(const Aabb& box);

    // Ids are small dense integers, below 2^29. False, and nothing done, when the box is not
    // valid or the id is there already.
    bool insert(std::uint32_t id, const Aabb& fat, bool moves);
    // Many at once, in any order: their trees are built from the top when there are more new ones
    // than old. False when any was refused as above; the others are in.
    bool insert_many(std::span<const Proxy> proxies);
    // Nothing is done for an id that is not there, here and below.
    void remove(std::uint32_t id);
    void set_moves(std::uint32_t id, bool moves);
    // Has the pairs of an id told anew, as if its box were new.
    void look_up(std::uint32_t id) {
        if (is_there(id)) mark(id);
    }
    // False and nothing done while the stored box holds `tight` (or `fat` is not valid); else
    // stores `fat`, marks the id as escaped, true.
    bool update(std::uint32_t id, const Aabb& tight, const Aabb& fat);

    // Whether the id is there as one that moves or does not, and its stored box holds `tight`: then
    // it needs no update.
    bool holds(std::uint32_t id, const Aabb& tight, bool as_moving) const {
        return is_there(id) && moves(id) == as_moving && contains(boxes_[id], tight);
    }
    bool is_there(std::uint32_t id) const {
        return id < states_.size() && (states_[id] & there) != 0;
    }
    // The stored, fat box; the id must be there, here and below.
    const Aabb& box(std::uint32_t id) const { return boxes_[id]; }
    bool moves(std::uint32_t id) const { return (states_[id] & moving) != 0; }
    bool overlap(std::uint32_t a, std::uint32_t b) const { return overlaps(boxes_[a], boxes_[b]); }
    // Whether the two are a pair: both are there, their boxes overlap and at least one moves.
    bool make_pair(std::uint32_t a, std::uint32_t b) const;

    // Replaces `pairs` by all pairs of which at least one is new, escaped or changed its tree
    // since the last call. Sorted, unique. Then forgets the marks.
    void find_new_pairs(LargeArray<Pair>& pairs);

    // The same in three parts, for threads: prepare_search() tells the number of searches;
    // search() appends to `pairs` what a range of them finds, for any ranges in any order and
    // side by side; finish_search() sorts what they found together. Nothing may be changed in
    // between.
    std::size_t prepare_search();
    void search(std::size_t begin, std::size_t end, LargeArray<Pair>& pairs) const;
    void finish_search(LargeArray<Pair>& pairs);

    // visit(id) for every id whose fat box overlaps.
    template <class Visit>
    void query(const Aabb& box, Visit&& visit) const;

    // visit(id) for every id whose fat box the probe reaches, and for every endless one. The visit
    // may lower the probe's limit (box_probe.h).
    template <class Probe, class Visit>
    void visit_reached(Probe& probe, Visit&& visit) const;

    // For tests and figures.
    bool is_sound() const;
    const BoxTree& tree(bool moves) const { return trees_[moves]; }
    std::size_t byte_count() const;

private:
    // States of an id, a bit each.
    static constexpr std::uint8_t there = 1, moving = 2, endless = 4, marked = 8, listed = 16;

    // Looked up together: the marked leaves of one node, or an endless box by itself.
    struct Search {
        std::uint32_t index;  // of the node, or the id
        bool is_endless;
        bool moves;
    };

    void make_room(std::uint32_t end);
    void add(std::uint32_t id, const Aabb& box, bool moves, bool to_tree);
    void take_out(std::uint32_t id);
    void mark(std::uint32_t id);
    void build_or_insert(bool moves, std::span<const std::uint32_t> ids);
    void search_node(const BoxNode& node, bool moves, LargeArray<Pair>& pairs) const;
    void search_endless(std::uint32_t id, LargeArray<Pair>& pairs) const;

    std::array<BoxTree, 2> trees_;                       // of what stands still, of what moves
    std::array<std::vector<std::uint32_t>, 2> endless_;  // likewise
    LargeArray<Aabb> boxes_;                             // by id
    LargeArray<std::uint8_t> states_;                    // by id
    LargeArray<std::uint32_t> marked_;
    LargeArray<Search> searches_;
    LargeArray<Pair> sorting_;
};

template <class Visit>
void TreePairs::query(const Aabb& box, Visit&& visit) const {
    for (const bool moves : {false, true}) {
        trees_[moves].query(box, visit);
        for (const std::uint32_t id : endless_[moves]) {
            if (overlaps(boxes_[id], box)) visit(id);
        }
    }
}

template <class Probe, class Visit>
void TreePairs::visit_reached(Probe& probe, Visit&& visit) const {
    for (const bool moves : {false, true}) {
        for (const std::uint32_t id : endless_[moves]) {
            if (probe.limit < 0) return;
            visit(id);
        }
    }
    for (const bool moves : {false, true}) trees_[moves].visit_reached(probe, visit);
}

}  // namespace cairn

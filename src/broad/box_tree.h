#pragma once
// A tree of boxes that finds all leaves whose boxes overlap a given one, and is kept up while they
// come, go and move.
//
// An R-tree: every leaf lies equally deep, every node but the root has three to eight children, so
// the depth is bounded whatever happens. A leaf comes in where boxes grow least, a full node is
// split where the halves are smallest. A leaf that moves widens the boxes above it in place;
// settle() then tightens what was widened, and dissolves nodes whose leaves have gone apart, in
// proportion to what moved. build() makes the whole tree anew from the top; settle() calls it when
// a quarter of the leaves had to be put in again since the last time.
//
// Departures: the measure of a box (box_node.h) is not its surface alone; nodes are dissolved when
// they have decayed, not when one happens to be full.
//
// Source: Guttman 1984, Beckmann et al. 1990 (R*-tree), Lee and Lee 2003 (bulk loading from the
// top). Boxes must be finite, and small enough for measure() not to overflow; ids below 2^31.
// The order and the shape of the tree follow from the sequence of calls alone.

#include <bit>
#include <span>
#include <utility>

#include "base/large_array.h"
#include "broad/box_probe.h"

namespace cairn {

class BoxTree {
public:
    static constexpr std::uint32_t none = BoxNode::none;

    std::uint32_t size() const { return size_; }

    // The id must not be there yet.
    void insert(std::uint32_t id, const Aabb& box);
    // The id must be there, here and below.
    void remove(std::uint32_t id);
    void move(std::uint32_t id, const Aabb& box);

    // Replaces the whole tree. boxes[id] is the box of each id.
    void build(std::span<const std::uint32_t> ids, std::span<const Aabb> boxes);
    // Brings what has moved in order again. boxes[id] is the box of each leaf.
    void settle(std::span<const Aabb> boxes);

    // visit(id) for every leaf whose box overlaps.
    template <class Visit>
    void query(const Aabb& box, Visit&& visit) const;
    // visit(id) for every leaf that the probe reaches, those of near nodes first. The visit may
    // lower the probe's limit.
    template <class Probe, class Visit>
    void visit_reached(Probe& probe, Visit&& visit) const;
    // Ids of all leaves, in the order of the tree.
    void list_leaves(LargeArray<std::uint32_t>& ids) const;

    // visit(id, other) for every leaf `other` whose box overlaps that of a marked leaf `id` of
    // `seekers`, a node of leaves of this tree or another. Of two marked leaves of this tree only
    // one seeks the other; seekers from another tree find all, or all that are not marked.
    enum class Marked { OnlyOneWay, All, None };
    template <class Visit>
    void meet(const BoxNode& seekers, Marked marked, Visit&& visit) const;

    // Marks say which leaves' pairs are sought. The node of the leaf where it is the node's first
    // mark, none where it is not.
    std::uint32_t mark(std::uint32_t id);
    void unmark_node(std::uint32_t node) { nodes_[node].marks = 0; }
    const BoxNode& node(std::uint32_t index) const { return nodes_[index]; }

    // Whether links, counts, levels and places agree, and every box lies inside its parent's.
    bool is_sound() const;
    // Nodes that a query for `box` reads.
    std::size_t count_visits(const Aabb& box) const;
    std::size_t byte_count() const;
    int level_count() const { return root_ == none ? 0 : nodes_[root_].level + 1; }

    struct Entry {
        Aabb box;
        std::uint32_t ref = 0;  // the id of a leaf on level 0, the index of a node above
    };
    struct Point {
        Vec3 twice_center;
        std::uint32_t ref = 0;
    };

private:
    // At least three of eight children a node: no more levels than this for 2^31 leaves.
    static constexpr int min_count = 3;
    static constexpr int max_levels = 20;

    std::uint32_t add_node(int level);
    void free_node(std::uint32_t node);
    void free_all();
    void put(std::uint32_t node, int slot, const Entry& entry);
    void append(std::uint32_t node, const Entry& entry);
    void take(std::uint32_t node, int slot);
    void place(const Entry& entry, int level);
    void add_or_split(std::uint32_t node, const Entry& entry);
    void remove_slot(std::uint32_t node, int slot);
    void tighten_above(std::uint32_t node);
    void shrink_root();

    void build_below(std::uint32_t node, std::span<Point> points, std::span<const Aabb> boxes);
    void tighten_dirty();
    void judge(std::uint32_t node);
    void dissolve_loose(std::span<const Aabb> boxes);
    void dissolve(std::uint32_t node);

    LargeArray<BoxNode> nodes_;
    LargeArray<std::uint32_t> places_;  // by id: 8 node + slot
    std::uint32_t root_ = none;
    std::uint32_t free_ = none;
    std::uint32_t size_ = 0;
    std::uint32_t worn_ = 0;  // leaves put in again since the last build()
    // Nodes of leaves below which something has moved, and room that settle() uses again.
    LargeArray<std::uint32_t> dirty_, dirty_above_, loose_;
};

template <class Visit>
void BoxTree::query(const Aabb& box, Visit&& visit) const {
    if (root_ == none) return;
    const Aabb finite = clamp_to_finite(box);
    std::uint32_t stack[max_levels * BoxNode::width];
    int waiting = 0;
    stack[waiting++] = root_;
    while (waiting > 0) {
        const BoxNode& at = nodes_[stack[--waiting]];
        std::uint32_t hits = find_overlaps(at, finite);
        for (; hits != 0; hits &= hits - 1) {
            const std::uint32_t child = at.child[std::countr_zero(hits)];
            if (at.level == 0) {
                visit(child);
            } else {
                stack[waiting++] = child;
            }
        }
    }
}

template <class Probe, class Visit>
void BoxTree::visit_reached(Probe& probe, Visit&& visit) const {
    if (root_ == none) return;
    struct Waiting {
        float entry;
        std::uint32_t node;
    };
    Waiting stack[max_levels * BoxNode::width];
    int waiting = 0;
    stack[waiting++] = {0, root_};
    while (waiting > 0) {
        const Waiting next = stack[--waiting];
        // The limit may have come nearer since.
        if (next.entry > probe.limit) continue;
        const BoxNode& at = nodes_[next.node];
        float entry[BoxNode::width];
        const ReachedSlots reached(probe.find(at, entry), entry);
        if (at.level > 0) {
            for (int i = 0; i < reached.count; ++i)
                stack[waiting++] = {entry[reached.slots[i]], at.child[reached.slots[i]]};
            continue;
        }
        for (int i = reached.count; i-- > 0;) {
            if (entry[reached.slots[i]] <= probe.limit) visit(at.child[reached.slots[i]]);
        }
    }
}

template <class Visit>
void BoxTree::meet(const BoxNode& seekers, Marked marked, Visit&& visit) const {
    if (root_ == none) return;
    Aabb around = clamp_to_finite(whole_space);
    std::swap(around.lower, around.upper);
    for (std::uint32_t left = seekers.marks; left != 0; left &= left - 1)
        around = unite(around, slot_box(seekers, std::countr_zero(left)));

    // Which of the seekers come how far down.
    struct Visitors {
        std::uint32_t node, slots;
    };
    Visitors stack[max_levels * BoxNode::width];
    int waiting = 0;
    stack[waiting++] = {root_, seekers.marks};
    while (waiting > 0) {
        const auto [index, slots] = stack[--waiting];
        const BoxNode& at = nodes_[index];
        if (at.level > 0) {
            for (std::uint32_t hits = find_overlaps(at, around); hits != 0; hits &= hits - 1) {
                const int slot = std::countr_zero(hits);
                const std::uint32_t below = slots & find_overlaps(seekers, slot_box(at, slot));
                if (below != 0) stack[waiting++] = {at.child[slot], below};
            }
            continue;
        }
        // Nodes of one tree stand in one array: their addresses are ordered as their indices are.
        const bool without_marked =
            marked == Marked::None || (marked == Marked::OnlyOneWay && &at < &seekers);
        const std::uint32_t sought = without_marked ? ~std::uint32_t(at.marks) : ~0u;
        if ((sought & ((1u << at.count) - 1)) == 0) continue;
        for (std::uint32_t left = slots; left != 0; left &= left - 1) {
            const int seeker = std::countr_zero(left);
            std::uint32_t hits = sought & find_overlaps(at, slot_box(seekers, seeker));
            // Within a node the later slot seeks the earlier marked one, and nobody itself.
            if (&at == &seekers) hits &= ~(at.marks & (~0u << seeker));
            for (; hits != 0; hits &= hits - 1)
                visit(seekers.child[seeker], at.child[std::countr_zero(hits)]);
        }
    }
}

}  // namespace cairn

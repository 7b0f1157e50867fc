#pragma once
// A node of the tree: eight boxes side by side, and the few operations on them that cost anything.
//
// A face of all eight boxes is one row of floats, so that a loop over a row is one or two vector
// instructions at any width of vector; no sum runs across a row, so the width changes no result.
// An empty slot holds the box from +infinity to -infinity: it overlaps no finite box, and a union
// with it changes nothing. Boxes that are asked about are clamped to finite numbers for its sake.
//
// size: what a box costs whoever looks for overlaps, see measure().

#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/large_array.h"
#include "math/aabb.h"

namespace cairn {

struct alignas(64) BoxNode {
    static constexpr int width = 8;
    static constexpr std::uint32_t none = 0xffffffffu;
    static constexpr float infinite = std::numeric_limits<float>::infinity();

    float lower[3][width];
    float upper[3][width];
    std::uint32_t child[width];   // ids of leaves on level 0, indices of nodes above
    std::uint32_t parent = none;  // none at the root; the next free node in one that is free
    std::uint8_t slot = 0;        // where in the parent
    std::uint8_t level = 0;       // levels below this one
    std::uint8_t count = 0;       // slots 0 to count - 1 are taken
    std::uint8_t marks = 0;       // a bit a slot: leaves whose pairs are sought
    bool dirty = false;           // something below has moved since the last settling
    bool is_free = false;
    float size_in_order = 0;  // its size when it was last in order; 0 when not known
};

// Room for `size` elements, at most an eighth more than needed: for arrays of a million.
template <class Element>
void reserve_sparingly(LargeArray<Element>& elements, std::size_t size) {
    if (size > elements.capacity()) elements.reserve(size + size / 8 + 16);
}

inline constexpr Aabb whole_space = {{-BoxNode::infinite, -BoxNode::infinite, -BoxNode::infinite},
                                     {BoxNode::infinite, BoxNode::infinite, BoxNode::infinite}};

inline bool contains(const Aabb& outer, const Aabb& inner) {
    return (outer.lower.x <= inner.lower.x) & (outer.lower.y <= inner.lower.y) &
           (outer.lower.z <= inner.lower.z) & (inner.upper.x <= outer.upper.x) &
           (inner.upper.y <= outer.upper.y) & (inner.upper.z <= outer.upper.z);
}

inline Aabb unite(const Aabb& a, const Aabb& b) {
    return {min(a.lower, b.lower), max(a.upper, b.upper)};
}

// Half the surface, which a random line hits in proportion, and the square of the sum of the sides,
// which tells boxes apart that have no surface, and counts for boxes as large as what they meet.
inline float measure(float x, float y, float z) {
    const float sides = x + y + z;
    return (x * y + y * z + z * x) + 0.125f * (sides * sides);
}

inline float measure(const Aabb& box) {
    return measure(box.upper.x - box.lower.x, box.upper.y - box.lower.y, box.upper.z - box.lower.z);
}

// The same box for every finite neighbour, and none for an empty slot.
inline Aabb clamp_to_finite(const Aabb& box) {
    constexpr float most = std::numeric_limits<float>::max();
    constexpr Vec3 lowest = {-most, -most, -most}, highest = {most, most, most};
    return {max(lowest, min(highest, box.lower)), max(lowest, min(highest, box.upper))};
}

// A bit for each slot whose box overlaps the finite `box`.
std::uint32_t find_overlaps(const BoxNode& node, const Aabb& box);

inline Aabb slot_box(const BoxNode& node, int i) {
    return {{node.lower[0][i], node.lower[1][i], node.lower[2][i]},
            {node.upper[0][i], node.upper[1][i], node.upper[2][i]}};
}

inline void set_slot_box(BoxNode& node, int i, const Aabb& box) {
    node.lower[0][i] = box.lower.x;
    node.lower[1][i] = box.lower.y;
    node.lower[2][i] = box.lower.z;
    node.upper[0][i] = box.upper.x;
    node.upper[1][i] = box.upper.y;
    node.upper[2][i] = box.upper.z;
}

inline void clear_slot(BoxNode& node, int i) {
    constexpr float infinite = BoxNode::infinite;
    set_slot_box(node, i, {{infinite, infinite, infinite}, {-infinite, -infinite, -infinite}});
    node.child[i] = BoxNode::none;
}

// The box about all slots.
Aabb node_box(const BoxNode& node);

// The slot that grows least to hold `box`; the smaller one of two that grow alike.
int find_cheapest_slot(const BoxNode& node, const Aabb& box);

}  // namespace cairn

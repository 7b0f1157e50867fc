// The loops over a node's eight boxes; see box_node.h. They stand in a file of their own since gcc
// unrolls a short loop that it inlines into another before it could make vector instructions of it.

#include "broad/box_node.h"

namespace cairn {

std::uint32_t find_overlaps(const BoxNode& node, const Aabb& box) {
    constexpr std::uint32_t bits[BoxNode::width] = {1, 2, 4, 8, 16, 32, 64, 128};
    std::uint32_t mask = 0;
    for (int i = 0; i < BoxNode::width; ++i) {
        const bool hit = (node.lower[0][i] <= box.upper.x) & (box.lower.x <= node.upper[0][i]) &
                         (node.lower[1][i] <= box.upper.y) & (box.lower.y <= node.upper[1][i]) &
                         (node.lower[2][i] <= box.upper.z) & (box.lower.z <= node.upper[2][i]);
        mask |= hit ? bits[i] : 0u;
    }
    return mask;
}

Aabb node_box(const BoxNode& node) {
    static_assert(BoxNode::width == 8);
    float low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
        float l[4], u[4];
        for (int i = 0; i < 4; ++i) l[i] = min(node.lower[axis][i], node.lower[axis][i + 4]);
        for (int i = 0; i < 4; ++i) u[i] = max(node.upper[axis][i], node.upper[axis][i + 4]);
        low[axis] = min(min(l[0], l[2]), min(l[1], l[3]));
        high[axis] = max(max(u[0], u[2]), max(u[1], u[3]));
    }
    return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

int find_cheapest_slot(const BoxNode& node, const Aabb& box) {
    float size[BoxNode::width], growth[BoxNode::width];
    for (int i = 0; i < BoxNode::width; ++i) {
        size[i] = measure(node.upper[0][i] - node.lower[0][i], node.upper[1][i] - node.lower[1][i],
                          node.upper[2][i] - node.lower[2][i]);
        growth[i] =
            measure(max(node.upper[0][i], box.upper.x) - min(node.lower[0][i], box.lower.x),
                    max(node.upper[1][i], box.upper.y) - min(node.lower[1][i], box.lower.y),
                    max(node.upper[2][i], box.upper.z) - min(node.lower[2][i], box.lower.z)) -
            size[i];
    }
    int best = 0;
    for (int i = 1; i < node.count; ++i) {
        if (growth[i] < growth[best] || (growth[i] == growth[best] && size[i] < size[best]))
            best = i;
    }
    return best;
}

}  // namespace cairn

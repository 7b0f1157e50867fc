// The loops over a node's eight boxes; see box_probe.h. In a file of their own for the reason that
// box_node.cpp gives.

#include "broad/box_probe.h"

#include <bit>

namespace cairn {

namespace {

// Five roundings at most between a box and its distance; each is half of one of these.
constexpr float shorter = 1 - 4 * float_epsilon;
constexpr float longer = 1 + 4 * float_epsilon;

// Large enough for a ray that goes along a face of a box to stay in it as far as there are
// positions.
constexpr float most_inverse = 1e30f;

float invert(float component) {
    const float size = absolute(component);
    const float inverse = size * most_inverse > 1 ? 1 / size : most_inverse;
    return component < 0 ? -inverse : inverse;
}

Aabb box_of(Position p) { return box_around(p, {}); }

Vec3 choose(Vec3 signs, Vec3 where_negative, Vec3 elsewhere) {
    return {signs.x < 0 ? where_negative.x : elsewhere.x,
            signs.y < 0 ? where_negative.y : elsewhere.y,
            signs.z < 0 ? where_negative.z : elsewhere.z};
}

}  // namespace

RayProbe::RayProbe(Position origin, Vec3 direction, double length)
    : inverse{invert(direction.x), invert(direction.y), invert(direction.z)},
      limit(round_up(length)) {
    const Aabb from = box_of(origin);
    origin_in = choose(inverse, from.lower, from.upper);
    origin_out = choose(inverse, from.upper, from.lower);
}

std::uint32_t RayProbe::find(const BoxNode& node, float (&entry)[BoxNode::width]) const {
    constexpr std::uint32_t bits[BoxNode::width] = {1, 2, 4, 8, 16, 32, 64, 128};
    const float* const in_x = inverse.x < 0 ? node.upper[0] : node.lower[0];
    const float* const in_y = inverse.y < 0 ? node.upper[1] : node.lower[1];
    const float* const in_z = inverse.z < 0 ? node.upper[2] : node.lower[2];
    const float* const out_x = inverse.x < 0 ? node.lower[0] : node.upper[0];
    const float* const out_y = inverse.y < 0 ? node.lower[1] : node.upper[1];
    const float* const out_z = inverse.z < 0 ? node.lower[2] : node.upper[2];
    const Vec3 a = origin_in, b = origin_out, inv = inverse;
    const float farthest = limit;
    std::uint32_t mask = 0;
    // By itself, so that nobody asks whether it lies within the node.
    float begin[BoxNode::width];
    for (int i = 0; i < BoxNode::width; ++i) {
        const float enter = max(max((in_x[i] - a.x) * inv.x, (in_y[i] - a.y) * inv.y),
                                max((in_z[i] - a.z) * inv.z, 0.0f));
        const float leave =
            min(min((out_x[i] - b.x) * inv.x, (out_y[i] - b.y) * inv.y), (out_z[i] - b.z) * inv.z);
        begin[i] = shorter * enter;
        const bool hit = (begin[i] <= longer * leave) & (begin[i] <= farthest);
        mask |= hit ? bits[i] : 0u;
    }
    for (int i = 0; i < BoxNode::width; ++i) entry[i] = begin[i];
    return mask;
}

PointProbe::PointProbe(Position position, double reach)
    : origin(box_of(position)), limit(round_up(reach)) {}

std::uint32_t PointProbe::find(const BoxNode& node, float (&entry)[BoxNode::width]) const {
    constexpr std::uint32_t bits[BoxNode::width] = {1, 2, 4, 8, 16, 32, 64, 128};
    const Vec3 low = origin.lower, high = origin.upper;
    const float farthest = limit;
    std::uint32_t mask = 0;
    float begin[BoxNode::width];
    for (int i = 0; i < BoxNode::width; ++i) {
        const float x = max(max(node.lower[0][i] - high.x, low.x - node.upper[0][i]), 0.0f);
        const float y = max(max(node.lower[1][i] - high.y, low.y - node.upper[1][i]), 0.0f);
        const float z = max(max(node.lower[2][i] - high.z, low.z - node.upper[2][i]), 0.0f);
        begin[i] = shorter * square_root(x * x + y * y + z * z);
        mask |= begin[i] <= farthest ? bits[i] : 0u;
    }
    for (int i = 0; i < BoxNode::width; ++i) entry[i] = begin[i];
    // Free slots are as far as everywhere is near.
    return mask & ((1u << node.count) - 1);
}

ReachedSlots::ReachedSlots(std::uint32_t hits, const float (&entry)[BoxNode::width]) {
    for (; hits != 0; hits &= hits - 1) {
        const int slot = std::countr_zero(hits);
        int place = count++;
        for (; place > 0 && entry[slots[place - 1]] < entry[slot]; --place)
            slots[place] = slots[place - 1];
        slots[place] = std::uint8_t(slot);
    }
}

}  // namespace cairn

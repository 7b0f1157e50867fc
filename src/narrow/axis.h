#pragma once
// The axis between two convex shapes: the unit that narrow-phase methods exchange.
//
// For disjoint shapes it is the direction of least distance; for overlapping ones the direction
// along which the least push parts them. Everything is in shape A's frame.

#include <cstdint>
#include <limits>

#include "math/vec3.h"

namespace cairn {

struct Axis {
    Vec3 normal = {0, 1, 0};  // unit, from A to B
    float separation = 0;     // signed metres along it, negative where the shapes overlap
    Vec3 point_a;             // the closest (or deepest) point of A, relative to A's origin
    Vec3 point_b;             // of B, relative to B's origin, still along A's axes
    // Of two boxes: whether the normal is exactly that of the face or edge pair that the hint
    // names.
    bool on_hint = false;
};

// What the last step found for this pair, kept by the contact store: where two axes are as good as
// each other the method stays with the one it had, so that a resting box keeps its contact points.
// Aligned so that it is copied as one number.
struct alignas(4) AxisHint {
    std::uint8_t kind = 0;  // the method's own code; 0: nothing is known
    std::uint8_t index_a = 0;
    std::uint8_t index_b = 0;
};

// How near is near: shapes farther apart than this along some axis need no more exact an answer.
struct Reach {
    float distance = 0;  // metres, in every direction
    Vec3 travel = {};    // and what this motion of B closes, along A's axes

    // `n` is unit, from A to B.
    float along(Vec3 n) const { return distance + max(0, -dot(n, travel)); }
};

inline constexpr Reach everywhere = {std::numeric_limits<float>::infinity(), {}};

}  // namespace cairn

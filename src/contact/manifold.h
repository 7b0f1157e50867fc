#pragma once
// A contact manifold: up to four points at which two shapes touch or nearly do, sharing one
// normal. Everything along shape A's axes.

#include <array>
#include <cstdint>

#include "narrow/axis.h"

namespace cairn {

struct ManifoldPoint {
    // The point halfway between the two surfaces, relative to A's origin and to B's. Both are kept
    // since one shape may be a thousand times larger than the other, and the smaller one's arm must
    // stay exact.
    Vec3 from_a;
    Vec3 from_b;
    float separation = 0;       // signed metres along the normal
    std::uint32_t feature = 0;  // the features of A and B that meet here: the same while they do
};

struct Manifold {
    Vec3 normal = {0, 1, 0};  // unit, from A to B
    int point_count = 0;
    std::array<ManifoldPoint, 4> points;
};

inline void push_point(Manifold& manifold, const ManifoldPoint& point) {
    manifold.points[std::size_t(manifold.point_count++)] = point;
}

// The axis's own two witnesses, and the point halfway between them.
inline void push_witness(Manifold& manifold, const Axis& axis, std::uint32_t feature) {
    const Vec3 half_gap = 0.5f * axis.separation * axis.normal;
    push_point(manifold,
               {axis.point_a + half_gap, axis.point_b - half_gap, axis.separation, feature});
}

}  // namespace cairn

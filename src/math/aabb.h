#pragma once
// Axis-aligned bounding boxes in the world, binary32, rounded outward from binary64.

#include "math/vec3.h"

namespace cairn {

struct Aabb {
    Vec3 lower;
    Vec3 upper;
};

inline namespace kernel {

constexpr bool overlaps(const Aabb& a, const Aabb& b) {
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
           b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

/// The largest binary32 number not above x, and the smallest not below it.
float round_down(double x);
float round_up(double x);

/// The box that holds center +- half_extents, whatever is lost in rounding.
Aabb box_around(Position center, Vec3 half_extents);

}  // namespace kernel
}  // namespace cairn

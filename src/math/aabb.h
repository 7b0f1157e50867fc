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

/// The next binary32 number above x; an infinity stays.
inline float next_above(float x) {
    const auto bits = __builtin_bit_cast(std::uint32_t, x);
    // Of negative numbers the bits count down, and both zeros have the same neighbour.
    const std::uint32_t next = bits >> 31u != 0 ? bits - 1 : bits + 1;
    const std::uint32_t of_zero = 1;
    const std::uint32_t above = (bits & 0x7fffffffu) == 0 ? of_zero : next;
    return __builtin_bit_cast(float, is_finite(x) ? above : bits);
}

/// The smallest binary32 number not below x, and the largest not above it. Which way x was rounded
/// is anybody's guess, so there is no branch on it.
inline float round_up(double x) {
    const auto rounded = float(x);
    const float above = next_above(rounded);
    return double(rounded) < x ? above : rounded;
}
inline float round_down(double x) { return -round_up(-x); }

/// The box that holds center +- half_extents, whatever is lost in rounding.
inline Aabb box_around(Position center, Vec3 half) {
    return {{round_down(center.x - double(half.x)), round_down(center.y - double(half.y)),
             round_down(center.z - double(half.z))},
            {round_up(center.x + double(half.x)), round_up(center.y + double(half.y)),
             round_up(center.z + double(half.z))}};
}

}  // namespace kernel
}  // namespace cairn

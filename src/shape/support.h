#pragma once
// Support points: which point of a convex shape lies farthest in a direction.
//
// A convex shape is a core, known by its support function alone, grown by a radius: a sphere is a
// point of radius r, a capsule a segment, a box is itself with radius 0. GJK and EPA see cores
// only, and the radii are added to what they find, so that round shapes stay exact. A new convex
// shape is a new support function. Directions and points are in the shape's own frame; a direction
// may have any length but 0.

#include "cairn/shape.h"
#include "math/vec3.h"

namespace cairn {

struct ConvexShape {
    using Support = Vec3 (*)(const void* core, Vec3 direction);

    const void* core =
        nullptr;  // owned elsewhere: lives as long as the geometry that it was made from
    Support support = nullptr;
    float radius = 0;
};

inline Vec3 support_of_point(const void*, Vec3) { return {}; }

inline Vec3 support_of_segment(const void* core, Vec3 direction) {
    const float half = 0.5f * static_cast<const Capsule*>(core)->height;
    return {0, direction.y < 0 ? -half : half, 0};
}

inline Vec3 support_of_box(const void* core, Vec3 direction) {
    const Vec3 h = static_cast<const Box*>(core)->half_extents;
    return {direction.x < 0 ? -h.x : h.x, direction.y < 0 ? -h.y : h.y,
            direction.z < 0 ? -h.z : h.z};
}

inline ConvexShape convex_shape(const Sphere& sphere) {
    return {&sphere, support_of_point, sphere.radius};
}
inline ConvexShape convex_shape(const Capsule& capsule) {
    return {&capsule, support_of_segment, capsule.radius};
}
inline ConvexShape convex_shape(const Box& box) { return {&box, support_of_box, 0}; }

}  // namespace cairn

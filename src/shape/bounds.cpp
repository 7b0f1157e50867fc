// Bounding boxes and sizes of shapes.
//
// A turned box reaches |R| h along the axes; the products of binary32 numbers are exact in
// binary64, so one rounding upward at the end keeps every corner inside.

#include "shape/bounds.h"

#include <limits>

#include "math/aabb.h"
#include "shape/visit.h"

namespace cairn {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

// How far the box reaches along one world axis, whose components along the box's axes are given.
float reach(float x, float y, float z, Vec3 h) {
    const Vec3 r = absolute(Vec3{x, y, z});
    return round_up(double(r.x) * double(h.x) + double(r.y) * double(h.y) +
                    double(r.z) * double(h.z));
}

}  // namespace

Vec3 bounds_half_extents(const Geometry& geometry, const Mat3& r) {
    return visit_shape(
        geometry,
        [](const Sphere& s) {
            return Vec3{s.radius, s.radius, s.radius};
        },
        [&](const Box& box) {
            const Vec3 h = box.half_extents;
            return Vec3{reach(r.x.x, r.y.x, r.z.x, h), reach(r.x.y, r.y.y, r.z.y, h),
                        reach(r.x.z, r.y.z, r.z.z, h)};
        },
        [&](const Capsule& capsule) {
            const double half = 0.5 * double(capsule.height), radius = capsule.radius;
            const Vec3 axis = absolute(r.y);
            return Vec3{round_up(half * double(axis.x) + radius),
                        round_up(half * double(axis.y) + radius),
                        round_up(half * double(axis.z) + radius)};
        },
        // Centred on the origin, a half-space that goes on to one side needs both.
        [](const Plane&) {
            return Vec3{infinite, infinite, infinite};
        });
}

float smallest_half_extent(const Geometry& geometry) {
    return visit_shape(
        geometry, [](const Sphere& s) { return s.radius; },
        [](const Box& box) {
            const Vec3 h = box.half_extents;
            return min(h.x, min(h.y, h.z));
        },
        [](const Capsule& capsule) { return capsule.radius; },
        [](const Plane&) { return infinite; });
}

float bounding_radius(const Geometry& geometry) {
    return visit_shape(
        geometry, [](const Sphere& s) { return s.radius; },
        [](const Box& box) {
            const double x = box.half_extents.x, y = box.half_extents.y, z = box.half_extents.z;
            return round_up(square_root(x * x + y * y + z * z));
        },
        [](const Capsule& capsule) {
            return round_up(0.5 * double(capsule.height) + double(capsule.radius));
        },
        [](const Plane&) { return infinite; });
}

}  // namespace cairn

#pragma once
// Where a ray meets a shape, and how far a point is from one: closed forms, in the shape's frame.
//
// Shapes are solid and closed. A ray that comes from outside meets a shape where it first touches
// it, grazing counted, with the outward normal of what it touches there. One that begins inside is
// met at once, at distance 0: the shape is in its way already, no surface is, so the normal is
// against the ray. One that begins on the surface is met there if it goes in, and not at all if it
// slides along or leaves.
//
// In binary64, see math/vec3d.h. Source: Ericson 2005, sections 5.1 and 5.3; the discriminant of a
// ball as the distance of its centre from the line (Haines et al. 2019), which does not cancel.

#include "cairn/shape.h"
#include "math/vec3d.h"

namespace cairn {

struct ShapeRay {
    Vec3d origin;
    Vec3d direction;    // unit
    double length = 0;  // >= 0, may be infinite
};

struct ShapeHit {
    double distance = 0;  // along the ray
    Vec3d normal;         // unit, outward
    bool inside = false;  // the ray begins within the shape
};

// False, and `hit` of no meaning, where the ray meets nothing of the shape.
bool cast_ray(const Geometry& geometry, const ShapeRay& ray, ShapeHit& hit);

struct NearestPoint {
    double distance = 0;  // signed, negative inside
    Vec3d normal;         // unit, outward, at the nearest point of the surface
};

// The nearest point of the surface is point - distance * normal. In the middle of a ball the normal
// is y, on the core of a capsule x; where faces of a box are equally near, x comes before y and y
// before z.
NearestPoint find_nearest_point(const Geometry& geometry, Vec3d point);

}  // namespace cairn

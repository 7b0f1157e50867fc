#pragma once
// Axes in closed form, for the pairs that have one.
//
// Each function answers for one pair of kinds, in the frame and the order named by its arguments;
// the pair table turns the answer round where the pair comes in the other order. Frames: the
// vectors between the shapes and the axes of boxes and capsules are given along some common axes
// (shape A's), and so is the answer.

#include "cairn/shape.h"
#include "math/mat3.h"
#include "narrow/axis.h"

namespace cairn {

// Two balls; `offset` leads from the first's centre to the second's. Concentric ones part along +y.
Axis find_axis_sphere_sphere(const Sphere& first, const Sphere& second, Vec3 offset);

// A half-space and a ball. `normal` is the plane's, outward, and `height` how far the ball's centre
// lies above the surface. From the plane to the ball.
Axis find_axis_plane_sphere(Vec3 normal, float height, Vec3 offset, const Sphere& sphere);

// A half-space and a box whose centre lies `height` above the surface. From the plane to the box.
Axis find_axis_plane_box(Vec3 normal, float height, Vec3 offset, const Box& box,
                         const Mat3& box_axes);

// A box and a ball whose centre lies `offset` from the box's. From the box to the ball.
Axis find_axis_box_sphere(const Box& box, const Mat3& box_axes, const Sphere& sphere, Vec3 offset);

// A capsule and a ball whose centre lies `offset` from the capsule's; the axis is the direction of
// the capsule's length, unit. Where the centre lies on it they part across it.
Axis find_axis_capsule_sphere(const Capsule& capsule, Vec3 capsule_axis, const Sphere& sphere,
                              Vec3 offset);

// Two capsules. Where their cores cross they part across both.
Axis find_axis_capsule_capsule(const Capsule& first, Vec3 first_axis, const Capsule& second,
                               Vec3 second_axis, Vec3 offset);

// A half-space and a capsule whose centre lies `height` above the surface. From the plane to the
// capsule.
Axis find_axis_plane_capsule(Vec3 normal, float height, Vec3 offset, const Capsule& capsule,
                             Vec3 capsule_axis);

// A box and a capsule whose centre lies `offset` from the box's. From the box to the capsule.
Axis find_axis_box_capsule(const Box& box, const Mat3& box_axes, const Capsule& capsule,
                           Vec3 capsule_axis, Vec3 offset);

}  // namespace cairn

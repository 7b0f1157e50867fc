#pragma once
// What the makers of scenes have in common: bodies added by shape, the ground, the pit.

#include "scene.h"

namespace cairn::bench {

/// Half extents of a cube.
Vector cube(double half);

/// Each answers with the body's index.
std::size_t add_box(BenchScene& scene, const Vector& position, const Vector& half_extents,
                    double density, const Rotation& rotation = {0, 0, 0, 1});
std::size_t add_sphere(BenchScene& scene, const Vector& position, double radius, double density);
/// `half_height` is of the cylindrical part, along the body's y.
std::size_t add_capsule(BenchScene& scene, const Vector& position, double half_height,
                        double radius, double density, const Rotation& rotation = {0, 0, 0, 1});
std::size_t add_static_box(BenchScene& scene, const Vector& position, const Vector& half_extents);

/// Ground of half extents (half_width, 1, half_width) with its top at 0: a box, not a plane, so
/// that every engine takes the same path through its code.
void add_ground(BenchScene& scene, double half_width);

/// Four walls, 1 m thick, around a square of that inner half width.
void add_pit(BenchScene& scene, double half_width, double height);

/// A two-dimensional pyramid of cubes across x, its lowest row centred on `center` and standing on
/// y = 0; neighbours of a row are `pitch` apart. Answers with the topmost cube.
std::size_t add_pyramid(BenchScene& scene, int base, double half, double pitch, double density,
                        const Vector& center);

/// The body ought to stay where it was put.
void expect_standing(BenchScene& scene, std::size_t body);

}  // namespace cairn::bench

#pragma once
// Shapes: pure geometry in a local frame, and what a body needs to carry one.

#include <cstdint>
#include <variant>

#include "cairn/types.h"

namespace cairn {

/// A ball about the local origin. radius > 0, metres.
struct Sphere {
    float radius = 0.5f;
    friend constexpr bool operator==(const Sphere&, const Sphere&) = default;
};

/// A box about the local origin, its faces across the local axes. Each half extent > 0, metres.
struct Box {
    Vec3 half_extents = {0.5f, 0.5f, 0.5f};
    friend constexpr bool operator==(const Box&, const Box&) = default;
};

/// All points within `radius` of a segment of length `height` along local y, about the local
/// origin: a cylinder with a half ball on either end. radius > 0, metres; height >= 0, metres: of
/// the cylindrical part, with 0 a ball.
struct Capsule {
    float radius = 0.5f;
    float height = 1;
    friend constexpr bool operator==(const Capsule&, const Capsule&) = default;
};

/// A half-space: solid where normal . x <= offset. Static bodies only. `normal` is normalised when
/// the shape is created; offset in metres along the unit normal.
struct Plane {
    Vec3 normal = {0, 1, 0};
    float offset = 0;
    friend constexpr bool operator==(const Plane&, const Plane&) = default;
};

using Geometry = std::variant<Sphere, Box, Plane, Capsule>;

/// How a surface rubs and bounces. Where two meet: friction is the geometric mean, restitution,
/// rolling and spinning friction the larger of the two.
struct Material {
    float friction = 0.6f;  ///< Coulomb coefficient, sticking and sliding alike, >= 0
    float restitution = 0;  ///< 0 (no rebound) to 1 (no loss)
    /// Metres: the torque across the normal is at most this times the normal force.
    float rolling_friction = 0;
    /// Metres: the torque about the normal is at most this times the normal force.
    float spinning_friction = 0;
    Vec3 surface_velocity = {};  ///< m/s in the body frame: a conveyor's belt
    friend constexpr bool operator==(const Material&, const Material&) = default;
};

/// A shape as a body carries it.
struct ShapeDef {
    Geometry geometry = Sphere{};
    Pose local_pose = {};  ///< the shape's frame in the body's frame; the rotation is normalised
    float density = 1000;  ///< kg/m^3, > 0; of no effect on static and kinematic bodies
    Material material = {};
};

}  // namespace cairn

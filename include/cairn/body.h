#pragma once
// Bodies: what one is made from, and what one can be asked for.

#include <cstdint>
#include <optional>
#include <vector>

#include "cairn/shape.h"
#include "cairn/types.h"

namespace cairn {

enum class BodyKind : std::uint8_t {
    Static,     ///< never moves
    Kinematic,  ///< moves as its velocity says; nothing pushes it
    Dynamic,    ///< moves under forces and contacts
};

/// Mass, center of mass (body frame, m), and inertia about the center of mass (body frame, kg m^2).
struct MassProperties {
    float mass = 0;
    Vec3 center_of_mass = {};
    SymmetricMat3 inertia = {};
    friend constexpr bool operator==(const MassProperties&, const MassProperties&) = default;
};

/// World axes along and about which a dynamic body does not move.
struct LockedAxes {
    bool x = false, y = false, z = false;     ///< no translation along
    bool rx = false, ry = false, rz = false;  ///< no rotation about
    friend constexpr bool operator==(const LockedAxes&, const LockedAxes&) = default;
};

/// Which bodies see each other. Equal groups that are not 0: positive always collide, negative
/// never; else each one's mask must hold the other's category.
struct CollisionFilter {
    std::uint32_t category = 1;
    std::uint32_t mask = 0xffffffffu;
    std::int32_t group = 0;
    friend constexpr bool operator==(const CollisionFilter&, const CollisionFilter&) = default;
};

/// Everything that a body is made from; read once, by World::create_body.
struct BodyDef {
    BodyKind kind = BodyKind::Dynamic;
    Position position = {};      ///< of the body frame's origin, world
    Quat rotation = {};          ///< body to world; normalised
    Vec3 linear_velocity = {};   ///< of the center of mass, m/s, world
    Vec3 angular_velocity = {};  ///< rad/s, world
    std::vector<ShapeDef> shapes = {};
    /// Scales what the shapes' densities give to this mass, kg. Not together with mass_properties.
    std::optional<float> mass = {};
    /// Replaces what the shapes give. A dynamic body without shapes needs it.
    std::optional<MassProperties> mass_properties = {};
    float gravity_scale = 1;
    float linear_damping = 0;   ///< 1/s: v is divided by (1 + damping h) every substep h
    float angular_damping = 0;  ///< 1/s, likewise
    bool gyroscopic = true;     ///< whether a tumbling body precesses
    Vec3 force = {};            ///< N, world, at the center of mass, in every step
    Vec3 torque = {};           ///< N m, world, in every step
    LockedAxes lock = {};
    /// Whether it may fall asleep; what touches it does so only with it.
    bool can_sleep = true;
    CollisionFilter collision = {};
};

/// Where a body is and how it moves, as read between steps.
struct BodyState {
    Position position = {};        ///< of the body frame's origin, world
    Position center_of_mass = {};  ///< world
    Quat rotation = {};
    Vec3 linear_velocity = {};  ///< of the center of mass
    Vec3 angular_velocity = {};
    BodyKind kind = BodyKind::Static;
    /// Left out of the step, its velocities zero, until something touches or changes it. Never
    /// true for static and kinematic bodies.
    bool asleep = false;
    /// True once the body's numbers went wrong: it stands still at its last good state, see
    /// StepReport.
    bool frozen = false;
};

}  // namespace cairn

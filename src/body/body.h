#pragma once
// A body's numbers, grouped by who writes them: what a step moves, what resists it, what drives it.

#include <cstdint>

#include "cairn/body.h"
#include "math/quat.h"

namespace cairn {

// What a step moves; a solver's gathers touch nothing else. The world position, binary64, lies
// apart: a step works with the displacement since its start alone, so that nothing cancels far from
// the origin.
struct BodyMotion {
    Vec3 linear_velocity = {};   // of the center of mass, world
    Vec3 angular_velocity = {};  // world
    Quat rotation = {};          // body to world
    Vec3 displacement = {};      // of the center of mass since the step began, world
};

// What resists: all zero for static, kinematic and frozen bodies.
struct BodyInertia {
    float mass = 0;
    float inverse_mass = 0;
    SymmetricMat3 inertia;          // about the center of mass, body frame
    SymmetricMat3 inverse_inertia;  // body frame
    bool isotropic =
        true;  // the same about every axis: no gyroscopic effect, no turning of tensors
};

// What drives a body through one step: constant while the step lasts.
struct BodyDrive {
    bool gyroscopic = true;
    LockedAxes lock = {};
    Vec3 force =
        {};  // N, world, at the center of mass: the constant one and the user's for this step
    Vec3 torque = {};  // N m, world
    float gravity_scale = 1;
    float linear_damping = 0;
    float angular_damping = 0;

    friend bool operator==(const BodyDrive&, const BodyDrive&) = default;
};

BodyInertia make_inertia(const MassProperties& properties);

// How a body answers an impulse at one orientation: velocity change = inverse_mass * P (world axes,
// zero along locked ones) and inverse_inertia * (r x P).
struct Response {
    Vec3 inverse_mass;
    SymmetricMat3 inverse_inertia;  // world frame
};

Response find_response(const BodyInertia& inertia, const BodyDrive& drive, Quat rotation);

}  // namespace cairn

#pragma once
// One free substep of one body: velocities from forces, then poses from velocities.
//
// Semi-implicit Euler: v += h a, then x += h v with the new v. The orientation takes the
// exponential map, and a tumbling body's angular velocity turns with it so that its angular
// momentum stays where it is in the world and its energy what it was, both to rounding (see
// free_rotation).

#include "body/body.h"

namespace cairn {

// v += h (gravity_scale g + F/m), w += h I^-1 torque; then damping: v /= 1 + h c. Locked axes stay
// at zero.
void integrate_velocity(BodyMotion& motion, const BodyInertia& inertia, const BodyDrive& drive,
                        const Response& response, Vec3 gravity, float h);

// displacement += h v; rotation and angular velocity by free_rotation. Kinematic bodies move too.
void integrate_pose(BodyMotion& motion, const BodyInertia& inertia, const BodyDrive& drive,
                    float h);

// Turns `rotation` by the small rotation vector theta, world frame.
Quat turn(Quat rotation, Vec3 theta);

// Whether free rotation changes the body's angular velocity.
bool tumbles(const BodyInertia& inertia, const BodyDrive& drive);

// Torque-free rotation over h seconds. With W the angular velocity in the body frame, Wm the mean
// of its values before and after, and exp(h Wm) the turn that the body makes:
//
//     I W' = exp(-h Wm) I W,    q' = q exp(h Wm)
//
// so the world's q I W is the same before and after, and since E' - E = Wm . (I W' - I W), which is
// zero for a turn about Wm, so is the energy. (The implicit midpoint rule of Simo and Wong 1991,
// with the exponential in place of the Cayley map, which is what makes both conservation laws hold
// at once with an exact orientation for a steady spin.) Solved by Newton's method, in pieces of at
// most half a radian.
void free_rotation(Quat& rotation, Vec3& angular_velocity, const SymmetricMat3& inertia,
                   const SymmetricMat3& inverse_inertia, float h);

// The same for a body that turns by less than this many radians in h seconds, by the explicit
// midpoint rule in the body frame: what it leaves out is of the turn's third order, as small as
// rounding. Returns the steady angular velocity, world, that turns the body as far.
constexpr float slow_turn = 0.01f;
Vec3 tumble_slowly(Quat rotation, Vec3& angular_velocity, const SymmetricMat3& inertia,
                   const SymmetricMat3& inverse_inertia, float h);

}  // namespace cairn

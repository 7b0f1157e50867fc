#pragma once
// The geometry of contacts as a solver walks over it: arms and separations that follow the bodies
// through the substeps of one step, and how strongly each point resists. What a method adds up
// along the way it keeps in arrays of its own.
//
// Symbols: n normal from A to B; r_a, r_b arms from the centers of mass to one common point in the
// world, so that equal and opposite impulses there conserve angular momentum exactly; s separation;
// K(d) = d.(1/m_a + 1/m_b) d + (r_a x d).I_a^-1 (r_a x d) + (r_b x d).I_b^-1 (r_b x d).

#include <array>
#include <vector>

#include "constraint/step_problem.h"

namespace cairn {

struct PointRow {
    Vec3 r_a, r_b;          // now, to the common point
    float separation = 0;   // now
    Vec3 turn_a, turn_b;    // r x n: torque of a unit normal impulse
    Vec3 spin_a, spin_b;    // I^-1 (r x n): the angular velocity that it gives
    float normal_mass = 0;  // 1 / K(n)
    // 1 / the largest K across n: a step that never overshoots, in any direction.
    float tangent_mass = 0;
    bool alike_across = false;  // K is the same in every direction across n
};

// Where a point was when the step began; apart from the row, since no sweep looks at it.
struct PointStart {
    Arm arm_a, arm_b;
    Vec3 start_a, start_b;  // the arms
    float start_separation = 0;
};

struct ContactRows {
    std::uint32_t contact = 0;  // place in StepProblem::contacts
    std::uint32_t body_a = 0, body_b = 0;
    Vec3 normal;
    Vec3 surface_velocity;
    float friction = 0;
    float restitution = 0;
    float rolling_friction = 0;
    float spinning_friction = 0;
    float size = 0;
    bool stays_with_a = false;
    float rolling_mass = 0;   // 1 / the largest rotational response across n
    float spinning_mass = 0;  // 1 / the rotational response about n
    int point_count = 0;
    // How a unit normal impulse at point j changes the normal velocity at point i.
    std::array<std::array<float, 4>, 4> coupling = {};
    std::array<PointRow, 4> points;
    std::array<PointStart, 4> starts;
};

// Room for so many elements, which stays: a method that works on one group of islands after the
// other would else fill in the larger group's anew each time.
template <class Array>
void make_room(Array& array, std::size_t count) {
    if (array.size() < count) array.resize(count);
}

// One row set a contact, in the order of these places in StepProblem::contacts.
void prepare_rows(const StepProblem& problem, std::span<const std::uint32_t> contacts,
                  std::span<ContactRows> rows);

// Response of every body at its present orientation.
void find_responses(const StepProblem& problem, std::vector<Response>& responses);

// Arms, separations and the masses along n at the bodies' present poses.
void follow_bodies(const StepProblem& problem, std::span<const Response> responses,
                   ContactRows& row);
// The masses that friction works with, from the row's arms as they are.
void find_friction_masses(std::span<const Response> responses, ContactRows& row);
// Both, for every row.
void refresh_rows(const StepProblem& problem, std::span<const Response> responses,
                  std::span<ContactRows> rows);

// s at the bodies' present poses. Exact for any rotation: from the arms, never from positions.
inline float find_separation(const PointStart& p, Vec3 n, const BodyMotion& a,
                             const BodyMotion& b) {
    const Vec3 moved_a = a.displacement + (find_arm(p.arm_a, a.rotation) - p.start_a);
    const Vec3 moved_b = b.displacement + (find_arm(p.arm_b, b.rotation) - p.start_b);
    return p.start_separation + dot(n, moved_b - moved_a);
}

// Velocity of B's point less A's, surfaces at rest.
inline Vec3 relative_velocity(const BodyMotion& a, Vec3 r_a, const BodyMotion& b, Vec3 r_b) {
    return (b.linear_velocity + cross(b.angular_velocity, r_b)) -
           (a.linear_velocity + cross(a.angular_velocity, r_a));
}

// What cannot be pushed is not written to: nothing times what is not a number would not be nothing,
// and everything else in touch with the ground would go the same way.
inline bool is_pushed(const Response& response) {
    const SymmetricMat3& m = response.inverse_inertia;
    return response.inverse_mass != Vec3{} || m.xx != 0 || m.yy != 0 || m.zz != 0;
}

// Changes one body's velocity by an impulse at r and a turning impulse; `sign` is -1 for body A.
inline void push_body(BodyMotion& body, const Response& response, float sign, Vec3 impulse,
                      Vec3 spin) {
    if (!is_pushed(response)) return;
    body.linear_velocity += sign * multiply(response.inverse_mass, impulse);
    body.angular_velocity += sign * spin;
}

inline void apply_impulse(BodyMotion& a, const Response& response_a, Vec3 r_a, BodyMotion& b,
                          const Response& response_b, Vec3 r_b, Vec3 impulse) {
    push_body(a, response_a, -1, impulse, response_a.inverse_inertia * cross(r_a, impulse));
    push_body(b, response_b, 1, impulse, response_b.inverse_inertia * cross(r_b, impulse));
}

inline Vec3 without_normal(Vec3 v, Vec3 n) { return v - dot(v, n) * n; }

// v, shortened to `limit` where it is longer: friction's circle.
inline Vec3 clamp_length(Vec3 v, float limit) {
    const float squared = dot(v, v);
    return squared > limit * limit ? (limit / square_root(squared)) * v : v;
}

// The normal impulses of one manifold, solved together: finds l >= 0 near `loads` with
// velocity_i + sum_j coupling_ij (l_j - loads_j) + softness l_i >= 0, and zero where l_i > 0.
// Points of one face lean on each other; one after another they would tilt a box that should come
// to rest level. `loads` becomes l, `velocities` what is left.
void solve_normals(const ContactRows& rows, float softness, std::array<float, 4>& velocities,
                   std::array<float, 4>& loads);

// Four points on one face share a load in many ways that push and turn a body alike. Takes from
// `loads` the part that does nothing, as far as none becomes negative: the even sharing, which is
// also what friction should see.
void share_evenly(const ContactRows& rows, std::array<float, 4>& loads);

}  // namespace cairn

#pragma once
// Bodies as a sweep over rows sees them: velocities and what resists, together in one line of the
// cache. A row works on copies of its two, which a compiler may keep in registers, and writes their
// velocities back at the end.

#include <cstdint>
#include <span>

#include "solver/contact_rows.h"

namespace cairn {

struct alignas(64) SweptBody {
    Vec3 v, w;
    Vec3 inverse_mass;
    SymmetricMat3 inverse_inertia;
    std::uint32_t is_pushed = 0;  // what nothing pushes is never written to
};

inline SweptBody make_swept(const BodyMotion& motion, const Response& response) {
    return {.v = motion.linear_velocity,
            .w = motion.angular_velocity,
            .inverse_mass = response.inverse_mass,
            .inverse_inertia = response.inverse_inertia,
            .is_pushed = is_pushed(response)};
}

// The two bodies of a row.
struct SweptPair {
    SweptBody a, b;

    SweptPair(std::span<const SweptBody> bodies, const ContactRows& row)
        : a(bodies[row.body_a]), b(bodies[row.body_b]) {}

    void store(std::span<SweptBody> bodies, const ContactRows& row) const {
        if (a.is_pushed) {
            bodies[row.body_a].v = a.v;
            bodies[row.body_a].w = a.w;
        }
        if (b.is_pushed) {
            bodies[row.body_b].v = b.v;
            bodies[row.body_b].w = b.w;
        }
    }

    // Velocity of B's point less A's, surfaces at rest.
    Vec3 velocity_at(const PointRow& p) const {
        return (b.v + cross(b.w, p.r_b)) - (a.v + cross(a.w, p.r_a));
    }
    // The same along n, point by point; zero where there is none.
    std::array<float, 4> normal_velocities(const ContactRows& row) const {
        std::array<float, 4> velocities = {};
        const float linear = dot(row.normal, b.v - a.v);
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            const PointRow& p = row.points[i];
            velocities[i] = linear + dot(p.turn_b, b.w) - dot(p.turn_a, a.w);
        }
        return velocities;
    }

    void push(const PointRow& p, Vec3 impulse) {
        a.v -= multiply(a.inverse_mass, impulse);
        a.w -= a.inverse_inertia * cross(p.r_a, impulse);
        b.v += multiply(b.inverse_mass, impulse);
        b.w += b.inverse_inertia * cross(p.r_b, impulse);
    }
    // Normal impulses, one at each point.
    void push_apart(const ContactRows& row, const std::array<float, 4>& impulses) {
        float sum = 0;
        Vec3 spin_a, spin_b;
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            sum += impulses[i];
            spin_a += impulses[i] * row.points[i].spin_a;
            spin_b += impulses[i] * row.points[i].spin_b;
        }
        const Vec3 impulse = sum * row.normal;
        a.v -= multiply(a.inverse_mass, impulse);
        a.w -= spin_a;
        b.v += multiply(b.inverse_mass, impulse);
        b.w += spin_b;
    }
    // Equal and opposite turning impulses.
    void twist(Vec3 impulse) {
        a.w -= a.inverse_inertia * impulse;
        b.w += b.inverse_inertia * impulse;
    }
};

// What a substep's position corrections make of a body's pose, before it is moved by them.
struct Correction {
    Vec3 linear;
    Vec3 angular;
};

// How far the points' separations are changed by corrections so far, to first order.
inline std::array<float, 4> find_corrected(const ContactRows& row, const Correction& a,
                                           const Correction& b) {
    std::array<float, 4> changes = {};
    const float linear = dot(row.normal, b.linear - a.linear);
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        const PointRow& p = row.points[i];
        changes[i] = linear + dot(p.turn_b, b.angular) - dot(p.turn_a, a.angular);
    }
    return changes;
}

// Adds what multipliers along n, one at each point, move the two bodies by.
inline void correct_apart(const ContactRows& row, const std::array<float, 4>& multipliers,
                          std::span<const SweptBody> bodies, std::span<Correction> corrections) {
    float sum = 0;
    Vec3 spin_a, spin_b;
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        sum += multipliers[i];
        spin_a += multipliers[i] * row.points[i].spin_a;
        spin_b += multipliers[i] * row.points[i].spin_b;
    }
    const SweptBody& a = bodies[row.body_a];
    const SweptBody& b = bodies[row.body_b];
    if (a.is_pushed) {
        corrections[row.body_a].linear -= multiply(a.inverse_mass, sum * row.normal);
        corrections[row.body_a].angular -= spin_a;
    }
    if (b.is_pushed) {
        corrections[row.body_b].linear += multiply(b.inverse_mass, sum * row.normal);
        corrections[row.body_b].angular += spin_b;
    }
}

}  // namespace cairn

#pragma once
// A contact: the persistent meeting of two shapes, from the step in which they first come within
// reach to the step in which they part. Geometry is renewed every step; impulses live on, point by
// point, by feature id.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "math/quat.h"

namespace cairn {

// The arm from a body's center of mass to a contact point. `core` is fixed in the body (its frame)
// and turns with it; `offset` is fixed in the world: the point of a ball that touches does not turn
// with the ball, nor a capsule's, below its core.
struct Arm {
    Vec3 core;
    Vec3 offset;
};

inline Vec3 find_arm(const Arm& arm, Quat rotation) {
    return rotate(rotation, arm.core) + arm.offset;
}

// Four numbers a group: a solver reads and writes many of them side by side.
struct alignas(16) ContactPoint {
    Arm arm_a, arm_b;      // to the same place in the world, halfway between the surfaces
    float separation = 0;  // m at the step's start; a method may leave the one at its end
    std::uint32_t feature = 0;
    // What the solver found last, as forces (N), so that a change of the step's length changes
    // nothing: where the next step begins.
    float normal_force = 0;
    // What passed through the point over the whole last step (N s, on B), shocks included, and
    // `friction_impulse`: for reports.
    float normal_impulse = 0;
    Vec3 friction_force;  // world, on B
    std::uint32_t unused_0 = 0;
    Vec3 friction_impulse;
    std::uint32_t unused_1 = 0;
};
static_assert(sizeof(ContactPoint) == 96);

// Likewise.
struct Contact {
    std::uint64_t key = 0;
    std::uint32_t shape_a = 0, shape_b = 0;
    std::uint32_t body_a = 0, body_b = 0;
    int point_count = 0;
    bool touching = false;                            // after the last step
    bool conveys = false;                             // whether a surface has a velocity of its own
    bool turns_with_a = false, turns_with_b = false;  // whether a body's turn moves the points
    // Where the surfaces slide along each other within a step, the contact stays with this one's
    // feature: the round shape's lowest point, the smaller shape's corner.
    bool stays_with_a = false;
    // How deep the shapes overlapped when they met, m, as far as it is still borne.
    float first_overlap = 0;

    Vec3 normal = {0, 1, 0};  // unit, from A to B, world
    // What the contact has long borne, N, normal: what rests on it need not press it first.
    float remembered_load = 0;

    // The two surfaces together.
    float friction = 0;
    float restitution = 0;
    float rolling_friction = 0;
    float spinning_friction = 0;
    Vec3 surface_velocity;  // of B's surface less A's, world, beyond the bodies' own motion
    // The smaller of the shapes' smallest half extents: what lengths are measured by.
    float size = 0;

    Vec3 rolling_torque;        // N m on B, where the next step begins
    float spinning_torque = 0;  // N m on B about the normal
    Vec3 rolling_impulse;       // N m s on B over the last step
    float spinning_impulse = 0;

    std::array<ContactPoint, 4> points;
};

// Contacts lie in no order: one that will soon be read is asked for, with so many of its points.
// Compilers take a function that only asks for memory for one that does nothing, unless it is part
// of its caller; hence the attribute, here and wherever one is asked for.
[[gnu::always_inline]] inline void prefetch_contact(const Contact& contact, std::size_t points) {
    const auto* bytes = reinterpret_cast<const char*>(&contact);
    const std::size_t end = offsetof(Contact, points) + points * sizeof(ContactPoint);
    for (std::size_t i = 0; i < end; i += 64) __builtin_prefetch(bytes + i);
}
// While so many others are worked on.
constexpr std::size_t contacts_ahead = 6;

// visit(contact, k) for k in [begin, end), the contact at places[k]; the ones that come next are
// asked for meanwhile.
template <class SomeContact, class Visit>
void visit_contacts(std::span<SomeContact> contacts, std::span<const std::uint32_t> places,
                    std::size_t begin, std::size_t end, std::size_t points, Visit&& visit) {
    for (std::size_t k = begin; k < end; ++k) {
        if (k + contacts_ahead < end)
            prefetch_contact(contacts[places[k + contacts_ahead]], points);
        visit(contacts[places[k]], k);
    }
}
template <class SomeContact, class Visit>
void visit_contacts(std::span<SomeContact> contacts, std::span<const std::uint32_t> places,
                    std::size_t points, Visit&& visit) {
    visit_contacts(contacts, places, 0, places.size(), points, visit);
}

// The points' impulses over the last step, and the contact's own, become zero.
void clear_impulses(Contact& contact);

}  // namespace cairn

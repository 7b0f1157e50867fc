#pragma once
// What a solver is given, and what it gives back: data only, and how things must be, never how to
// get there.
//
// Bodies are named by their place in the spans. A contact pushes body B along the normal with an
// impulse that is never negative, body A with the opposite one; across the normal the impulse stays
// within friction times that. A solver advances velocities, rotations and displacements over dt,
// and leaves in every contact the forces to begin the next step with and the impulses of the whole
// step.

#include <cstdint>
#include <span>

#include "base/scheduler.h"
#include "body/body.h"
#include "contact/contact.h"

namespace cairn {

struct StepProblem {
    std::span<BodyMotion> motions = {};
    std::span<const BodyInertia> inertias = {};
    std::span<const BodyDrive> drives = {};
    // Of the centers of mass against gravity when the step began, m.
    std::span<const float> heights = {};
    // Kinematic and dynamic bodies, ascending.
    std::span<const std::uint32_t> moving = {};
    std::span<Contact> contacts;
    // The contacts with points, in ascending order of their keys.
    std::span<const std::uint32_t> active = {};
    bool is_one_island = false;  // all bodies that can be pushed certainly hang together

    Vec3 gravity;
    double dt = 0;
    int substeps = 1;
    int iterations = 1;
    float restitution_threshold = 1;  // m/s
    float contact_compliance = 0;     // m/N
    int lanes = 0;         // at most so many rows side by side; 0: as many as the machine can
    Team* team = nullptr;  // who shares the loops whose order does not matter; null: nobody

    // kernel(begin, end) over blocks of [0, count).
    template <class Kernel>
    void for_range(std::size_t count, int block_size, Kernel&& kernel) const {
        if (!team) return kernel(0, int(count));
        team->for_range(int(count), block_size,
                        [&](int begin, int end, int) { kernel(begin, end); });
    }
};

}  // namespace cairn

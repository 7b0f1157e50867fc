#pragma once
// Which bodies a step has to do with: what falls asleep, what wakes, and why.
//
// A body moves when it is dynamic and awake, or kinematic with a velocity: only such bodies, their
// shapes, pairs and contacts are seen by a step. Dynamic bodies that exchange impulses, or could in
// this step (a contact with points is a link), lie in one island, which sleeps when every body in
// it has stood still (island/stillness.h) and may sleep, and then all of it at once: so nothing
// that moves ever pushes something that sleeps. Its contacts are put aside with all that they
// remember and come back as they were.
//
// What sleeps wakes when
// - a contact with something that moves has points, in the same step;
// - it is changed, or pushed, or something that it is in contact with is changed or destroyed;
// - gravity changes, or sleeping is switched off.
// A change that changes nothing (a force of zero) wakes nothing.
//
// Reads and writes: WorldState::rest, the contacts that are put aside, and the velocities of what
// falls asleep.

#include <cstdint>

#include "world/world_state.h"

namespace cairn {

// Called after whatever decides it changed: the kind, the velocity of a kinematic body, frozen or
// not, created or about to be destroyed (alive is false then).
void update_membership(WorldState& world, std::uint32_t body);
// After mass or shapes changed.
void measure_extent(WorldState& world, std::uint32_t body);

// Wakes the island of a body, if it is asleep; it will be watched anew either way.
void wake(WorldState& world, std::uint32_t body);
// The same for all that the body is in contact with.
void wake_neighbours(WorldState& world, std::uint32_t body);
// Both; and the next step looks at the body's shapes, moving or not.
void note_change(WorldState& world, std::uint32_t body);
void wake_all(WorldState& world);
// Puts a body's island to sleep.
void put_to_sleep(WorldState& world, std::uint32_t body);

inline bool moves(const WorldState& world, std::uint32_t body) {
    return (world.rest.states[body] & RestState::is_moving) != 0;
}
inline bool is_asleep(const WorldState& world, std::uint32_t body) {
    return world.rest.islands.is_there(body) && !moves(world, body);
}
// Whether the step looks for the body's pairs: it moves, or was changed since the last step.
inline bool is_looked_at(const WorldState& world, std::uint32_t body) {
    return world.rest.states[body] != 0;
}

// Brings the list of moving bodies up to date.
void list_moving(WorldState& world);

// Links the contacts that have points; true where that woke something. What was changed counts as
// looked at from here on.
bool link_contacts(WorldState& world);
// Watches what moves, and puts to sleep the islands that stand still.
void find_sleepers(WorldState& world, double dt);
// What the contact linked is linked by it no longer: to be called before a contact ends.
void unlink_contact(WorldState& world, std::uint32_t slot);

}  // namespace cairn

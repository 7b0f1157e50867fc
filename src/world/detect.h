#pragma once
// Detection: which shapes meet, along which axis, at which points. The first three stages of a
// step, and what World::contacts() measures anew between steps.

#include "world/world_state.h"

namespace cairn {

// One proxy a living shape: its box, grown by what the shape may reach in dt seconds.
void update_proxies(const WorldState& world, double dt, std::vector<Proxy>& proxies);

// The pairs of shapes that may touch: boxes overlap, bodies differ, filters agree. Sorted, and the
// same whichever broad phase finds them: the tree's pairs of fat boxes are put to the same test.
void find_all_pairs(const WorldState& world, BruteForce& broad, std::span<const Proxy> proxies,
                    std::vector<Pair>& pairs);
void find_tree_pairs(WorldState& world, double dt, std::span<const Proxy> proxies,
                     std::vector<Pair>& pairs);

// Who meets, and what their surfaces do together.
void describe_contact(const WorldState& world, Contact& contact);

// Renews contact.axis. False, and no axis, where the numbers are beyond binary32.
bool find_contact_axis(const WorldState& world, Contact& contact);

// Up to four world-frame points along contact.axis, with no impulses yet; the contact's normal is
// renewed. Points farther apart than `max_separation` are left out. Returns their number.
int build_contact_points(const WorldState& world, Contact& contact, float max_separation,
                         std::array<ContactPoint, 4>& points);

// How far apart two shapes may be and still touch within dt seconds, by their velocities along the
// normal, their spins, and gravity; never less than a small share of their size.
float speculative_distance(const WorldState& world, const Contact& contact, double dt);

}  // namespace cairn

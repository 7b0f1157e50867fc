// Gathering and scattering; see dense_bodies.h.

#include "world/dense_bodies.h"

#include <algorithm>

#include "world/world_state.h"

namespace cairn {

bool DenseBodies::pays(const WorldState& world) {
    // Two bodies a contact at most, of which one moves.
    const std::size_t most = world.scratch.moving.size() + world.scratch.active.size();
    return 4 * most < world.bodies.size();
}

void DenseBodies::list(std::uint32_t body) {
    if (is_listed(body)) return;
    places_[body] = std::uint32_t(slots_.size());
    slots_.push_back(body);
}

void DenseBodies::gather(WorldState& world) {
    slots_.clear();
    places_.resize(world.bodies.size());
    for (const std::uint32_t body : world.scratch.moving) list(body);
    for (const std::uint32_t slot : world.scratch.active) {
        list(world.contacts[slot].body_a);
        list(world.contacts[slot].body_b);
    }
    std::sort(slots_.begin(), slots_.end());
    motions.clear();
    inertias.clear();
    drives.clear();
    heights.clear();
    moving.clear();
    for (const std::uint32_t body : slots_) {
        places_[body] = std::uint32_t(motions.size());
        motions.push_back(world.motions[body]);
        inertias.push_back(world.inertias[body]);
        drives.push_back(world.drives[body]);
        heights.push_back(world.scratch.heights[body]);
    }
    for (const std::uint32_t body : world.scratch.moving) moving.push_back(places_[body]);
    for (const std::uint32_t slot : world.scratch.active) {
        Contact& contact = world.contacts[slot];
        contact.body_a = places_[contact.body_a];
        contact.body_b = places_[contact.body_b];
    }
}

void DenseBodies::scatter(WorldState& world) const {
    for (const std::uint32_t place : moving) world.motions[slots_[place]] = motions[place];
    for (const std::uint32_t slot : world.scratch.active) {
        Contact& contact = world.contacts[slot];
        contact.body_a = slots_[contact.body_a];
        contact.body_b = slots_[contact.body_b];
    }
}

}  // namespace cairn

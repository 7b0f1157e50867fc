// Gathering and scattering; see dense_bodies.h.

#include "world/dense_bodies.h"

#include "world/step_groups.h"
#include "world/world_state.h"

namespace cairn {

void DenseBodies::add(const WorldState& world, std::uint32_t body) {
    places_[body] = std::uint32_t(slots_.size());
    slots_.push_back(body);
    motions_.push_back(motion_of(world, body));
    inertias_.push_back(inertia_of(world, body));
    drives_.push_back(drive_of(world, body));
    // An order alone, so that binary32 is enough.
    const Position& p = world.positions[body];
    heights_.push_back(float(double(up_.x) * p.x + double(up_.y) * p.y + double(up_.z) * p.z));
}

std::uint32_t DenseBodies::place_guest(const WorldState& world, std::uint32_t body) {
    if (is_listed(body)) return places_[body];
    if (world.bodies[body].kind == BodyKind::Kinematic)
        moving_.push_back(std::uint32_t(slots_.size()));
    add(world, body);
    return places_[body];
}

void DenseBodies::gather(WorldState& world, const StepGroup& group, StepProblem& problem) {
    up_ = normalize_or(-world.settings.gravity, {});
    slots_.clear();
    motions_.clear();
    inertias_.clear();
    drives_.clear();
    heights_.clear();
    moving_.clear();
    places_.reserve(world.bodies.capacity());
    places_.resize(world.bodies.size());
    for (const std::uint32_t body : group.moving) {
        moving_.push_back(std::uint32_t(slots_.size()));
        add(world, body);
    }
    visit_contacts(world.contacts.slots(), group.active, 0, [&](Contact& contact, std::size_t) {
        contact.body_a = place_guest(world, contact.body_a);
        contact.body_b = place_guest(world, contact.body_b);
    });
    problem.motions = motions_;
    problem.inertias = inertias_;
    problem.drives = drives_;
    problem.heights = heights_;
    problem.moving = moving_;
    problem.active = group.active;
}

void DenseBodies::scatter(WorldState& world, const StepGroup& group) const {
    // The group's own bodies came first.
    for (std::size_t i = 0; i < group.moving.size(); ++i)
        set_motion(world, group.moving[i], motions_[i]);
    visit_contacts(world.contacts.slots(), group.active, 0, [&](Contact& contact, std::size_t) {
        contact.body_a = slots_[contact.body_a];
        contact.body_b = slots_[contact.body_b];
    });
}

}  // namespace cairn

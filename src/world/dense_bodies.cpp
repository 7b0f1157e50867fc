// Gathering and scattering; see dense_bodies.h.

#include "world/dense_bodies.h"

#include "world/step_groups.h"
#include "world/world_state.h"

namespace cairn {

namespace {

constexpr int bodies_a_block = 128;
constexpr int contacts_a_block = 256;

}  // namespace

void DenseBodies::resize(std::size_t count) {
    slots_.resize(count);
    motions_.resize(count);
    inertias_.resize(count);
    drives_.resize(count);
    heights_.resize(count);
}

void DenseBodies::copy(const WorldState& world, std::uint32_t body, std::size_t place) {
    places_[body] = std::uint32_t(place);
    slots_[place] = body;
    motions_[place] = motion_of(world, body);
    inertias_[place] = inertia_of(world, body);
    drives_[place] = drive_of(world, body);
    // An order alone, so that binary32 is enough.
    const Position& p = world.positions[body];
    heights_[place] = float(double(up_.x) * p.x + double(up_.y) * p.y + double(up_.z) * p.z);
}

std::uint32_t DenseBodies::place_guest(const WorldState& world, std::uint32_t body) {
    if (is_listed(body)) return places_[body];
    const std::size_t place = slots_.size();
    if (world.bodies[body].kind == BodyKind::Kinematic) moving_.push_back(std::uint32_t(place));
    resize(place + 1);
    copy(world, body, place);
    return places_[body];
}

void DenseBodies::gather(WorldState& world, const StepGroup& group, StepProblem& problem) {
    up_ = normalize_or(-world.settings.gravity, {});
    places_.reserve(world.bodies.capacity());
    places_.resize(world.bodies.size());
    resize(group.moving.size());
    moving_.resize(group.moving.size());
    problem.for_range(group.moving.size(), bodies_a_block, [&](int begin, int end) {
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
            moving_[i] = std::uint32_t(i);
            copy(world, group.moving[i], i);
        }
    });
    const std::span<Contact> contacts = world.contacts.slots();
    has_guest_.resize(group.active.size());
    problem.for_range(group.active.size(), contacts_a_block, [&](int begin, int end) {
        visit_contacts(contacts, group.active, std::size_t(begin), std::size_t(end), 0,
                       [&](Contact& contact, std::size_t k) {
                           has_guest_[k] = !is_listed(contact.body_a) || !is_listed(contact.body_b);
                           if (has_guest_[k] != 0) return;
                           contact.body_a = places_[contact.body_a];
                           contact.body_b = places_[contact.body_b];
                       });
    });
    for (std::size_t k = 0; k < has_guest_.size(); ++k) {
        if (has_guest_[k] == 0) continue;
        Contact& contact = contacts[group.active[k]];
        contact.body_a = place_guest(world, contact.body_a);
        contact.body_b = place_guest(world, contact.body_b);
    }
    problem.motions = motions_;
    problem.inertias = inertias_;
    problem.drives = drives_;
    problem.heights = heights_;
    problem.moving = moving_;
    problem.active = group.active;
    problem.is_one_island = group.is_one_island;
}

void DenseBodies::scatter(WorldState& world, const StepGroup& group,
                          const StepProblem& problem) const {
    // The group's own bodies came first.
    problem.for_range(group.moving.size(), bodies_a_block, [&](int begin, int end) {
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
            set_motion(world, group.moving[i], motions_[i]);
    });
    problem.for_range(group.active.size(), contacts_a_block, [&](int begin, int end) {
        visit_contacts(world.contacts.slots(), group.active, std::size_t(begin), std::size_t(end),
                       0, [&](Contact& contact, std::size_t) {
                           contact.body_a = slots_[contact.body_a];
                           contact.body_b = slots_[contact.body_b];
                       });
    });
}

}  // namespace cairn

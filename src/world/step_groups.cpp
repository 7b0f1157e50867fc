// Islands by union and find, and groups of them; see step_groups.h.

#include "world/step_groups.h"

#include <algorithm>
#include <bit>

#include "world/world_state.h"

namespace cairn {

namespace {

// A group takes islands until it has so many contacts or bodies: rows and bodies of a few hundred
// kilobytes.
constexpr std::uint32_t full = 512;
constexpr int contacts_a_block = 256;

bool is_pushed(const WorldState& world, std::uint32_t body) {
    return inertia_of(world, body).inverse_mass > 0;
}

// Islands of one kind may share a group.
std::uint32_t find_kind(std::uint32_t contacts, float smallest, bool is_new) {
    if (contacts == 0) return 0;
    const std::uint32_t octave = std::bit_cast<std::uint32_t>(smallest) >> 23u;
    return 2 * octave + (is_new ? 3 : 2);
}

}  // namespace

StepGroup StepGroups::operator[](std::size_t group) const {
    const Range& from = groups_[group];
    const Range& to = groups_[group + 1];
    const std::uint32_t moving = to.moving - from.moving, active = to.active - from.active;
    return {std::span(moving_).subspan(from.moving, moving),
            std::span(active_).subspan(from.active, active), std::max(moving, active) > full};
}

void StepGroups::form(const WorldState& world, Team& team) {
    read_contacts(world, team);
    join_bodies(world);
    measure_islands(world);
    give_groups();
    fill_lists(world);
}

std::uint32_t StepGroups::find_root(std::uint32_t mobile) {
    while (parents_[mobile] != mobile) {
        parents_[mobile] = parents_[parents_[mobile]];
        mobile = parents_[mobile];
    }
    return mobile;
}

void StepGroups::read_contacts(const WorldState& world, Team& team) {
    const auto pushed = [&](std::uint32_t body) {
        return is_pushed(world, body) ? world.bodies[body].mobile : none;
    };
    edges_.resize(world.scratch.active.size());
    const std::span<const std::uint32_t> active = world.scratch.active;
    team.for_range(int(active.size()), contacts_a_block, [&](int begin, int end, int) {
        visit_contacts(world.contacts.slots(), active, std::size_t(begin), std::size_t(end), 0,
                       [&](const Contact& contact, std::size_t k) {
                           edges_[k] = {.mobile_a = pushed(contact.body_a),
                                        .mobile_b = pushed(contact.body_b),
                                        .size = contact.size,
                                        .touching = contact.touching};
                       });
    });
}

// Of two roots the lower one stays.
void StepGroups::join_bodies(const WorldState& world) {
    parents_.resize(world.mobiles.size());
    for (const std::uint32_t body : world.scratch.moving) {
        const std::uint32_t mobile = world.bodies[body].mobile;
        parents_[mobile] = mobile;
    }
    for (const Edge& edge : edges_) {
        if (edge.mobile_a == none || edge.mobile_b == none) continue;
        const std::uint32_t a = find_root(edge.mobile_a);
        const std::uint32_t b = find_root(edge.mobile_b);
        parents_[std::max(a, b)] = std::min(a, b);
    }
}

std::uint32_t StepGroups::island_of(const Edge& edge) const {
    if (edge.mobile_a != none) return island_[edge.mobile_a];
    return edge.mobile_b != none ? island_[edge.mobile_b] : none;
}

void StepGroups::measure_islands(const WorldState& world) {
    islands_.clear();
    island_.resize(world.mobiles.size());
    for (const std::uint32_t body : world.scratch.moving) island_[world.bodies[body].mobile] = none;
    // An island is numbered when its first body is met.
    for (const std::uint32_t body : world.scratch.moving) {
        if (!is_pushed(world, body)) continue;
        const std::uint32_t mobile = world.bodies[body].mobile;
        std::uint32_t& number = island_[find_root(mobile)];
        if (number == none) {
            number = std::uint32_t(islands_.size());
            islands_.emplace_back();
        }
        island_[mobile] = number;
        ++islands_[number].bodies;
    }
    for (const Edge& edge : edges_) {
        const std::uint32_t number = island_of(edge);
        if (number == none) continue;
        Island& island = islands_[number];
        island.smallest = island.contacts == 0 ? edge.size : min(island.smallest, edge.size);
        island.is_new = island.is_new || !edge.touching;
        ++island.contacts;
    }
}

void StepGroups::give_groups() {
    open_.clear();
    group_count_ = 0;
    for (Island& island : islands_) {
        if (std::max(island.bodies, island.contacts) >= full) {
            island.group = group_count_++;
            continue;
        }
        const std::uint32_t kind = find_kind(island.contacts, island.smallest, island.is_new);
        auto open = std::find_if(open_.begin(), open_.end(),
                                 [&](const OpenGroup& group) { return group.kind == kind; });
        if (open == open_.end()) {
            open_.push_back({.kind = kind, .group = group_count_++});
            open = open_.end() - 1;
        }
        if (std::max(open->bodies + island.bodies, open->contacts + island.contacts) > full)
            *open = {.kind = kind, .group = group_count_++};
        open->bodies += island.bodies;
        open->contacts += island.contacts;
        island.group = open->group;
    }
}

// A counting sort of the two lists by group; kinematic bodies come last.
void StepGroups::fill_lists(const WorldState& world) {
    groups_.assign(group_count_ + 2, {});
    const auto group_of = [&](std::uint32_t body) {
        const std::uint32_t island = island_[world.bodies[body].mobile];
        return island == none ? group_count_ : islands_[island].group;
    };
    for (const std::uint32_t body : world.scratch.moving) ++groups_[group_of(body) + 1].moving;
    for (const Island& island : islands_) groups_[island.group + 1].active += island.contacts;
    for (std::size_t i = 1; i < groups_.size(); ++i) {
        groups_[i].moving += groups_[i - 1].moving;
        groups_[i].active += groups_[i - 1].active;
    }
    moving_.resize(groups_.back().moving);
    active_.resize(groups_.back().active);
    next_ = groups_;
    for (const std::uint32_t body : world.scratch.moving)
        moving_[next_[group_of(body)].moving++] = body;
    for (std::size_t k = 0; k < edges_.size(); ++k) {
        const std::uint32_t island = island_of(edges_[k]);
        // What two bodies that cannot be pushed do to each other is nothing.
        if (island != none)
            active_[next_[islands_[island].group].active++] = world.scratch.active[k];
    }
}

}  // namespace cairn

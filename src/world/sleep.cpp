// Falling asleep and waking; see sleep.h.

#include "world/sleep.h"

#include <algorithm>
#include <iterator>

#include "world/detect.h"

namespace cairn {

namespace {

// An island that may have come apart while some of it moves is looked over once in so many steps:
// more often finds what has left sooner, and costs a walk through all its links.
constexpr std::uint64_t steps_between_looks = 8;

void start_moving(WorldState& world, std::uint32_t body) {
    if (moves(world, body)) return;
    world.rest.states[body] |= RestState::is_moving;
    world.rest.starting.push_back(body);
    world.rest.stale.push_back(body);
}

void stop_moving(WorldState& world, std::uint32_t body) {
    if (!moves(world, body)) return;
    world.rest.states[body] &= std::uint8_t(~RestState::is_moving);
    world.rest.any_stopped = world.rest.any_idle = true;
    const std::uint32_t mobile = world.bodies[body].mobile;
    world.travels[mobile].displacement = {};
    world.rest.stale.push_back(body);
    world.ways[mobile].horizon = world.ways[mobile].gone;
}

Sleeper& sleeper_of(WorldState& world, std::uint32_t body) {
    return world.rest.sleepers[world.rest.islands.place_of(body)];
}

void watch_anew(WorldState& world, std::uint32_t body) {
    stir(sleeper_of(world, body).stillness, world.rotations[body]);
}

std::uint32_t other_body(const Contact& contact, std::uint32_t body) {
    return contact.body_a == body ? contact.body_b : contact.body_a;
}

// Whether nothing drives the body, or something bears it. What falls from rest in a gravity too
// feeble to be seen is still, and must not stay in the air.
bool is_in_balance(const WorldState& world, std::uint32_t body) {
    if (world.contacts.has_contacts(body)) return true;
    const BodyDrive& drive = drive_of(world, body);
    return drive.gravity_scale * world.settings.gravity == Vec3{} && drive.force == Vec3{} &&
           drive.torque == Vec3{};
}

void sleep_island(WorldState& world, std::uint32_t island) {
    world.rest.islands.visit_bodies(island, [&](std::uint32_t body) {
        BodyTravel& travel = world.travels[world.bodies[body].mobile];
        travel.linear_velocity = travel.angular_velocity = {};
        forget_step_forces(world, body);
        stop_moving(world, body);
    });
}

bool is_all_still(const WorldState& world, std::uint32_t island) {
    const RestState& rest = world.rest;
    bool all = true;
    rest.islands.visit_bodies(island, [&](std::uint32_t body) {
        all = all && rest.sleepers[rest.islands.place_of(body)].still;
    });
    return all;
}

// Takes note of the step that each body has made.
void watch_bodies(WorldState& world, float dt) {
    for (const std::uint32_t body : world.rest.movers) {
        if (!world.rest.islands.is_there(body)) continue;
        const BodyMotion motion = motion_of(world, body);
        Sleeper& sleeper = sleeper_of(world, body);
        watch(sleeper.stillness,
              {motion.displacement, motion.rotation, motion.linear_velocity,
               motion.angular_velocity, dt},
              sleeper.extent, world.settings.sleep_time);
    }
    // What a moving belt or lift touches is not left to itself, however still it is.
    for (const std::uint32_t body : world.rest.movers) {
        if (world.rest.islands.is_there(body)) continue;
        world.contacts.visit_contacts(body, [&](std::uint32_t slot) {
            const std::uint32_t other = other_body(world.contacts[slot], body);
            if (world.rest.islands.is_there(other)) watch_anew(world, other);
        });
    }
}

// Says of each body that moves whether it is still; lists the islands in which some are.
void list_candidates(WorldState& world) {
    RestState& rest = world.rest;
    rest.candidates.clear();
    rest.verdicts.resize(rest.islands.island_end());
    for (const std::uint32_t body : rest.movers) {
        if (!rest.islands.is_there(body)) continue;
        Sleeper& sleeper = sleeper_of(world, body);
        sleeper.still = world.bodies[body].can_sleep &&
                        is_still(sleeper.stillness, sleeper.extent) && is_in_balance(world, body);
        RestState::Verdict& verdict = rest.verdicts[rest.islands.island_of(body)];
        if (verdict.step != world.report.step)
            verdict = {.step = world.report.step, .all = true, .any = false};
        verdict.all = verdict.all && sleeper.still;
        if (sleeper.still && !verdict.any) rest.candidates.push_back(rest.islands.island_of(body));
        verdict.any = verdict.any || sleeper.still;
    }
}

}  // namespace

void update_membership(WorldState& world, std::uint32_t body) {
    RestState& rest = world.rest;
    const BodyRecord& record = world.bodies[body];
    const BodyKind kind = record.kind;
    const bool is_free = record.alive && !record.frozen;
    const bool is_member = is_free && kind == BodyKind::Dynamic;
    if (!is_member && rest.islands.is_there(body)) {
        world.contacts.visit_contacts(body,
                                      [&](std::uint32_t slot) { unlink_contact(world, slot); });
        rest.islands.remove_body(body);
    }
    if (is_member && rest.islands.add_body(body)) {
        rest.sleepers.resize(rest.islands.place_end());
        measure_extent(world, body);
        watch_anew(world, body);
        start_moving(world, body);
    }
    if (is_member) return;
    const BodyTravel& travel = travel_of(world, body);
    const bool goes = travel.linear_velocity != Vec3{} || travel.angular_velocity != Vec3{};
    if (is_free && kind == BodyKind::Kinematic && goes)
        start_moving(world, body);
    else
        stop_moving(world, body);
}

void measure_extent(WorldState& world, std::uint32_t body) {
    if (!world.rest.islands.is_there(body)) return;
    float thickness = 0, reach = 0;
    visit_shapes(world, body, [&](std::uint32_t slot) {
        thickness = max(thickness, world.shapes[slot].size);
        reach = max(reach, world.shapes[slot].reach);
    });
    // Mass may lie beyond the shapes, or there may be none.
    const MassProperties& mass = mass_of(world, body);
    const SymmetricMat3& inertia = mass.inertia;
    const float largest = max(inertia.xx, max(inertia.yy, inertia.zz));
    if (mass.mass > 0) reach = max(reach, square_root(largest / mass.mass));
    sleeper_of(world, body).extent = {.size = square_root(thickness) * square_root(reach),
                                      .reach = reach};
}

void wake(WorldState& world, std::uint32_t body) {
    RestState& rest = world.rest;
    if (!rest.islands.is_there(body)) return;
    if (moves(world, body)) return watch_anew(world, body);
    rest.islands.visit_bodies(rest.islands.island_of(body), [&](std::uint32_t one) {
        start_moving(world, one);
        watch_anew(world, one);
        world.contacts.visit_contacts(one,
                                      [&](std::uint32_t slot) { world.contacts.take_back(slot); });
    });
}

void wake_neighbours(WorldState& world, std::uint32_t body) {
    world.contacts.visit_contacts(
        body, [&](std::uint32_t slot) { wake(world, other_body(world.contacts[slot], body)); });
}

void note_change(WorldState& world, std::uint32_t body) {
    wake(world, body);
    wake_neighbours(world, body);
    world.rest.states[body] |= RestState::is_changed;
    world.rest.changed.push_back(body);
    world.rest.stale.push_back(body);
}

void wake_all(WorldState& world) {
    for (std::uint32_t body = 0; body < world.bodies.size(); ++body) wake(world, body);
}

void put_to_sleep(WorldState& world, std::uint32_t body) {
    RestState& rest = world.rest;
    if (!rest.islands.is_there(body) || !moves(world, body)) return;
    rest.islands.split(rest.islands.island_of(body), rest.parts);
    sleep_island(world, rest.islands.island_of(body));
}

void list_moving(WorldState& world) {
    RestState& rest = world.rest;
    if (rest.starting.empty() && !rest.any_stopped) return;
    rest.any_stopped = false;
    std::sort(rest.starting.begin(), rest.starting.end());
    rest.merged.clear();
    std::set_union(rest.movers.begin(), rest.movers.end(), rest.starting.begin(),
                   rest.starting.end(), std::back_inserter(rest.merged));
    rest.starting.clear();
    rest.movers.clear();
    for (const std::uint32_t body : rest.merged) {
        // One that stopped and started again is listed twice.
        const bool is_listed = !rest.movers.empty() && rest.movers.back() == body;
        if (moves(world, body) && !is_listed) rest.movers.push_back(body);
    }
}

void unlink_contact(WorldState& world, std::uint32_t slot) {
    RestState& rest = world.rest;
    if (slot >= rest.links.size() || rest.links[slot] == Islands::none) return;
    rest.islands.remove_link(rest.links[slot]);
    rest.links[slot] = Islands::none;
}

bool link_contacts(WorldState& world) {
    RestState& rest = world.rest;
    rest.links.resize(world.contacts.slots().size(), Islands::none);
    rest.islands.reserve_links(world.scratch.active.size());
    for (const std::uint32_t slot : world.scratch.active) {
        if (rest.links[slot] != Islands::none) continue;
        const std::uint32_t a = world.contacts[slot].body_a;
        const std::uint32_t b = world.contacts[slot].body_b;
        if (is_asleep(world, a)) wake(world, a);
        if (is_asleep(world, b)) wake(world, b);
        rest.links[slot] = rest.islands.add_link(a, b);
    }
    for (const std::uint32_t body : rest.changed)
        rest.states[body] &= std::uint8_t(~RestState::is_changed);
    rest.any_idle = rest.any_idle || !rest.changed.empty();
    forget(rest.changed);
    return !rest.starting.empty();
}

void find_sleepers(WorldState& world, double dt) {
    RestState& rest = world.rest;
    std::size_t asleep = rest.islands.body_count();
    for (const std::uint32_t body : rest.movers) asleep -= rest.islands.is_there(body) ? 1 : 0;
    if (world.settings.sleeping) {
        watch_bodies(world, float(dt));
        list_candidates(world);
        for (const std::uint32_t island : rest.candidates) {
            const bool is_due = (world.report.step + island) % steps_between_looks == 0;
            if (!rest.verdicts[island].all && !(is_due && rest.islands.may_have_parted(island)))
                continue;
            rest.islands.split(island, rest.parts);
            for (const std::uint32_t part : rest.parts) {
                if (!is_all_still(world, part)) continue;
                asleep += rest.islands.body_count(part);
                sleep_island(world, part);
            }
        }
    }
    world.report.asleep_count = asleep;
    world.report.awake_count = rest.islands.body_count() - asleep;
}

}  // namespace cairn

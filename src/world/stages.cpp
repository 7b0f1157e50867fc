// The stages of a step. Each says what it reads and what it writes.

#include "world/stages.h"

#include <algorithm>
#include <chrono>

#include "world/detect.h"
#include "world/sleep.h"

namespace cairn {

namespace {

// Adds the wall time of its own life to one stage of the report, and to the trace, if there is
// one, under a name of its own. Times are no part of the state.
class StageTimer {
public:
    StageTimer(WorldState& world, Stage stage, const char* name)
        : seconds_(world.report.stage_seconds[std::size_t(stage)]),
          start_(Clock::now()),
          scope_(world.trace.get(), 0, name) {
        if (StageTrace* trace = world.trace.get()) trace->enter_stage(name);
    }
    ~StageTimer() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

private:
    using Clock = std::chrono::steady_clock;
    double& seconds_;
    Clock::time_point start_;
    TraceScope scope_;
};

// Beyond these, products of two numbers leave binary32 and take everything in touch with them
// along.
constexpr float fastest = 1e15f;
constexpr double farthest = 1e15;

bool is_sound(Vec3 velocity) {
    return is_finite(velocity) &&
           max(absolute(velocity).x, max(absolute(velocity).y, absolute(velocity).z)) <= fastest;
}

bool is_sound(Position p) {
    const auto within = [](double x) { return x >= -farthest && x <= farthest; };
    return within(p.x) && within(p.y) && within(p.z);
}

// Stands the body still for good, where and as it was; the others go on without its impulses.
void freeze(WorldState& world, std::uint32_t slot, Quantity quantity) {
    world.bodies[slot].frozen = true;
    const std::uint32_t mobile = world.bodies[slot].mobile;
    world.inertias[mobile] = {};
    world.travels[mobile].linear_velocity = world.travels[mobile].angular_velocity = {};
    update_membership(world, slot);
    world.non_finite.push_back(
        {body_id(world, slot), world.report.step, world.report.time, quantity});
}

// A contact without points: nothing is left of it but that it touched, until that is reported.
void clear_contact(Contact& contact) {
    contact.point_count = 0;
    contact.remembered_load = 0;
    contact.rolling_torque = {};
    contact.spinning_torque = 0;
    contact.rolling_impulse = {};
    contact.spinning_impulse = 0;
}

bool is_touching(const Contact& contact) {
    for (int i = 0; i < contact.point_count; ++i) {
        const ContactPoint& p = contact.points[std::size_t(i)];
        if (p.separation <= 0 || p.normal_impulse > 0) return true;
    }
    return false;
}

// What find_axis_of_pair will read to follow the pair's face.
[[gnu::always_inline]] inline void prefetch_face(const WorldState& world,
                                                 std::span<const PairRecord> pairs, std::size_t i) {
    if (i >= pairs.size() || !pairs[i].shows_face) return;
    const PairRecord& pair = pairs[i];
    world.contacts.prefetch(pair.contact, 4);
    world.contacts.prefetch_sighting(pair.contact);
}

// The axis of a pair, or its points from an earlier step's.
void find_axis_of_pair(WorldState& world, double dt, PairRecord& pair, Meeting& meeting) {
    const bool may_follow = world.settings.step.reuse_contacts;
    const bool has_contact = pair.contact != ContactStore::none;
    pair.is_found = false;
    pair.meets = has_contact && may_follow && follow_contact(world, pair);
    if (pair.meets || (!has_contact && may_follow && is_apart(world, pair))) return;
    const bool is_sound =
        find_meeting(world, pair.shape_a, pair.shape_b, dt, false, pair.hint, meeting);
    pair.meets = pair.is_found = is_sound && meeting.axis.separation <= meeting.within;
    if (pair.meets) return;
    if (is_sound) remember_apart(world, pair, meeting.axis.separation);
    if (has_contact) clear_contact(world.contacts[pair.contact]);
}

// The points of a pair where its axis says that the shapes meet, in place of the last step's.
void find_points(WorldState& world, PairRecord& pair, const Meeting& meeting) {
    Contact& contact = world.contacts[pair.contact];
    const PointForces before = forces_of(contact);
    build_contact_points(world, meeting, meeting.within, contact);
    match_points(before, contact);
    pair.meets = contact.point_count > 0;
    if (!pair.meets) clear_contact(contact);
    // Shapes that move together touch before they overlap; these were put there overlapping.
    if (!contact.touching) contact.first_overlap = max(0, -meeting.axis.separation);
    remember_contact(world, pair, meeting);
}

// Pairs and bodies are shared out in blocks of so many: some microseconds' work.
constexpr std::size_t pairs_a_block = 64;
constexpr int bodies_a_block = 128;

// work(pairs, first, block) for each block of the list of pairs: the span of it, the place of its
// first, and what is found in it.
template <class Work>
void for_pair_blocks(WorldState& world, Team& team, const Work& work) {
    const std::span<PairRecord> pairs = world.contacts.pairs();
    auto& blocks = world.scratch.pair_blocks;
    blocks.resize((pairs.size() + pairs_a_block - 1) / pairs_a_block);
    team.for_range(int(blocks.size()), 1, [&](int begin, int end, int) {
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
            const std::size_t first = i * pairs_a_block;
            work(pairs.subspan(first, std::min(pairs_a_block, pairs.size() - first)), first,
                 blocks[i]);
        }
    });
}

ContactEvent make_event(const WorldState& world, const Contact& contact, ContactEventKind kind) {
    return {kind, body_id(world, contact.body_a), body_id(world, contact.body_b),
            shape_id(world, contact.shape_a), shape_id(world, contact.shape_b)};
}

void report_end(WorldState& world, std::uint32_t slot) {
    const Contact& ended = world.contacts[slot];
    if (ended.touching) world.events.push_back(make_event(world, ended, ContactEventKind::End));
    unlink_contact(world, slot);
}

// Gives a moving body the forces of the step; which velocity these would take beyond all numbers,
// if they do.
std::optional<Quantity> drive_body(WorldState& world, std::uint32_t slot, float h) {
    const std::uint32_t mobile = world.bodies[slot].mobile;
    BodyTravel& travel = world.travels[mobile];
    BodyDrive& drive = world.drives[mobile];
    travel.displacement = {};
    drive.force = drive.torque = {};
    if (const std::uint32_t place = world.mobiles[mobile].forces; place != nothing) {
        const UserForces& forces = world.forces[place];
        drive.force = forces.constant_force + forces.step_force;
        drive.torque = forces.constant_torque + forces.step_torque;
        forget_step_forces(world, slot);
    }
    const BodyInertia& inertia = world.inertias[mobile];
    const Vec3 push =
        drive.gravity_scale * world.settings.gravity + inertia.inverse_mass * drive.force;
    const Quat rotation = world.rotations[slot];
    const Vec3 twist =
        rotate(rotation, inertia.inverse_inertia * rotate_inverse(rotation, drive.torque));
    if (!is_sound(travel.linear_velocity + h * push)) return Quantity::LinearVelocity;
    if (!is_sound(travel.angular_velocity + h * twist)) return Quantity::AngularVelocity;
    return std::nullopt;
}

// Drives and lists those of the bodies that have sound velocities; the others freeze.
void drive_bodies(WorldState& world, Team& team, std::span<const std::uint32_t> bodies, double dt) {
    auto& overdriven = world.scratch.overdriven;
    overdriven.resize(bodies.size());
    team.for_range(int(bodies.size()), bodies_a_block, [&](int begin, int end, int) {
        for (auto k = std::size_t(begin); k < std::size_t(end); ++k)
            overdriven[k] = drive_body(world, bodies[k], float(dt));
    });
    make_room(world.scratch.moving, world.scratch.moving.size() + bodies.size());
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        if (overdriven[k]) {
            freeze(world, bodies[k], *overdriven[k]);
        } else {
            world.scratch.moving.push_back(bodies[k]);
        }
    }
}

// One group by one solver; `team` may share its loops.
void advance_group(WorldState& world, const StepGroup& group, WorldState::Workshop& workshop,
                   StepProblem problem, Team* team) {
    problem.team = team;
    workshop.bodies.gather(world, group, problem);
    std::visit([&](auto& method) { method.advance(problem); }, workshop.solver);
    workshop.bodies.scatter(world, group, problem);
}

// A group of so many contacts is worth sharing; smaller ones are taken by one thread each.
constexpr std::size_t shared_group = 1024;

void advance_groups(WorldState& world, Team& team, const StepProblem& problem) {
    const StepGroups& groups = world.scratch.groups;
    auto& workshops = world.scratch.workshops;
    workshops.resize(std::size_t(team.worker_count()));
    const Solver method = world.settings.step.solver;
    for (WorldState::Workshop& workshop : workshops) {
        if (workshop.solver.index() != std::size_t(method)) workshop.solver = make_solver(method);
    }
    const auto is_shared = [&](std::size_t i) { return groups[i].active.size() >= shared_group; };
    for (std::size_t i = 0; i < groups.count(); ++i) {
        if (is_shared(i)) advance_group(world, groups[i], workshops[0], problem, &team);
    }
    team.for_range(int(groups.count()), 1, [&](int begin, int end, int worker) {
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
            if (!is_shared(i))
                advance_group(world, groups[i], workshops[std::size_t(worker)], problem, nullptr);
        }
    });
    // They were read by all until now.
    advance_group(world, groups.kinematic_group(), workshops[0], problem, nullptr);
}

// The contact whose points find_points will renew.
[[gnu::always_inline]] inline void prefetch_found(const WorldState& world,
                                                  std::span<const PairRecord> pairs,
                                                  std::size_t i) {
    if (i < pairs.size() && pairs[i].is_found)
        world.contacts.prefetch(pairs[i].contact, pairs[i].shows_face ? 4 : 1);
}

// Gives a contact to each pair that meets and has none.
void create_contacts(WorldState& world) {
    const std::span<PairRecord> pairs = world.contacts.pairs();
    const auto is_new = [](const PairRecord& pair) {
        return pair.is_found && pair.contact == ContactStore::none;
    };
    const auto count = std::count_if(pairs.begin(), pairs.end(), is_new);
    if (count == 0) return;
    world.contacts.make_room(std::size_t(count));
    for (PairRecord& pair : pairs) {
        if (!is_new(pair)) continue;
        const std::uint32_t body_a = world.shapes[pair.shape_a].body;
        const std::uint32_t body_b = world.shapes[pair.shape_b].body;
        describe_contact(world, world.contacts.add_contact(pair, body_a, body_b));
    }
}

// Counts the contacts that have points, block by block.
void count_contacts(const WorldState& world, std::span<const PairRecord> pairs, PairBlock& block) {
    block = {};
    for (const PairRecord& pair : pairs) {
        if (!pair.meets) continue;
        ++block.contact_count;
        block.reused_count += pair.is_found ? 0 : 1;
        block.point_count += std::uint32_t(world.contacts[pair.contact].point_count);
    }
}

// Lists the contacts that were counted.
void list_active(WorldState& world, Team& team) {
    std::size_t contact_count = 0, point_count = 0, reused_count = 0;
    for (PairBlock& block : world.scratch.pair_blocks) {
        const std::uint32_t count = block.contact_count;
        // From here on, where the block's begin.
        block.contact_count = std::uint32_t(contact_count);
        contact_count += count;
        point_count += block.point_count;
        reused_count += block.reused_count;
    }
    world.report.contact_count = point_count;
    world.report.reused_count = reused_count;
    auto& active = world.scratch.active;
    active.resize(contact_count);
    for_pair_blocks(world, team,
                    [&](std::span<PairRecord> pairs, std::size_t, const PairBlock& block) {
                        std::size_t place = block.contact_count;
                        for (const PairRecord& pair : pairs) {
                            if (pair.meets) active[place++] = pair.contact;
                        }
                    });
}

// Whether a contact began or ended, or is to be dropped.
bool has_news(const Contact& contact) {
    return contact.point_count == 0 || is_touching(contact) != contact.touching;
}

void tell_news(WorldState& world, PairRecord& pair) {
    Contact& contact = world.contacts[pair.contact];
    const bool touching = is_touching(contact);
    if (touching != contact.touching) {
        const auto kind = touching ? ContactEventKind::Begin : ContactEventKind::End;
        world.events.push_back(make_event(world, contact, kind));
    }
    contact.touching = touching;
    if (contact.point_count > 0) return;
    unlink_contact(world, pair.contact);
    world.contacts.remove_contact(pair);
}

// Takes a body where the step brought it, unless one of its numbers is wrong.
BodyArrival move_body(WorldState& world, std::uint32_t slot, const BodyMotion& before) {
    const BodyMotion motion = motion_of(world, slot);
    const Position moved = world.positions[slot] + motion.displacement;
    if (!is_sound(motion.linear_velocity)) return {.wrong = Quantity::LinearVelocity};
    if (!is_sound(motion.angular_velocity)) return {.wrong = Quantity::AngularVelocity};
    if (!is_finite(motion.displacement) || !is_sound(moved)) return {.wrong = Quantity::Position};
    if (!is_finite(motion.rotation)) return {.wrong = Quantity::Rotation};
    world.positions[slot] = moved;
    return {.strayed = !add_to_way(world, slot, before)};
}

}  // namespace

// Reads what the user set; writes the drives and the list of bodies that move.
void apply_changes(WorldState& world, Team& team, double dt) {
    const TraceScope scope(world.trace.get(), 0, "apply-changes");
    world.report.stage_seconds = {};
    ++world.report.step;
    world.report.time += dt;
    world.events.clear();
    world.last_dt = dt;
    list_moving(world);
    world.scratch.moving.clear();
    drive_bodies(world, team, world.rest.movers, dt);
}

// Reads poses and velocities; renews the list of contacts, ends those whose boxes parted.
void find_pairs(WorldState& world, Team& team, double dt) {
    const StageTimer timer(world, Stage::FindPairs, "find-pairs");
    find_step_pairs(world, team, dt, world.scratch.pairs);
    world.report.pair_count = world.scratch.pairs.size();
    if (world.contacts.lists(world.scratch.pairs)) return;
    world.contacts.begin_renewal(world.scratch.pairs.size());
    for (const Pair& pair : world.scratch.pairs) world.contacts.renew(pair.a, pair.b);
    const auto is_idle = [&](const Contact& contact) {
        return !is_looked_at(world, contact.body_a) && !is_looked_at(world, contact.body_b);
    };
    world.contacts.end_renewal(is_idle, [&](std::uint32_t slot) { report_end(world, slot); });
}

// Reads the listed pairs; writes the axis of each that is within reach, and brings contacts to the
// present whose bodies hardly moved against each other.
void find_axes(WorldState& world, Team& team, double dt) {
    const StageTimer timer(world, Stage::FindAxes, "find-axes");
    look_ahead(world, team, dt);
    auto& meetings = world.scratch.meetings;
    meetings.resize(std::max(meetings.size(), world.contacts.pairs().size()));
    for_pair_blocks(world, team, [&](std::span<PairRecord> pairs, std::size_t first, PairBlock&) {
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            prefetch_face(world, pairs, i + contacts_ahead);
            find_axis_of_pair(world, dt, pairs[i], meetings[first + i]);
        }
    });
}

// Reads axes; writes the normal and points of each contact, and lists the contacts that have any.
void build_manifolds(WorldState& world, Team& team) {
    const StageTimer timer(world, Stage::BuildManifolds, "build-manifolds");
    create_contacts(world);
    const auto& meetings = world.scratch.meetings;
    for_pair_blocks(world, team,
                    [&](std::span<PairRecord> pairs, std::size_t first, PairBlock& block) {
                        for (std::size_t i = 0; i < pairs.size(); ++i) {
                            prefetch_found(world, pairs, i + contacts_ahead);
                            if (pairs[i].is_found)
                                find_points(world, pairs[i], meetings[first + i]);
                        }
                        for (const PairRecord& pair : pairs) {
                            if (pair.meets)
                                turn_surface_velocity(world, world.contacts[pair.contact]);
                        }
                        count_contacts(world, pairs, block);
                    });
    list_active(world, team);
}

// Reads the contacts that have points; writes the islands. What sleeps and is touched wakes and
// takes part in this step, with the contacts that it fell asleep with: nothing has moved since.
void join_islands(WorldState& world, Team& team, double dt) {
    const StageTimer timer(world, Stage::BuildManifolds, "join-islands");
    if (!link_contacts(world)) return;
    list_moving(world);
    world.contacts.list_returned();
    for_pair_blocks(world, team, [&](std::span<PairRecord> pairs, std::size_t, PairBlock& block) {
        count_contacts(world, pairs, block);
    });
    list_active(world, team);
    auto& moving = world.scratch.moving;
    const LargeArray<std::uint32_t> before = moving;
    LargeArray<std::uint32_t> woken;
    for (const std::uint32_t slot : world.rest.movers) {
        const bool is_new = !std::binary_search(before.begin(), before.end(), slot);
        if (is_new && !world.bodies[slot].frozen) woken.push_back(slot);
    }
    drive_bodies(world, team, woken, dt);
    std::sort(moving.begin(), moving.end());
}

// Reads everything above; writes velocities, rotations, displacements and impulses.
void advance(WorldState& world, Team& team, double dt) {
    const StageTimer timer(world, Stage::Solve, "solve");
    const auto& moving = world.scratch.moving;
    auto& before = world.scratch.before;
    before.resize(moving.size());
    team.for_range(int(moving.size()), bodies_a_block, [&](int begin, int end, int) {
        for (auto k = std::size_t(begin); k < std::size_t(end); ++k)
            before[k] = motion_of(world, moving[k]);
    });
    const StepSettings& step = world.settings.step;
    StepProblem problem = {
        .contacts = world.contacts.slots(),
        .gravity = world.settings.gravity,
        .dt = dt,
        .substeps = step.substeps > 0 ? step.substeps : default_substeps(step.solver),
        .iterations = step.iterations > 0 ? step.iterations : default_iterations(step.solver),
        .restitution_threshold = world.settings.restitution_threshold,
        .contact_compliance = step.contact_compliance,
        .lanes = step.lanes,
        .team = &team,
    };
    world.scratch.groups.form(world, team);
    advance_groups(world, team, problem);
}

// Reads displacements; writes positions, and the tree's boxes of what strayed out of them. A body
// whose numbers went wrong goes back to the step's start.
void move_bodies(WorldState& world, Team& team) {
    const StageTimer timer(world, Stage::Finish, "move-bodies");
    const auto& moving = world.scratch.moving;
    auto& arrivals = world.scratch.arrivals;
    arrivals.resize(moving.size());
    team.for_range(int(moving.size()), bodies_a_block, [&](int begin, int end, int) {
        for (auto k = std::size_t(begin); k < std::size_t(end); ++k)
            arrivals[k] = move_body(world, moving[k], world.scratch.before[k]);
    });
    bool any_frozen = false;
    for (std::size_t k = 0; k < moving.size(); ++k) {
        if (arrivals[k].strayed) keep_in_tree(world, moving[k]);
        if (!arrivals[k].wrong) continue;
        set_motion(world, moving[k], world.scratch.before[k]);
        freeze(world, moving[k], *arrivals[k].wrong);
        any_frozen = true;
    }
    if (!any_frozen) return;
    for (const std::uint32_t slot : world.scratch.active) {
        Contact& contact = world.contacts[slot];
        if (world.bodies[contact.body_a].frozen || world.bodies[contact.body_b].frozen)
            clear_contact(contact);
    }
}

// Reads impulses; writes the events of contacts that began or ended, and drops those without
// points.
void report_contacts(WorldState& world, Team& team) {
    const StageTimer timer(world, Stage::Finish, "report-contacts");
    for_pair_blocks(world, team, [&](std::span<PairRecord> pairs, std::size_t, PairBlock& block) {
        block.news_count = 0;
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            if (i + contacts_ahead < pairs.size())
                world.contacts.prefetch(pairs[i + contacts_ahead].contact, 1);
            PairRecord& pair = pairs[i];
            pair.has_news =
                pair.contact != ContactStore::none && has_news(world.contacts[pair.contact]);
            block.news_count += pair.has_news ? 1 : 0;
        }
    });
    std::size_t event_count = world.events.size();
    for (const PairBlock& block : world.scratch.pair_blocks) event_count += block.news_count;
    make_room(world.events, event_count);
    const std::span<PairRecord> pairs = world.contacts.pairs();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (world.scratch.pair_blocks[i / pairs_a_block].news_count == 0) continue;
        if (pairs[i].has_news) tell_news(world, pairs[i]);
    }
}

// Reads what each body has done; writes who sleeps from here on.
void put_to_rest(WorldState& world, double dt) {
    const StageTimer timer(world, Stage::Finish, "put-to-rest");
    find_sleepers(world, dt);
}

}  // namespace cairn

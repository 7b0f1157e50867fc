// One step, top to bottom. What each stage reads and writes stands at its head in stages.cpp.

#include "world/step.h"

#include "base/float_environment.h"
#include "world/stages.h"

namespace cairn {

namespace {

// Bodies and pairs of the last step from which on a step is worth sharing: a fraction of a
// millisecond's work.
constexpr std::size_t worth_sharing = 1500;

const SharedScheduler& choose_scheduler(const WorldState& world) {
    static const SharedScheduler nobody;
    const std::size_t work = world.scratch.moving.size() + world.contacts.pairs().size();
    return work < worth_sharing ? nobody : world.scheduler;
}

}  // namespace

void step_world(WorldState& world, double dt) {
    const FloatEnvironment ieee;
    // Who shares the loops below.
    Team team(choose_scheduler(world), world.trace.get());

    apply_changes(world, team, dt);  // the user's forces; what is not finite is frozen here
    find_pairs(world, team, dt);     // broad phase: which boxes overlap
    find_axes(world, team, dt);      // narrow phase: along which direction two shapes meet
    build_manifolds(world, team);    // contact points, with the impulses of the last step
    join_islands(world, team, dt);   // what moves together; what is touched wakes
    advance(world, team, dt);        // integrate, solve, correct: the exchangeable method
    move_bodies(world, team);        // displacements become positions; what went wrong is frozen
    report_contacts(world, team);    // which contacts began, which ended
    put_to_rest(world, dt);          // what has stood still falls asleep
}

}  // namespace cairn

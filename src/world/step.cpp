// One step, top to bottom. What each stage reads and writes stands at its head in stages.cpp.

#include "world/step.h"

#include "base/float_environment.h"
#include "world/stages.h"

namespace cairn {

void step_world(WorldState& world, double dt) {
    const FloatEnvironment ieee;

    apply_changes(world, dt);  // the user's forces; what is not finite is frozen here
    find_pairs(world, dt);     // broad phase: which boxes overlap
    find_axes(world, dt);      // narrow phase: along which direction two shapes meet
    build_manifolds(world);    // contact points, with the impulses of the last step
    advance(world, dt);        // integrate, solve, correct: the exchangeable method
    move_bodies(world);        // displacements become positions; what went wrong is frozen
    report_contacts(world);    // which contacts began, which ended
}

}  // namespace cairn

#pragma once
// The step: the list of stages.

#include "world/world_state.h"

namespace cairn {

// Moves the world on by dt seconds, which is sound.
void step_world(WorldState& world, double dt);

}  // namespace cairn

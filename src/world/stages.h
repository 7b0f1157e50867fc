#pragma once
// The stages that step.cpp lists, in their order.

#include "world/world_state.h"

namespace cairn {

void apply_changes(WorldState& world, Team& team, double dt);
void find_pairs(WorldState& world, Team& team, double dt);
void find_axes(WorldState& world, Team& team, double dt);
void build_manifolds(WorldState& world, Team& team);
void join_islands(WorldState& world, Team& team, double dt);
void advance(WorldState& world, Team& team, double dt);
void move_bodies(WorldState& world, Team& team);
void report_contacts(WorldState& world, Team& team);
void put_to_rest(WorldState& world, double dt);

}  // namespace cairn

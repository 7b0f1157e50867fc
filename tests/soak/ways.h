#pragma once
// What may never change a result: who does a step's work, whether that is traced, how many contacts
// are looked at side by side, and which broad phase finds the pairs.

#include <cstdint>

#include "dice.h"

namespace cairn::soak {

// One to four threads, Cairn's own or a host's, traced or not, other lanes, another broad phase.
void change_way(World& world, Dice& dice);

// How often a step was shared with a host's threads so far.
std::uint64_t host_run_count();

// What is wrong, or null: two copies that share the world's threads step at once on threads of
// their own, while the world steps with what is left; all three go through the same states.
const char* step_together(World& world, Dice& dice);

}  // namespace cairn::soak

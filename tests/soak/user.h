#pragma once
// What a user does to a world between two steps, by surprise: the worlds that are soaked, and one
// change after another. The same dice give the same change, to the bit, on worlds that are in the
// same state.

#include <cstddef>

#include "dice.h"

namespace cairn::soak {

inline constexpr double dt = 1.0 / 60;
inline constexpr double pit_half_width = 4;

// A kind of world: how many bodies come and go in it, and for how long.
struct Kind {
    std::size_t fewest, most;  // bodies
    int steps;                 // of one life
    int steps_a_change;        // on average
    int steps_a_copy;          // from one look at a copy to the next
    int most_iterations, most_substeps;
};
inline constexpr Kind pit = {8, 60, 4000, 6, 400, 15, 20};
// Bodies and pairs enough for a step to be shared by threads.
inline constexpr Kind crowd = {560, 680, 240, 2, 80, 4, 6};

// A pit whose floor and walls are planes, with a block in it; a crowd's bodies are about to fall.
World make_world(const Kind& kind, Dice& dice);

// One change: bodies and shapes come and go, are pushed, thrown, moved, locked, put to sleep and
// woken, or the settings become others.
void change(World& world, const Kind& kind, Dice dice);

}  // namespace cairn::soak

#pragma once
// A start for contacts that remember nothing: the weight that they will have to bear.
//
// Warm starting carries last step's loads on, but a pile that is put up begins with none: gravity
// meets it before the sweeps have passed the load from layer to layer, and while they do, it sinks,
// tilts and slides. Going from the highest body down, each hands its weight and what it already
// bears to what it stands on: to its new contacts in equal shares or, where all are old, as much
// more as has been added above it. In a column the result is exact; elsewhere it is a start, and
// the sweeps do the rest.
//
// Only contacts at rest take part: a body that falls onto a pile brings its impulse itself.

#include <span>
#include <vector>

#include "constraint/step_problem.h"

namespace cairn {

class FirstGuess {
public:
    // What a contact is like when the guess is made.
    struct Bearing {
        std::uint32_t body_a = 0, body_b = 0;
        Vec3 normal;      // from A to B
        float gap = 0;    // m, < 0 where the shapes overlap
        float speed = 0;  // of B less A's at the contact, along the normal, m/s
        float size = 0;   // as Contact::size
        float load = 0;   // N, normal: what it remembers, 0 where that is nothing
    };

    // Adds to the loads. `slow`: the speed along the normal up to which a contact is at rest, m/s.
    // False where there was nothing to add.
    bool add_weights(const StepProblem& problem, float slow, std::span<Bearing> bearings);

private:
    struct Support {
        std::uint32_t upper = 0, lower = 0;  // bodies
        std::uint32_t bearing = 0;
        float steepness = 0;  // n . up, seen from the lower body
        bool is_new = false;
    };

    bool collect(Vec3 up, float slow, std::span<const Bearing> bearings);
    void sort_from_above(std::span<const float> heights);

    std::vector<Support> supports_;
    std::vector<float> borne_;  // by body: what stands on it, along gravity
    std::vector<float> added_;  // by body: how much of that is new
};

}  // namespace cairn

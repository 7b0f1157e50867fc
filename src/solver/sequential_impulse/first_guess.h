#pragma once
// A start for contacts that remember nothing: the weight that they will have to bear.
//
// Warm starting carries last step's impulses on, but a pile that is put up begins with none:
// gravity meets it before the sweeps have passed the load from layer to layer, and while they do,
// it sinks, tilts and slides. Going from the highest body down, each hands its weight and what it
// already bears to what it stands on: to its new contacts in equal shares or, where all are old, as
// much more as has been added above it. In a column the result is exact; elsewhere it is a start,
// and the sweeps do the rest.
//
// Only contacts at rest take part: a body that falls onto a pile brings its impulse itself.

#include <vector>

#include "solver/contact_rows.h"

namespace cairn {

class FirstGuess {
public:
    // Adds to `loads`, one entry a row set: total normal impulse (N s) of one substep of h seconds.
    // `loads` holds what the contacts remember, 0 for those that remember nothing.
    void add_weights(const StepProblem& problem, std::span<const ContactRows> rows, float h,
                     std::span<float> loads);

private:
    struct Support {
        std::uint32_t upper = 0, lower = 0;  // bodies
        std::uint32_t row = 0;
        float steepness = 0;  // n . up, seen from the lower body
        bool is_new = false;
    };

    bool collect(const StepProblem& problem, std::span<const ContactRows> rows, Vec3 up, float h,
                 std::span<const float> loads);

    std::vector<Support> supports_;
    std::vector<float> borne_;  // by body: what stands on it, along gravity
    std::vector<float> added_;  // by body: how much of that is new
};

}  // namespace cairn

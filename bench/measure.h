#pragma once
// How long an engine takes for a scene, and how well it did: one measure for all of them.

#include <vector>

#include "engine.h"

namespace cairn::bench {

// One run of a fresh world.
struct Run {
    double wall_ms = 0;              // a step, the first left out
    double cpu_ms = 0;               // likewise, the thread's processor time
    double top_drift = 0;            // m, how far the top box is from where it was put
    double deepest_penetration = 0;  // m, at the end, on the exact geometry
    double kinetic_energy = 0;       // J, at the end
};

Run run_scene(const EngineEntry& entry, const BenchScene& scene, int steps);

// Of several runs: the middle one, and how far apart the outermost are.
struct Spread {
    double median = 0;
    double least = 0;
    double most = 0;
};
Spread spread_of(std::vector<double> values);

}  // namespace cairn::bench

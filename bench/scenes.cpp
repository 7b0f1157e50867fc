// The scenes of the benchmark, as data that every engine's adapter reads.

#include "scenes.h"

namespace cairn::bench {

BenchScene make_pyramid(int base) {
    constexpr double pitch = 1.01;
    constexpr double density = 1000;
    BenchScene scene;
    scene.name = "pyramid of " + std::to_string(base * (base + 1) / 2) + " unit cubes";
    // The ground is a box, not a plane, so that every engine takes the same path through its code.
    scene.boxes.push_back({.position = {0, -1, 0}, .half_extents = {100, 1, 100}});
    for (int row = 0; row < base; ++row) {
        const int count = base - row;
        for (int i = 0; i < count; ++i) {
            const double x = pitch * (i - 0.5 * (count - 1));
            scene.boxes.push_back({.position = {x, row + 0.5, 0},
                                   .half_extents = {0.5, 0.5, 0.5},
                                   .density = density});
        }
    }
    scene.top = scene.boxes.size() - 1;
    return scene;
}

}  // namespace cairn::bench

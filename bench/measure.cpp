// Times a run and judges its end. Penetration is measured by one ruler, Cairn's contacts at the
// poses that an engine ended with, so that margins and reporting habits of the engines do not
// count.

#include "measure.h"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "cairn/cairn.h"

namespace cairn::bench {

namespace {

double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double deepest_penetration(const Engine& engine, const BenchScene& scene) {
    World ruler;
    for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
        const BoxBody& box = scene.boxes[i];
        const BoxMotion motion = engine.motion(i);
        const Box geometry{{static_cast<float>(box.half_extents[0]),
                            static_cast<float>(box.half_extents[1]),
                            static_cast<float>(box.half_extents[2])}};
        BodyDef def{.kind = box.density > 0 ? BodyKind::Dynamic : BodyKind::Static,
                    .position = {motion.position[0], motion.position[1], motion.position[2]},
                    .rotation = {static_cast<float>(motion.rotation[0]),
                                 static_cast<float>(motion.rotation[1]),
                                 static_cast<float>(motion.rotation[2]),
                                 static_cast<float>(motion.rotation[3])}};
        def.shapes.push_back({.geometry = geometry});
        (void)ruler.create_body(def);
    }
    return World::penetration(ruler.contacts()).deepest;
}

// Of cubes, whose inertia is the same about every axis.
double kinetic_energy(const Engine& engine, const BenchScene& scene) {
    double sum = 0;
    for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
        const BoxBody& box = scene.boxes[i];
        const BoxMotion motion = engine.motion(i);
        const double side = 2 * box.half_extents[0];
        const double mass = side * side * side * box.density;
        double linear = 0;
        double angular = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            linear += motion.linear_velocity[axis] * motion.linear_velocity[axis];
            angular += motion.angular_velocity[axis] * motion.angular_velocity[axis];
        }
        sum += 0.5 * mass * (linear + side * side / 6 * angular);
    }
    return sum;
}

}  // namespace

Run run_scene(const EngineEntry& entry, const BenchScene& scene, int steps) {
    const std::unique_ptr<Engine> engine = entry.make(scene);
    const std::array<double, 3> start = engine->motion(scene.top).position;
    engine->step(scene.dt);
    const auto wall_begin = std::chrono::steady_clock::now();
    const double cpu_begin = thread_seconds();
    for (int step = 1; step < steps; ++step) engine->step(scene.dt);
    const double cpu = thread_seconds() - cpu_begin;
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_begin;
    const std::array<double, 3> end = engine->motion(scene.top).position;

    Run run;
    run.wall_ms = 1000 * wall.count() / (steps - 1);
    run.cpu_ms = 1000 * cpu / (steps - 1);
    run.top_drift = std::hypot(end[0] - start[0], end[1] - start[1], end[2] - start[2]);
    run.deepest_penetration = deepest_penetration(*engine, scene);
    run.kinetic_energy = kinetic_energy(*engine, scene);
    return run;
}

Spread spread_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t count = values.size();
    return {0.5 * (values[(count - 1) / 2] + values[count / 2]), values.front(), values.back()};
}

}  // namespace cairn::bench

// Stepping and hashing a golden scene; see golden_run.h.

#include "determinism/golden_run.h"

#include <cstdio>
#include <cstdlib>
#include <utility>

namespace cairn::test {

void RunHash::add(const World& world) {
    std::uint64_t state = world.state_hash();
    for (int byte = 0; byte < 8; ++byte, state >>= 8u) {
        hash_ = (hash_ ^ (state & 0xffu)) * 0x100000001b3u;
    }
}

World make_golden_world(const GoldenScene& scene, const GoldenMethod& method,
                        const GoldenWay& way) {
    const StepSettings settings = {
        .solver = method.solver, .narrow_phase = method.narrow_phase, .lanes = way.lanes};
    World world = World::create({.step = settings}).value();
    world.set_error_handler([name = scene.name](const Error& error) {
        std::fprintf(stderr, "golden scene %s: a call was refused: %s\n", name,
                     error.message.c_str());
        std::exit(1);
    });
    (void)world.set_threads({.count = way.threads});
    scene.build(world);
    return world;
}

void take_golden_step(const GoldenScene& scene, World& world, int step) {
    if (scene.before_step != nullptr) scene.before_step(world, step);
    (void)world.step(golden_dt);
}

std::string golden_line(const std::string& scene, const std::string& method, int steps,
                        std::uint64_t hash) {
    std::string line = scene;
    line.append(" ").append(method).append(" ").append(std::to_string(steps)).append(" ");
    for (int shift = 60; shift >= 0; shift -= 4) line += "0123456789abcdef"[hash >> shift & 0xfu];
    return line;
}

std::string run_golden_scene(const GoldenScene& scene, const GoldenMethod& method,
                             const GoldenWay& way) {
    World world = make_golden_world(scene, method, way);
    RunHash hash;
    for (int step = 0; step < scene.steps; ++step) {
        take_golden_step(scene, world, step);
        hash.add(world);
    }
    if (!world.non_finite().empty()) {
        std::fprintf(stderr, "golden scene %s, %s: a body's numbers went wrong in step %llu\n",
                     scene.name, method.name,
                     static_cast<unsigned long long>(world.non_finite()[0].step));
        std::exit(1);
    }
    return golden_line(scene.name, method.name, scene.steps, hash.value());
}

}  // namespace cairn::test

// The program that runs one scene in one engine, in a process of its own; `cairn bench` starts it.
//
//   cairn_bench_ENGINE --scenes           the scenes, a line of JSON each
//   cairn_bench_ENGINE --describe         the engine, its version and variants, as JSON
//   cairn_bench_ENGINE SCENE VARIANT THREADS STEPS
//                                         runs, and prints a line of JSON last
//
// The clock runs around the step and around bodies that come in later, not around what is read
// between steps. Exit status: 0 done, 1 the engine cannot, 2 bad usage.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "engine.h"
#include "process_meter.h"
#include "quality.h"
#include "scenes.h"

namespace {

using namespace cairn::bench;

struct Times {
    double first_ms = 0;
    double wall_ms = 0;  // the mean of the steps that count
    double cpu_ms = 0;
    double worst_ms = 0;
    int counted = 0;
};

// How far a tower's top is below its place, at most: at first, and once it had time to settle. Not
// a number where no step was of that kind.
struct Sag {
    static constexpr double settled_after = 3;  // s
    double early = std::numeric_limits<double>::quiet_NaN();
    double late = std::numeric_limits<double>::quiet_NaN();
};

struct Memory {
    std::int64_t empty_kib = 0;  // with the empty world
    std::int64_t built_kib = 0;  // after the first step
    std::int64_t peak_kib = 0;
};

struct Run {
    Times times;
    Sag sag;
    Memory memory;
    std::size_t bodies = 0;
};

// JSON has no infinities and no NaN.
std::string say_number(double x) {
    if (!std::isfinite(x)) return "null";
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", x);
    return text;
}

void watch_tower(const BenchScene& scene, const Engine& engine, double time, Sag& sag) {
    for (const Standing& standing : scene.standing) {
        const double height = engine.motion(standing.body).position[1];
        double& worst = time < Sag::settled_after ? sag.early : sag.late;
        if (!(standing.place[1] - height <= worst)) {
            worst = std::max(0.0, standing.place[1] - height);
        }
    }
}

Run run_scene(const BenchScene& scene, Engine& engine, int steps) {
    Run run;
    run.memory.empty_kib = resident_kib();
    forget_peak();
    run.bodies = scene.initial_bodies > 0 ? scene.initial_bodies : scene.bodies.size();
    for (std::size_t i = 0; i < run.bodies; ++i) engine.add(scene, scene.bodies[i]);
    engine.finish_building();

    // A short run keeps half of its steps for the clock.
    const int uncounted = std::max(1, std::min(scene.settle_steps, steps / 2));
    Times& times = run.times;
    double wall_sum = 0;
    double cpu_sum = 0;
    for (int step = 0; step < steps; ++step) {
        const double cpu_begin = processor_seconds();
        const double wall_begin = wall_seconds();
        const bool is_due = scene.spawn_every > 0 && step > 0 && step % scene.spawn_every == 0;
        if (is_due && run.bodies < scene.bodies.size()) {
            engine.add(scene, scene.bodies[run.bodies++]);
        }
        engine.step(scene.dt);
        const double wall = 1000 * (wall_seconds() - wall_begin);
        const double cpu = 1000 * (processor_seconds() - cpu_begin);
        if (step == 0) {
            times.first_ms = wall;
            run.memory.built_kib = resident_kib();
        }
        if (step >= uncounted) {
            wall_sum += wall;
            cpu_sum += cpu;
            times.worst_ms = std::max(times.worst_ms, wall);
            ++times.counted;
        }
        if (scene.is_tower) watch_tower(scene, engine, (step + 1) * scene.dt, run.sag);
    }
    times.wall_ms = wall_sum / std::max(1, times.counted);
    times.cpu_ms = cpu_sum / std::max(1, times.counted);
    run.memory.peak_kib = peak_resident_kib();
    return run;
}

void print_run(const BenchScene& scene, const Engine& engine, const Run& run) {
    std::vector<BodyMotion> motions(run.bodies);
    for (std::size_t i = 0; i < run.bodies; ++i) motions[i] = engine.motion(i);
    const Quality quality = measure_quality(scene, motions);
    const double none = std::numeric_limits<double>::quiet_NaN();
    const auto moving = std::count_if(
        scene.bodies.begin(), scene.bodies.begin() + static_cast<std::ptrdiff_t>(run.bodies),
        [](const SceneBody& body) { return body.mobility == Mobility::Dynamic; });
    const std::int64_t awake = engine.count_awake();

    std::printf("{\"settings\":\"%s\",\"bodies\":%zu,\"moving\":%td,\"counted_steps\":%d",
                engine.settings().c_str(), run.bodies, moving, run.times.counted);
    const auto print_field = [](const char* name, double value) {
        std::printf(",\"%s\":%s", name, say_number(value).c_str());
    };
    print_field("first_ms", run.times.first_ms);
    print_field("wall_ms", run.times.wall_ms);
    print_field("cpu_ms", run.times.cpu_ms);
    print_field("worst_ms", run.times.worst_ms);
    print_field("empty_kib", static_cast<double>(run.memory.empty_kib));
    print_field("built_kib", static_cast<double>(run.memory.built_kib));
    print_field("peak_kib", static_cast<double>(run.memory.peak_kib));
    print_field("deepest_penetration", quality.deepest_penetration);
    print_field("mean_penetration", quality.mean_penetration);
    print_field("overlapping_pairs", static_cast<double>(quality.overlapping_pairs));
    print_field("drift", quality.drift.value_or(none));
    print_field("sag_before_3s", run.sag.early);
    print_field("sag_from_3s", run.sag.late);
    print_field("kinetic_energy", quality.kinetic_energy);
    print_field("lost", static_cast<double>(quality.lost_bodies));
    print_field("awake", awake < 0 ? none : static_cast<double>(awake));
    std::printf("}\n");
}

void list_scenes() {
    for (const SceneEntry& entry : scene_entries()) {
        std::printf("{\"name\":\"%s\",\"line\":\"%s\",\"steps\":%d,\"is_memory_probe\":%s}\n",
                    entry.name, entry.line, entry.steps, entry.is_memory_probe ? "true" : "false");
    }
}

void print_description() {
    const EngineDescription engine = describe_engine();
    std::printf("{\"name\":\"%s\",\"version\":\"%s\",\"variants\":[", engine.name.c_str(),
                engine.version.c_str());
    for (std::size_t i = 0; i < engine.variants.size(); ++i) {
        std::printf("%s\"%s\"", i > 0 ? "," : "", engine.variants[i].c_str());
    }
    std::printf("]}\n");
}

int fail(int status, const std::string& message) {
    std::fprintf(stderr, "%s\n", message.c_str());
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 2 && std::strcmp(argv[1], "--scenes") == 0) return list_scenes(), 0;
    if (argc == 2 && std::strcmp(argv[1], "--describe") == 0) return print_description(), 0;
    if (argc != 5) return fail(2, "usage: SCENE VARIANT THREADS STEPS, --scenes or --describe");
    const SceneEntry* const entry = find_scene(argv[1]);
    if (entry == nullptr) return fail(2, std::string("no scene \"") + argv[1] + "\"");
    const EngineRequest request{.variant = argv[2], .threads = std::atoi(argv[3])};
    const std::vector<std::string> variants = describe_engine().variants;
    if (std::find(variants.begin(), variants.end(), request.variant) == variants.end()) {
        return fail(2, "no variant \"" + request.variant + "\"");
    }
    const int steps = std::atoi(argv[4]);
    if (request.threads < 1 || steps < 1) return fail(2, "threads and steps are 1 or more");

    BenchScene scene = entry->make();
    scene.name = entry->name;
    const MadeEngine made = make_engine(scene, request);
    if (!made.engine) return fail(1, made.problem);
    const Run run = run_scene(scene, *made.engine, steps);
    print_run(scene, *made.engine, run);
    return 0;
}

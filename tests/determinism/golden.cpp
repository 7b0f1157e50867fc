// Whether this build gives the bits that every build must: the golden scenes and the built-in
// scenes under every solver and narrow phase, against one file of hashes, golden_hashes.txt. gcc
// and clang, optimised and not, run this test; a difference between two of them is a difference to
// the file for one of them. Where doctest cannot follow, program/hash_scenes.cpp prints the same
// lines.
//
// The file is made anew by CAIRN_WRITE_GOLDEN=1 in the environment. That is right only where a
// change was meant to change results.

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "determinism/golden_run.h"
#include "determinism/lane_widths.h"
#include "scene/builtin.h"
#include "scene/scene.h"

namespace {

using namespace cairn;
using namespace cairn::test;

const std::string golden_path =
    std::string(CAIRN_SOURCE_DIR) + "/tests/determinism/golden_hashes.txt";

bool is_writing() { return std::getenv("CAIRN_WRITE_GOLDEN") != nullptr; }

// Enough for bodies to fall, meet and begin to settle; fewer where there are many, to stay quick
// without optimisation.
int steps_for(const scene::Scene& scene) { return scene::count_bodies(scene) > 150 ? 15 : 90; }

std::string builtin_line(const std::string& name, scene::Scene scene, const GoldenMethod& method) {
    scene.world.step = {.solver = method.solver, .narrow_phase = method.narrow_phase};
    Result<scene::BuiltWorld> built = scene::build_world(scene);
    REQUIRE_MESSAGE(built.ok(), built.error().message);
    World world = std::move(built).value().world;
    const int steps = steps_for(scene);
    RunHash hash;
    for (int step = 0; step < steps; ++step) {
        REQUIRE(world.step(scene.dt).ok());
        hash.add(world);
    }
    CHECK(world.non_finite().empty());
    return golden_line(name, method.name, steps, hash.value());
}

std::vector<std::string> compute_lines() {
    std::vector<std::string> lines;
    for (const GoldenScene& scene : golden_scenes()) {
        for (const GoldenMethod& method : golden_methods) {
            lines.push_back(run_golden_scene(scene, method));
        }
    }
    for (const scene::Builtin& builtin : scene::builtins()) {
        const Result<scene::Scene> scene = scene::make_builtin(builtin, {});
        REQUIRE_MESSAGE(scene.ok(), scene.error().message);
        for (const GoldenMethod& method : all_golden_methods) {
            lines.push_back(builtin_line(std::string("builtin/") + builtin.name, *scene, method));
        }
    }
    return lines;
}

std::vector<std::string> read_golden() {
    std::ifstream file(golden_path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) {
        if (!line.empty() && line.front() != '#') lines.push_back(line);
    }
    return lines;
}

void write_golden(const std::vector<std::string>& lines) {
    std::ofstream file(golden_path);
    file << "# What every build must give, to the bit: scene, solver, narrow phase, steps, and the "
            "hash of the\n"
            "# states after each step. To make it anew, after a change that is meant to change "
            "results:\n"
            "#   CAIRN_WRITE_GOLDEN=1 ctest --preset release -R determinism/golden\n";
    for (const std::string& line : lines) file << line << '\n';
}

}  // namespace

TEST_CASE("every golden scene gives the same bits on every compiler and at every optimisation") {
    const std::vector<std::string> found = compute_lines();
    if (is_writing()) return write_golden(found);
    const std::vector<std::string> expected = read_golden();
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == expected[i]);
}

TEST_CASE("side by side or one at a time, on one thread or on eight, the bits are the same") {
    const std::vector<std::string> golden = read_golden();
    for (const GoldenWay& way : golden_ways) {
        if (!has_lane_width(way.lanes)) {
            MESSAGE("skipped: this processor has no " << way.lanes << " lanes");
            continue;
        }
        CAPTURE(way.lanes);
        CAPTURE(way.threads);
        for (const GoldenScene& scene : golden_scenes()) {
            for (const GoldenMethod& method : golden_methods) {
                if (method.solver != Solver::SoftStep) continue;
                const std::string line = run_golden_scene(scene, method, way);
                CAPTURE(line);
                CHECK(std::find(golden.begin(), golden.end(), line) != golden.end());
            }
        }
    }
}

TEST_CASE("a thousand contacts push at once in the scene that is to fill all lanes and threads") {
    for (const GoldenScene& scene : golden_scenes()) {
        if (std::string(scene.name) != "crowd") continue;
        World world = make_golden_world(scene, golden_methods[2]);
        int shared_runs = 0;
        const RunJobs run = [](void* count, int jobs, Job job, void* context) {
            ++*static_cast<int*>(count);
            for (int i = 0; i < jobs; ++i) job(context, i);
        };
        REQUIRE(world.set_threads({.count = 2, .run = run, .host_context = &shared_runs}).ok());
        for (int step = 0; step < scene.steps; ++step) {
            take_golden_step(scene, world, step);
            std::size_t pushing = 0;
            for (const ContactReport& contact : world.contacts()) {
                float push = 0;
                for (const ContactPointReport& point : contact.points) push += point.normal_impulse;
                if (push > 0) ++pushing;
            }
            CHECK(pushing > 1000);
        }
        CHECK(shared_runs > 0);
    }
}

TEST_CASE("a heap 1e7 metres away is the heap at the origin: it falls, meets and stays together") {
    for (const GoldenScene& scene : golden_scenes()) {
        if (std::string(scene.name).rfind("heap", 0) != 0) continue;
        CAPTURE(scene.name);
        for (const GoldenMethod& method : golden_methods) {
            CAPTURE(method.name);
            World world = make_golden_world(scene, method);
            for (int step = 0; step < scene.steps; ++step) take_golden_step(scene, world, step);
            const Position ground = world.position(world.bodies()[0]);
            for (const BodyId body : world.bodies()) {
                CHECK(length(world.position(body) - ground) < 5);
            }
            CHECK(world.contacts().size() > 15);
        }
    }
}

// Every build gives the same bits: each built-in scene, with both solvers and both narrow phases,
// against one file of hashes, golden_hashes.txt. gcc and clang, optimised and not, run this test; a
// difference between two of them is a difference to the file for one of them.
//
// The file is made anew by CAIRN_WRITE_GOLDEN=1 in the environment. That is right only where a
// change was meant to change results.

#include <doctest/doctest.h>

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "cairn/cairn.h"
#include "scene/builtin.h"
#include "scene/scene.h"

namespace {

using namespace cairn;

const std::string golden_path =
    std::string(CAIRN_SOURCE_DIR) + "/tests/determinism/golden_hashes.txt";

// Enough for bodies to fall, meet and begin to settle; fewer where there are many, to stay quick
// without optimisation.
int steps_for(const scene::Scene& scene) { return scene::count_bodies(scene) > 150 ? 15 : 90; }

std::string hash_line(const scene::Builtin& builtin, scene::Scene scene, Solver solver,
                      NarrowPhase narrow_phase) {
    scene.world.step = {.solver = solver, .narrow_phase = narrow_phase};
    Result<scene::BuiltWorld> built = scene::build_world(scene);
    REQUIRE_MESSAGE(built.ok(), built.error().message);
    World world = std::move(built).value().world;
    const int steps = steps_for(scene);
    for (int step = 0; step < steps; ++step) REQUIRE(world.step(scene.dt).ok());
    CHECK(world.non_finite().empty());

    char hash[17];
    std::snprintf(hash, sizeof hash, "%016" PRIx64, world.state_hash());
    std::string line = builtin.name;
    line.append(" ").append(scene::solver_name(solver));
    line.append(" ").append(scene::narrow_phase_name(narrow_phase));
    line.append(" ").append(std::to_string(steps)).append(" ").append(hash);
    return line;
}

std::vector<std::string> compute_lines() {
    std::vector<std::string> lines;
    for (const scene::Builtin& builtin : scene::builtins()) {
        const Result<scene::Scene> scene = scene::make_builtin(builtin, {});
        REQUIRE_MESSAGE(scene.ok(), scene.error().message);
        for (const Solver solver : {Solver::SequentialImpulse, Solver::SoftStep, Solver::Xpbd}) {
            for (const NarrowPhase narrow_phase : {NarrowPhase::Sat, NarrowPhase::GjkEpa}) {
                lines.push_back(hash_line(builtin, *scene, solver, narrow_phase));
            }
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
    file << "# State hashes of the built-in scenes: scene, solver, narrow phase, steps, hash. To "
            "make it anew,\n"
            "# after a change that is meant to change results:\n"
            "#   CAIRN_WRITE_GOLDEN=1 ctest --preset release -R determinism/golden\n";
    for (const std::string& line : lines) file << line << '\n';
}

}  // namespace

TEST_CASE("every built-in scene gives the same bits on every compiler and at every optimisation") {
    const std::vector<std::string> found = compute_lines();
    if (std::getenv("CAIRN_WRITE_GOLDEN") != nullptr) {
        write_golden(found);
        return;
    }
    const std::vector<std::string> expected = read_golden();
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i] == expected[i]);
}

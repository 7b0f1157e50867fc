// The hashes of the golden scenes, as golden_hashes.txt has them: for builds of the library that
// can have nothing beside it, on machines where the tests' own libraries are not.
//
//   hash_scenes         a line a scene and method; "#" before what is not compared. The soft step
//                       is run at every width and on 1 to 8 threads; a run that differs has a line
//   hash_scenes SCENE   the state hash after each step of that scene, by each method and way: the
//                       first line in which two builds differ says when they part
//
// check_hashes.sh compares what it prints with the file.

#include <cinttypes>
#include <cstdio>
#include <string>

#include "determinism/golden_run.h"
#include "determinism/lane_widths.h"

namespace {

using namespace cairn;
using namespace cairn::test;

void print_ways() {
    std::printf("# lanes x threads:");
    for (const GoldenWay& way : golden_ways) {
        const char* here = has_lane_width(way.lanes) ? "" : " (not here)";
        if (way.lanes == 0) std::printf(" all x %d", way.threads);
        if (way.lanes != 0) std::printf(" %d x %d%s,", way.lanes, way.threads, here);
    }
    std::printf("\n");
}

// Calls visit(way) for each way to run the method that may not make a difference. Lanes are the
// soft step's alone, and threads are of no one solver: the others run once.
template <class Visit>
void visit_ways(const GoldenMethod& method, Visit visit) {
    if (method.solver != Solver::SoftStep) return visit(GoldenWay{.threads = 3});
    for (const GoldenWay& way : golden_ways) {
        if (has_lane_width(way.lanes)) visit(way);
    }
}

void print_hashes() {
    for (const GoldenScene& scene : golden_scenes()) {
        for (const GoldenMethod& method : golden_methods) {
            std::string first;
            visit_ways(method, [&](const GoldenWay& way) {
                const std::string line = run_golden_scene(scene, method, way);
                if (first.empty()) std::printf("%s\n", (first = line).c_str());
                if (line == first) return;
                std::printf("%s by %d lanes, %d threads\n", line.c_str(), way.lanes, way.threads);
            });
        }
    }
}

void print_steps(const GoldenScene& scene) {
    for (const GoldenMethod& method : golden_methods) {
        visit_ways(method, [&](const GoldenWay& way) {
            World world = make_golden_world(scene, method, way);
            for (int step = 0; step < scene.steps; ++step) {
                take_golden_step(scene, world, step);
                std::printf("%s %s, lanes %d, threads %d, step %d: %016" PRIx64 "\n", scene.name,
                            method.name, way.lanes, way.threads, step + 1, world.state_hash());
            }
        });
    }
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 2) {
        print_ways();
        print_hashes();
        return 0;
    }
    for (const GoldenScene& scene : golden_scenes()) {
        if (std::string(arguments[1]) == scene.name) return print_steps(scene), 0;
    }
    std::fprintf(stderr, "hash_scenes: no scene is named %s; there are:", arguments[1]);
    for (const GoldenScene& scene : golden_scenes()) std::fprintf(stderr, " %s", scene.name);
    std::fprintf(stderr, "\n");
    return 2;
}

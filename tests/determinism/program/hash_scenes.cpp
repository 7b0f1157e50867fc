// The hashes of the golden scenes, as golden_hashes.txt has them: for builds of the library that
// can have nothing beside it, on machines where the tests' own libraries are not.
//
//   hash_scenes               a line a scene and method; "#" before what is not compared. The soft
//   step
//                             is run at every width, and one that differs adds its own line
//   hash_scenes SCENE         the state hash after each step of that scene, by each method and
//   width:
//                             what two builds print parts where their bits do
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

void print_widths() {
    std::printf("# lanes:");
    for (const int width : all_lane_widths) {
        std::printf(has_lane_width(width) ? " %d" : " (%d: not here)", width);
    }
    std::printf("\n");
}

// Calls visit(lanes) for each way to run the method that may not make a difference.
template <class Visit>
void visit_widths(const GoldenMethod& method, Visit visit) {
    if (method.solver != Solver::SoftStep) return visit(0);
    for (const int width : all_lane_widths) {
        if (has_lane_width(width)) visit(width);
    }
}

void print_hashes() {
    for (const GoldenScene& scene : golden_scenes()) {
        for (const GoldenMethod& method : golden_methods) {
            std::string first;
            visit_widths(method, [&](int lanes) {
                const std::string line = run_golden_scene(scene, method, lanes);
                if (first.empty()) std::printf("%s\n", (first = line).c_str());
                if (line != first) std::printf("%s at %d lanes\n", line.c_str(), lanes);
            });
        }
    }
}

void print_steps(const GoldenScene& scene) {
    for (const GoldenMethod& method : golden_methods) {
        visit_widths(method, [&](int lanes) {
            World world = make_golden_world(scene, method, lanes);
            for (int step = 0; step < scene.steps; ++step) {
                take_golden_step(scene, world, step);
                std::printf("%s %s, lanes %d, step %d: %016" PRIx64 "\n", scene.name, method.name,
                            lanes, step + 1, world.state_hash());
            }
        });
    }
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 2) {
        print_widths();
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

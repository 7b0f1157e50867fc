#pragma once
// How a golden scene is run, and what of it is compared: one line of golden_hashes.txt.
//
// The hash of a run is FNV-1a, 64 bits, over the state hashes after each of its steps, each taken
// as eight bytes, the lowest first; so two runs that part and meet again differ.

#include <cstdint>
#include <span>
#include <string>

#include "determinism/golden_scenes.h"

namespace cairn::test {

struct GoldenMethod {
    Solver solver;
    NarrowPhase narrow_phase;
    const char* name;  // as the golden file writes it
};

// Every solver by every narrow phase.
inline constexpr GoldenMethod all_golden_methods[] = {
    {Solver::SequentialImpulse, NarrowPhase::Sat, "sequential-impulse sat"},
    {Solver::SequentialImpulse, NarrowPhase::GjkEpa, "sequential-impulse gjk-epa"},
    {Solver::SoftStep, NarrowPhase::Sat, "soft-step sat"},
    {Solver::Xpbd, NarrowPhase::Sat, "xpbd sat"},
    {Solver::SoftStep, NarrowPhase::GjkEpa, "soft-step gjk-epa"},
    {Solver::Xpbd, NarrowPhase::GjkEpa, "xpbd gjk-epa"},
};
// Every solver and every narrow phase: what the golden scenes run, so that an emulator can follow.
inline constexpr std::span<const GoldenMethod> golden_methods{all_golden_methods, 4};

// What may be told to a run and may not be seen in it.
struct GoldenWay {
    int lanes = 0;  // step.lanes; 0: as many as there are
    int threads = 1;
};

// Each width and each number of threads at least once.
inline constexpr GoldenWay golden_ways[] = {{1, 1}, {4, 2}, {8, 3}, {16, 4}, {0, 8}};

class RunHash {
public:
    // Once a step.
    void add(const World& world);
    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

// A world of the scene before its first step. A call of the scene's that is refused, then or later,
// ends the program with a word: it would make the hashes say less than they seem to.
World make_golden_world(const GoldenScene& scene, const GoldenMethod& method,
                        const GoldenWay& way = {});
// The user's part, then the step.
void take_golden_step(const GoldenScene& scene, World& world, int step);
// "scene solver narrow-phase steps hash".
std::string golden_line(const std::string& scene, const std::string& method, int steps,
                        std::uint64_t hash);
// A whole run.
std::string run_golden_scene(const GoldenScene& scene, const GoldenMethod& method,
                             const GoldenWay& way = {});

}  // namespace cairn::test

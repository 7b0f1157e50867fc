#pragma once
// A run of a scene: what the flags change, the steps with their times and samples, and the result
// file.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace cairn::scene {

/// What the command line says over and above the scene.
struct RunOptions {
    std::optional<std::int64_t> steps = {};
    std::optional<double> seconds = {};
    std::optional<double> dt = {};
    std::optional<std::string> solver = {};
    std::optional<std::int64_t> substeps = {};
    std::optional<std::int64_t> iterations = {};
    std::optional<std::string> narrow_phase = {};
    std::optional<std::string> broad_phase = {};
    std::int64_t sample_every = 0;  ///< 0: no samples
};

/// A scene with every setting as it will run, and for how many steps.
struct RunPlan {
    Scene scene = {};
    std::uint64_t steps = 0;
    std::uint64_t sample_every = 0;
    int threads = 1;  ///< of the built world: whoever runs the plan sets them
};

/// Naming another solver than the scene's takes that solver's own substeps and iterations, unless
/// the options give them. An error names the flag.
Result<RunPlan> plan_run(Scene scene, const RunOptions& options);

struct RunRecord {
    std::vector<double> step_ms = {};               ///< wall time of each step
    std::array<double, stage_count> stage_ms = {};  ///< summed over all steps but the first
    std::string samples = {};                       ///< the elements of "samples", as JSON
    double first_energy = 0;                        ///< J, before the first step
};

/// Called after every step with how many are done; false ends the run.
using StepHook = std::function<bool(const World& world, std::uint64_t done)>;

/// Takes the plan's steps. An error where the world refuses to step.
Result<RunRecord> perform_run(BuiltWorld& built, const RunPlan& plan, const StepHook& hook);

/// The result file's text.
std::string write_result(const BuiltWorld& built, const RunPlan& plan, const RunRecord& record);

/// "sequential-impulse, 1 x 10, sat, brute-force, dt 0.0167 s": the settings in one line.
std::string describe_settings(const Scene& scene);

struct StepTimes {
    double first = 0, mean = 0, p50 = 0, p95 = 0,
           max = 0;  // ms; all but `first` leave the first out
};
StepTimes summarise_times(const std::vector<double>& step_ms);

}  // namespace cairn::scene

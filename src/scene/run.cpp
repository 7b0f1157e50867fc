// A run of a scene: settings, steps, times, samples.
//
// Reads: a Scene and flags. Writes: a World that has taken its steps, and a RunRecord. The wall
// clock is read around each step and reaches nothing but the record.

#include "scene/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "scene/result.h"

namespace cairn::scene {

namespace {

template <class Value>
Status apply_word(const std::optional<std::string>& word, const char* flag,
                  Result<Value> (*parse)(std::string_view), Value& out) {
    if (!word) return Done{};
    const Result<Value> parsed = parse(*word);
    if (!parsed) {
        return Error{parsed.error().code, fmt::format("{}: {}", flag, parsed.error().message)};
    }
    out = *parsed;
    return Done{};
}

Status apply_count(const std::optional<std::int64_t>& count, const char* flag, int& out) {
    if (!count) return Done{};
    if (*count < 1 || *count > 1000) {
        return Error{
            ErrorCode::OutOfRange,
            fmt::format("{}: found {}; allowed: a whole number from 1 to 1000", flag, *count)};
    }
    out = static_cast<int>(*count);
    return Done{};
}

Status apply_step_settings(Scene& scene, const RunOptions& options) {
    StepSettings& step = scene.world.step;
    const Solver solver_of_scene = step.solver;
    if (Status status = apply_word(options.solver, "--solver", parse_solver, step.solver);
        !status) {
        return status;
    }
    if (step.solver != solver_of_scene) step.substeps = step.iterations = 0;
    if (step.substeps == 0) step.substeps = default_substeps(step.solver);
    if (step.iterations == 0) step.iterations = default_iterations(step.solver);
    Status status = apply_count(options.substeps, "--substeps", step.substeps);
    if (status) status = apply_count(options.iterations, "--iterations", step.iterations);
    if (status) {
        status = apply_word(options.narrow_phase, "--narrow-phase", parse_narrow_phase,
                            step.narrow_phase);
    }
    if (status) {
        status =
            apply_word(options.broad_phase, "--broad-phase", parse_broad_phase, step.broad_phase);
    }
    return status;
}

Result<std::uint64_t> count_steps(double seconds, double dt, const char* flag) {
    if (!(seconds >= 0) || !std::isfinite(seconds)) {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("{}: found {}; allowed: seconds, at least 0", flag, seconds)};
    }
    const double steps = std::floor(seconds / dt + 0.5);
    constexpr double most = 1e12;
    if (!(steps <= most)) {
        return Error{
            ErrorCode::OutOfRange,
            fmt::format("{}: {} s in steps of {} s are {:.3g} steps; allowed: at most {:.0e}", flag,
                        seconds, dt, steps, most)};
    }
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(steps));
}

}  // namespace

Result<RunPlan> plan_run(Scene scene, const RunOptions& options) {
    RunPlan plan;
    if (const Status status = apply_step_settings(scene, options); !status) return status.error();
    if (options.dt) {
        if (!(*options.dt >= min_dt && *options.dt <= max_dt)) {
            return Error{ErrorCode::OutOfRange,
                         fmt::format("--dt: found {}; allowed: seconds from {} "
                                     "to {}",
                                     *options.dt, min_dt, max_dt)};
        }
        scene.dt = *options.dt;
    }
    if (options.steps && options.seconds) {
        return Error{ErrorCode::OutOfRange,
                     "--steps and --seconds: found both; allowed: one of them"};
    }
    if (options.steps) {
        if (*options.steps < 0) {
            return Error{ErrorCode::OutOfRange, fmt::format("--steps: found {}; allowed: a whole "
                                                            "number, at least 0",
                                                            *options.steps)};
        }
        plan.steps = static_cast<std::uint64_t>(*options.steps);
    } else {
        const auto steps = options.seconds ? count_steps(*options.seconds, scene.dt, "--seconds")
                                           : count_steps(scene.duration, scene.dt, "duration");
        if (!steps) return steps.error();
        plan.steps = *steps;
    }
    if (options.sample_every < 0) {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("--sample-every: found {}; allowed: a whole "
                                 "number, at least 1",
                                 options.sample_every)};
    }
    plan.sample_every = static_cast<std::uint64_t>(options.sample_every);
    plan.scene = std::move(scene);
    return plan;
}

Result<RunRecord> perform_run(BuiltWorld& built, const RunPlan& plan, const StepHook& hook) {
    using Clock = std::chrono::steady_clock;
    RunRecord record;
    World& world = built.world;
    record.first_energy = world.energy().total;
    if (plan.sample_every > 0) append_sample(record.samples, built, 0);
    for (std::uint64_t step = 1; step <= plan.steps; ++step) {
        const Clock::time_point start = Clock::now();
        const Status status = world.step(plan.scene.dt);
        const std::chrono::duration<double, std::milli> taken = Clock::now() - start;
        if (!status) {
            return Error{status.error().code,
                         fmt::format("step {}: {}", step, status.error().message)};
        }
        record.step_ms.push_back(taken.count());
        if (step > 1) {
            const auto& seconds = world.last_step().stage_seconds;
            for (std::size_t i = 0; i < stage_count; ++i) record.stage_ms[i] += 1000 * seconds[i];
        }
        if (plan.sample_every > 0 && step % plan.sample_every == 0) {
            append_sample(record.samples, built, static_cast<double>(step) * plan.scene.dt);
        }
        if (hook && !hook(world, step)) break;
    }
    return record;
}

std::string describe_settings(const Scene& scene) {
    const StepSettings& step = scene.world.step;
    return fmt::format("{}, {} substep{} of {} iteration{}, {}, {}, dt {:.4g} s",
                       solver_name(step.solver), step.substeps, step.substeps == 1 ? "" : "s",
                       step.iterations, step.iterations == 1 ? "" : "s",
                       narrow_phase_name(step.narrow_phase), broad_phase_name(step.broad_phase),
                       scene.dt);
}

StepTimes summarise_times(const std::vector<double>& step_ms) {
    StepTimes times;
    if (step_ms.empty()) return times;
    times.first = step_ms.front();
    std::vector<double> sorted(step_ms.begin() + 1, step_ms.end());
    // A single step is all there is to tell of.
    if (sorted.empty()) sorted.push_back(times.first);
    std::sort(sorted.begin(), sorted.end());
    const auto rank = [&](double part) {
        const auto place =
            static_cast<std::size_t>(std::ceil(part * static_cast<double>(sorted.size())));
        return sorted[std::max<std::size_t>(place, 1) - 1];
    };
    times.mean =
        std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(sorted.size());
    times.p50 = rank(0.5);
    times.p95 = rank(0.95);
    times.max = sorted.back();
    return times;
}

}  // namespace cairn::scene

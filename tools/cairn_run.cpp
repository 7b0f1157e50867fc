// `cairn run`: loads, plans, steps, writes the result, the replay and the trace, and says how it
// went.
//
// With `--json -` standard output carries the result alone, and the summary goes to standard error.

#include "cairn_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <optional>

#include "cairn_terminal.h"
#include "scene/builtin.h"
#include "scene/json_tree.h"
#include "scene/replay.h"
#include "scene/trace.h"

namespace cairn::tool {

using scene::Builtin;
using scene::BuiltWorld;
using scene::RunPlan;
using scene::RunRecord;
using scene::Scene;

namespace {

Error explain_missing(const std::string& source) {
    const std::string shown = scene::make_printable(source, 200);
    const std::string_view near = scene::find_nearest_builtin(source);
    if (source.find_first_of("./") != std::string::npos && near.empty()) {
        return {ErrorCode::OutOfRange, fmt::format("{}: no such file", shown)};
    }
    return {
        ErrorCode::OutOfRange,
        fmt::format("{}: neither a built-in scene nor a file{}; `cairn scenes` lists the built-in "
                    "ones",
                    shown, near.empty() ? "" : fmt::format(", did you mean \"{}\"?", near))};
}

}  // namespace

Result<Scene> load_scene(const std::string& source, const std::vector<std::string>& settings) {
    if (const Builtin* builtin = scene::find_builtin(source)) {
        return scene::make_builtin(*builtin, settings);
    }
    std::error_code ignored;
    if (source != "-" && !std::filesystem::exists(source, ignored)) return explain_missing(source);
    if (!settings.empty()) {
        return Error{ErrorCode::OutOfRange,
                     "--set: found beside a scene file; allowed: with a built-in scene only"};
    }
    Result<Scene> read = scene::read_scene_file(source);
    if (!read) {
        return Error{
            read.error().code,
            fmt::format("{}: {}",
                        source == "-" ? "standard input" : scene::make_printable(source, 200),
                        read.error().message)};
    }
    Scene loaded = std::move(read).value();
    if (loaded.name.empty()) {
        loaded.name =
            source == "-" ? "standard input" : std::filesystem::path(source).stem().string();
    }
    return loaded;
}

namespace {

Status check_usage(const RunCommand& command) {
    const auto check_count = [](std::int64_t count, int most, const char* flag) -> Status {
        if (count >= 1 && count <= most) return Done{};
        return Error{
            ErrorCode::OutOfRange,
            fmt::format("{}: found {}; allowed: a whole number from 1 to {}", flag, count, most)};
    };
    Status threads = check_count(command.threads, max_thread_count, "--threads");
    if (!threads) return threads;
    if (command.trace == "-")
        return Error{ErrorCode::OutOfRange, "--trace: found -; allowed: a file"};
    return command.lanes == 0 ? Status(Done{}) : check_count(command.lanes, 1024, "--lanes");
}

// Finds out before a long run whether its result can be kept.
Status check_writable(const std::string& path, const char* flag) {
    if (path.empty() || path == "-") return Done{};
    std::error_code ignored;
    const bool was_there = std::filesystem::exists(path, ignored);
    std::FILE* file = std::fopen(path.c_str(), "ab");
    if (file == nullptr) {
        return Error{ErrorCode::OutOfRange, fmt::format("{} {}: cannot write there: {}", flag, path,
                                                        std::strerror(errno))};
    }
    std::fclose(file);
    if (!was_there) std::filesystem::remove(path, ignored);
    return Done{};
}

Status write_text(const std::string& path, const std::string& text) {
    const bool to_standard_output = path == "-";
    std::FILE* file = to_standard_output ? stdout : std::fopen(path.c_str(), "wb");
    if (file == nullptr) {
        return Error{ErrorCode::OutOfRange, fmt::format("{}: {}", path, std::strerror(errno))};
    }
    bool is_well = std::fwrite(text.data(), 1, text.size(), file) == text.size();
    is_well = (to_standard_output ? std::fflush(file) : std::fclose(file)) == 0 && is_well;
    if (is_well) return Done{};
    return Error{ErrorCode::OutOfRange, fmt::format("{}: {}", path, std::strerror(errno))};
}

const char* quantity_words(Quantity quantity) {
    switch (quantity) {
        case Quantity::LinearVelocity: return "linear velocity";
        case Quantity::AngularVelocity: return "angular velocity";
        case Quantity::Position: return "position";
        case Quantity::Rotation: return "rotation";
    }
    return "";
}

// "find-pairs 0.11, find-axes 0.02, ... ms": the mean of all steps but the first.
std::string describe_stages(const RunRecord& record) {
    const auto steps = static_cast<double>(record.step_ms.size() - 1);
    std::string text;
    for (std::size_t i = 0; i < stage_count; ++i) {
        text += fmt::format("{}{} {:.2g}", i == 0 ? "" : ", ", stage_name(static_cast<Stage>(i)),
                            record.stage_ms[i] / steps);
    }
    return text + " ms";
}

void print_summary(std::FILE* out, const BuiltWorld& built, const RunPlan& plan,
                   const RunRecord& record) {
    const World& world = built.world;
    const std::vector<ContactReport> contacts = world.contacts();
    std::size_t point_count = 0;
    for (const ContactReport& contact : contacts) {
        point_count += static_cast<std::size_t>(contact.point_count);
    }
    const Penetration penetration = World::penetration(contacts);
    const scene::StepTimes times = scene::summarise_times(record.step_ms);
    const double total_ms = std::accumulate(record.step_ms.begin(), record.step_ms.end(), 0.0);
    const double simulated = static_cast<double>(record.step_ms.size()) * plan.scene.dt;
    fmt::print(out, "{}\n", plan.scene.name);
    fmt::print(out, "  settings     {}\n", scene::describe_settings(plan.scene));
    fmt::print(out, "  simulated    {:.4g} s in {} steps\n", simulated, record.step_ms.size());
    fmt::print(out, "  bodies       {}, of which {} sleep at the end\n", built.names.size(),
               world.last_step().asleep_count);
    fmt::print(out, "  contacts     {} pairs, {} points\n", contacts.size(), point_count);
    fmt::print(
        out, "  a step       {:.3g} ms (median {:.3g}, 95% {:.3g}, longest {:.3g}), {} thread{}\n",
        times.mean, times.p50, times.p95, times.max,
        plan.threads == 1 ? "one" : std::to_string(plan.threads), plan.threads == 1 ? "" : "s");
    if (record.step_ms.size() > 1) fmt::print(out, "  stages       {}\n", describe_stages(record));
    fmt::print(out, "  energy       {:.6g} J (at the start {:.6g} J)\n", world.energy().total,
               record.first_energy);
    fmt::print(out, "  penetration  {:.3g} mm at the deepest, {:.3g} mm on average\n",
               1000 * penetration.deepest, 1000 * penetration.mean);
    if (total_ms > 0)
        fmt::print(out, "  real time    {:.3g} times as fast\n", 1000 * simulated / total_ms);
}

// The last of a long run: 4 MB a thread, some hundreds of a large world's steps.
constexpr std::size_t trace_spans_a_thread = std::size_t{1} << 17;

struct Attempt {
    BuiltWorld built;
    RunPlan plan;
    RunRecord record;
    std::optional<scene::ReplayRecorder> recorder;
};

scene::ReplayInfo make_replay_info(const Attempt& attempt) {
    const Scene& scene = attempt.plan.scene;
    return {scene.name, scene.description,  attempt.built.names, scene::describe_settings(scene),
            scene.dt,   attempt.plan.steps, scene.camera};
}

// Writes what was asked for; the worst of what happened.
int deliver(const RunCommand& command, const Attempt& attempt) {
    int status = done;
    if (!command.json.empty()) {
        const std::string text = scene::write_result(attempt.built, attempt.plan, attempt.record);
        if (const Status written = write_text(command.json, text); !written) {
            status = fail(went_wrong, "the result was not written: " + written.error().message);
        }
    }
    if (attempt.recorder) {
        if (const Status written = attempt.recorder->write(command.replay); !written) {
            status = fail(went_wrong, "the replay was not written: " + written.error().message);
        }
    }
    Trace trace;
    if (!command.trace.empty()) {
        trace = attempt.built.world.trace();
        const Status written = write_text(command.trace, scene::trace_to_json(trace.spans));
        if (!written)
            status = fail(went_wrong, "the trace was not written: " + written.error().message);
    }
    if (!command.quiet) {
        std::FILE* out = command.json == "-" ? stderr : stdout;
        print_summary(out, attempt.built, attempt.plan, attempt.record);
        if (!command.json.empty() && command.json != "-")
            fmt::print(out, "  result       {}\n", command.json);
        if (attempt.recorder) fmt::print(out, "  replay       {}\n", command.replay);
        if (!command.trace.empty())
            fmt::print(out, "  trace        {}{}\n", command.trace,
                       trace.forgotten_count > 0 ? ", of the last steps" : "");
    }
    return status;
}

}  // namespace

int run(const RunCommand& command) {
    if (const Status usage = check_usage(command); !usage)
        return fail(bad_usage, usage.error().message);
    Result<Scene> loaded = load_scene(command.scene, command.settings);
    if (!loaded) return fail(bad_usage, loaded.error().message);
    scene::Scene scene = std::move(loaded).value();
    scene.world.step.lanes = static_cast<int>(command.lanes);
    Result<RunPlan> plan = scene::plan_run(std::move(scene), command.options);
    if (!plan) return fail(bad_usage, plan.error().message);
    for (const auto& [path, flag] :
         {std::pair(command.json, "--json"), std::pair(command.replay, "--replay"),
          std::pair(command.trace, "--trace")}) {
        if (const Status status = check_writable(path, flag); !status) {
            return fail(bad_usage, status.error().message);
        }
    }
    Result<BuiltWorld> built = scene::build_world(plan->scene);
    if (!built) return fail(bad_usage, fmt::format("{}: {}", command.scene, built.error().message));

    Attempt attempt{std::move(built).value(), std::move(plan).value(), {}, {}};
    attempt.plan.threads = static_cast<int>(command.threads);
    const Status threads = attempt.built.world.set_threads({.count = attempt.plan.threads});
    if (!threads) return fail(went_wrong, threads.error().message);
    if (!command.trace.empty()) (void)attempt.built.world.set_trace(trace_spans_a_thread);
    if (!command.replay.empty())
        attempt.recorder.emplace(attempt.built.world, make_replay_info(attempt));
    ProgressBar bar(attempt.plan.steps, !command.quiet);
    Result<RunRecord> record = scene::perform_run(attempt.built, attempt.plan,
                                                  [&](const World& world, std::uint64_t step) {
                                                      if (attempt.recorder)
                                                          attempt.recorder->record(world);
                                                      bar.update(step);
                                                      return true;
                                                  });
    bar.clear();
    if (!record) return fail(went_wrong, record.error().message);
    attempt.record = std::move(record).value();

    int status = deliver(command, attempt);
    const auto non_finite = attempt.built.world.non_finite();
    if (!non_finite.empty()) {
        const NonFinite& first = non_finite.front();
        const std::vector<BodyId> ids = attempt.built.world.bodies();
        const auto place = std::find(ids.begin(), ids.end(), first.body) - ids.begin();
        status = fail(went_wrong,
                      fmt::format("{} bod{} became non-finite, first the {} of \"{}\" in step {} "
                                  "({:.4g} s)",
                                  non_finite.size(), non_finite.size() == 1 ? "y" : "ies",
                                  quantity_words(first.quantity),
                                  attempt.built.names[static_cast<std::size_t>(place)], first.step,
                                  first.time));
    }
    return status;
}

}  // namespace cairn::tool

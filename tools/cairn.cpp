// The command line: `cairn run`, `query`, `scenes`, `export`, `check`, `bench`.
//
// Exit status: 0 done; 1 the run went wrong; 2 bad usage, a bad scene or something not supported,
// with one message on standard error.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "cairn_bench.h"
#include "cairn_query.h"
#include "cairn_run.h"
#include "cairn_terminal.h"
#include "scene/builtin.h"
#include "scene/check.h"
#include "scene/json_tree.h"

namespace {

using namespace cairn;
using tool::bad_usage;
using tool::done;
using tool::fail;

int list_scenes() {
    for (const scene::Builtin& builtin : scene::builtins()) {
        fmt::print("{:<12} {}\n", builtin.name, builtin.line);
        fmt::print("{:<12}   look: {}\n", "", builtin.look);
        for (const std::string& line : scene::describe_parameters(builtin)) {
            fmt::print("{:<12}   --set {}\n", "", line);
        }
    }
    return done;
}

int export_scene(const std::string& name, const std::vector<std::string>& settings) {
    if (scene::find_builtin(name) == nullptr) {
        const std::string_view near = scene::find_nearest_builtin(name);
        return fail(bad_usage,
                    fmt::format("{}: no built-in scene{}; `cairn scenes` lists them", name,
                                near.empty() ? "" : fmt::format(", did you mean \"{}\"?", near)));
    }
    const Result<scene::Scene> made = tool::load_scene(name, settings);
    if (!made) return fail(bad_usage, made.error().message);
    fmt::print("{}", scene::write_scene(*made));
    return std::fflush(stdout) == 0 ? done
                                    : fail(tool::went_wrong, "standard output cannot be written");
}

int check_scene(const std::string& source, const std::vector<std::string>& settings) {
    const Result<scene::Scene> loaded = tool::load_scene(source, settings);
    if (!loaded) return fail(bad_usage, loaded.error().message);
    const Result<std::vector<scene::Finding>> findings = scene::find_misbehaviour(*loaded);
    if (!findings) return fail(bad_usage, fmt::format("{}: {}", source, findings.error().message));
    fmt::print("{}: a valid scene of {} bodies; {}\n", source, scene::count_bodies(*loaded),
               findings->empty() ? "nothing in it looks like trouble"
                                 : fmt::format("{} thing{} in it may misbehave:", findings->size(),
                                               findings->size() == 1 ? "" : "s"));
    for (const scene::Finding& finding : *findings) {
        fmt::print("  {}: {}; cure: {}\n", finding.where, finding.what, finding.cure);
    }
    return done;
}

void add_run_options(CLI::App& app, tool::RunCommand& run) {
    scene::RunOptions& options = run.options;
    app.add_option("SCENE", run.scene,
                   "a scene file, - for standard input, or a built-in scene's name")
        ->required();
    app.add_option("--set", run.settings, "a built-in scene's parameter, key=value")
        ->type_size(1)
        ->allow_extra_args(false);
    app.add_option("--steps", options.steps, "how many steps; 0 reports the initial state");
    app.add_option("--seconds", options.seconds,
                   "how long to simulate instead of the scene's duration");
    app.add_option("--dt", options.dt, "seconds a step");
    app.add_option("--solver", options.solver, "soft-step, sequential-impulse or xpbd");
    app.add_option("--substeps", options.substeps, "substeps a step, 1 to 1000");
    app.add_option("--iterations", options.iterations, "iterations a substep, 1 to 1000");
    app.add_option("--narrow-phase", options.narrow_phase, "sat or gjk-epa");
    app.add_option("--broad-phase", options.broad_phase, "tree or brute-force");
    app.add_option("--threads", run.threads,
                   "how many threads may share a step's work; never changes a result");
    app.add_option("--lanes", run.lanes,
                   "at most N contacts side by side; default: as many as the processor can");
    app.add_option("--json", run.json, "write the result to this file, - for standard output");
    app.add_option("--sample-every", options.sample_every, "samples in the result, every K steps")
        ->check(CLI::PositiveNumber);
    app.add_option("--replay", run.replay, "write a page that plays the run, FILE.html");
    app.add_option("--trace", run.trace,
                   "write what the steps did when, a row a thread, FILE.json for "
                   "chrome://tracing or ui.perfetto.dev");
    app.add_flag("--quiet", run.quiet, "no progress bar, no summary");
}

void add_bench_options(CLI::App& app, tool::BenchCommand& bench) {
    app.add_option("SCENE", bench.scenes, "scenes of the benchmark; none: all of them");
    app.add_option("--threads", bench.threads, "counts with commas: 1,2");
    app.add_option("--peers", bench.peers, "all, none, or names with commas: jolt,cairn:xpbd");
    app.add_option("--repeats", bench.repeats, "how many rounds, each engine once a round");
    app.add_option("--steps", bench.steps, "how many steps instead of each scene's own");
    app.add_option("--time-limit", bench.time_limit, "seconds after which a run is ended");
    app.add_flag("--memory", bench.memory, "measure bytes a body too");
    app.add_option("--json", bench.json, "write the figures to this file, - for standard output");
    app.add_option("--html", bench.html, "write a page with bars, FILE.html");
}

void add_query_options(CLI::App& app, tool::QueryCommand& query) {
    app.add_option("SCENE", query.scene, "a scene file, -, or a built-in scene's name")->required();
    const auto add_list = [&](const char* flag, std::vector<std::string>& list, const char* help) {
        app.add_option(flag, list, help)->type_size(1)->allow_extra_args(false);
    };
    add_list("--set", query.settings, "a built-in scene's parameter, key=value");
    add_list("--ray", query.rays, "what it meets: ox,oy,oz,dx,dy,dz[,length], metres; may repeat");
    add_list("--point", query.points, "the nearest surface: x,y,z[,reach]; may repeat");
    add_list("--box", query.boxes, "the bodies in it: lx,ly,lz,ux,uy,uz; may repeat");
    app.add_option("--steps", query.steps, "how many steps to take first");
    app.add_flag("--all", query.all, "all that a ray meets, not only the first");
}

int run_command_line(int argc, char** argv) {
    CLI::App app{"Cairn, a 3D rigid-body physics engine that you can see into"};
    app.set_version_flag("--version", version());
    app.require_subcommand(1);
    tool::RunCommand run;
    CLI::App* run_app = app.add_subcommand("run", "simulate a scene");
    add_run_options(*run_app, run);

    tool::QueryCommand query;
    CLI::App* query_app =
        app.add_subcommand("query", "tell what rays meet in a scene, and what is where, as JSON");
    add_query_options(*query_app, query);

    CLI::App* scenes_app =
        app.add_subcommand("scenes", "list the built-in scenes and their parameters");
    std::string source;
    std::vector<std::string> settings;
    CLI::App* export_app = app.add_subcommand("export", "print a built-in scene as a scene file");
    export_app->add_option("NAME", source, "a built-in scene's name")->required();
    CLI::App* check_app =
        app.add_subcommand("check", "tell whether a scene is valid, and what in it will misbehave");
    check_app->add_option("SCENE", source, "a scene file, -, or a built-in scene's name")
        ->required();
    for (CLI::App* sub : {export_app, check_app}) {
        sub->add_option("--set", settings, "a built-in scene's parameter, key=value")
            ->type_size(1)
            ->allow_extra_args(false);
    }
    CLI::App* report_app =
        app.add_subcommand("report", "not yet part of this version")->allow_extras();
    tool::BenchCommand bench;
    CLI::App* bench_app = app.add_subcommand("bench", "time Cairn beside the peers that are there");
    add_bench_options(*bench_app, bench);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        // Help and the version are no failures.
        if (error.get_exit_code() == 0) return app.exit(error);
        const std::string first = argc > 1 ? argv[1] : "";
        if (app.get_subcommands().empty() && !first.empty() && first[0] != '-') {
            return fail(bad_usage,
                        fmt::format("found the command \"{}\"; allowed: run, query, scenes, "
                                    "export, check, report, bench",
                                    scene::make_printable(first)));
        }
        return fail(bad_usage, std::string(error.what()) +
                                   "; `cairn --help` and `cairn run --help` tell more");
    }
    if (*run_app) return tool::run(run);
    if (*query_app) return tool::query(query);
    if (*scenes_app) return list_scenes();
    if (*export_app) return export_scene(source, settings);
    if (*check_app) return check_scene(source, settings);
    if (*report_app) return fail(bad_usage, "report: not yet part of this version");
    if (*bench_app) return tool::bench(bench);
    return bad_usage;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run_command_line(argc, argv);
    } catch (const std::bad_alloc&) {
        return fail(tool::went_wrong, "out of memory");
    } catch (const std::exception& error) {
        return fail(tool::went_wrong, error.what());
    }
}

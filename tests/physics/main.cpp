// cairn_physics_table: every case with a known answer, for every solver.
//
// Exit status 0 where every row is as recorded, 1 where one is not, 2 where the command makes no
// sense.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>

#include "table.h"

namespace {

using namespace cairn;
using namespace cairn::physics;

struct Command {
    Selection selection;
    std::string solver, narrow_phase;
    bool markdown = false, json = false, failing = false, timing = false;
    int workers = 2;
};

// Leaves what is off alone.
void keep_failing(std::vector<Run>& runs) {
    for (Run& run : runs) {
        std::erase_if(run.rows, [](const RunRow& row) { return row.is_as_recorded(); });
    }
}

int run_table(const Command& command) {
    const std::vector<Case> cases = all_cases();
    std::vector<Run> runs = plan_runs(cases, command.selection);
    if (runs.empty()) {
        std::fprintf(stderr, "No case is like that.\n");
        return 2;
    }
    run_all(runs, command.workers);
    const Selection& s = command.selection;
    const bool whole = s.case_id.empty() && s.steps_per_second == 0 && !s.quick;
    const std::vector<Run> complete = runs;
    if (command.failing) keep_failing(runs);
    const Format format = command.json       ? Format::Json
                          : command.markdown ? Format::Markdown
                                             : Format::Plain;
    print(stdout, runs, format);
    // JSON is for other programs: the words for people go elsewhere.
    std::FILE* words = command.json ? stderr : stdout;
    if (command.timing) {
        for (const Run& run : complete) {
            std::fprintf(words, "%7.2f s  %s %s %s 1/%ld\n", run.seconds,
                         std::string(run.subject->id).c_str(), name(run.setup.solver),
                         name(run.setup.narrow_phase), std::lround(1 / run.setup.dt));
        }
    }
    std::fprintf(words, "\n");
    return print_summary(words, complete, whole) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    Command command;
    CLI::App app{"Cairn's accuracy table: every solver against cases with a known answer."};
    app.add_option("--case", command.selection.case_id, "only cases whose id begins so: D08, F");
    app.add_option("--solver", command.solver, "only this solver")
        ->check(CLI::IsMember({"sequential-impulse", "soft-step", "xpbd"}));
    app.add_option("--narrow-phase", command.narrow_phase, "this narrow phase, for every case")
        ->check(CLI::IsMember({"sat", "gjk-epa"}));
    app.add_option("--dt", command.selection.steps_per_second, "only this many steps a second: 240")
        ->check(CLI::PositiveNumber);
    app.add_option("--workers", command.workers, "runs side by side")->check(CLI::Range(1, 64));
    app.add_flag("--quick", command.selection.quick, "the quick cases, at their coarsest step");
    app.add_flag("--failing", command.failing, "print only rows that are not as recorded");
    app.add_flag("--markdown", command.markdown, "print the table as Markdown");
    app.add_flag("--json", command.json, "print the rows as JSON, the summary on stderr");
    app.add_flag("--timing", command.timing, "say how long each run took");
    app.add_flag("--verbose", command.selection.verbose, "cases may tell how they go");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    if (!command.solver.empty()) {
        command.selection.solver = command.solver == "xpbd"        ? Solver::Xpbd
                                   : command.solver == "soft-step" ? Solver::SoftStep
                                                                   : Solver::SequentialImpulse;
    }
    if (!command.narrow_phase.empty()) {
        command.selection.narrow_phase =
            command.narrow_phase == "sat" ? NarrowPhase::Sat : NarrowPhase::GjkEpa;
    }
    if (command.selection.verbose) command.workers = 1;
    return run_table(command);
}

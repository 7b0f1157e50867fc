// The accuracy table's machinery: the plan of runs, the workers, the printing.
//
// A case counts as met, for a solver, where all rows of all its runs are; at most one case in ten
// may stand on record as unmet. A record that no longer holds fails as loudly as a row that is off.

#include "table.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

namespace cairn::physics {

namespace {

// A step as people call it: 1/240.
std::string step_name(double dt) { return "1/" + std::to_string(std::lround(1 / dt)); }

bool has_solver(const Run& run) {
    return run.subject->subject == Subject::Motion || run.subject->subject == Subject::Piling;
}
bool has_narrow_phase(const Run& run) { return run.subject->subject != Subject::Mass; }
std::string solver_of(const Run& run) { return has_solver(run) ? name(run.setup.solver) : "-"; }
std::string narrow_phase_of(const Run& run) {
    return has_narrow_phase(run) ? name(run.setup.narrow_phase) : "-";
}
std::string step_of(const Run& run) { return has_solver(run) ? step_name(run.setup.dt) : "-"; }

std::string_view find_reason(const Run& run, const Row& row) {
    for (const KnownUnmet& unmet : run.subject->known_unmet) {
        const bool same_step = unmet.dt == 0 || std::abs(unmet.dt - run.setup.dt) < 1e-9;
        if (unmet.solver == run.setup.solver && same_step && row.what.starts_with(unmet.row)) {
            return unmet.reason;
        }
    }
    return {};
}

void run_one(Run& run) {
    const auto start = std::chrono::steady_clock::now();
    Sheet sheet;
    try {
        run.subject->run(run.setup, sheet);
    } catch (const std::exception& problem) {
        sheet.claim(std::string("runs to its end: ") + problem.what(), false);
    }
    for (const Row& row : sheet.rows()) run.rows.push_back({row, find_reason(run, row)});
    if (run.rows.empty()) run.rows.push_back({{"writes something down", 0, 1, 1, 0}, {}});
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string verdict(const RunRow& row) {
    if (row.is_as_recorded()) return row.reason.empty() ? "met" : "unmet, on record";
    return row.reason.empty() ? "NOT MET" : "MET, BUT ON RECORD AS UNMET";
}

std::string figure(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.7g", value);
    return text;
}

std::string ratio(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

std::vector<std::string> cells(const Run& run, const RunRow& row) {
    const Row& r = row.row;
    return {std::string(run.subject->id),
            std::string(run.subject->title) + ": " + r.what,
            solver_of(run),
            narrow_phase_of(run),
            step_of(run),
            figure(r.measured),
            figure(r.expected),
            figure(r.error),
            figure(r.tolerance),
            ratio(r.ratio()),
            verdict(row)};
}

const std::vector<std::string> heading = {
    "case",     "what",  "solver",    "narrow phase",    "step", "measured",
    "expected", "error", "tolerance", "error/tolerance", ""};

void print_lines(std::FILE* out, const std::vector<Run>& runs, bool markdown) {
    std::vector<std::vector<std::string>> lines = {heading};
    for (const Run& run : runs) {
        for (const RunRow& row : run.rows) lines.push_back(cells(run, row));
    }
    std::vector<std::size_t> widths(heading.size(), markdown ? 3 : 0);
    for (const auto& line : lines) {
        for (std::size_t i = 0; i < line.size(); ++i)
            widths[i] = std::max(widths[i], line[i].size());
    }
    const char* edge = markdown ? "| " : "";
    const char* gap = markdown ? " | " : "  ";
    for (std::size_t n = 0; n < lines.size(); ++n) {
        std::string text = edge;
        for (std::size_t i = 0; i < lines[n].size(); ++i) {
            const bool is_number = i >= 5 && i <= 9;
            const std::string pad(widths[i] - lines[n][i].size(), ' ');
            text += is_number ? pad + lines[n][i] : lines[n][i] + pad;
            text += gap;
        }
        while (!text.empty() && text.back() == ' ') text.pop_back();
        std::fprintf(out, "%s\n", text.c_str());
        if (!markdown || n != 0) continue;
        std::string rule = "|";
        for (std::size_t i = 0; i < widths.size(); ++i) {
            rule += std::string(widths[i] + 1, '-') + (i >= 5 && i <= 9 ? ":|" : "-|");
        }
        std::fprintf(out, "%s\n", rule.c_str());
    }
}

nlohmann::json number(double value) {
    // JSON knows neither infinity nor NaN.
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

void print_json(std::FILE* out, const std::vector<Run>& runs) {
    nlohmann::json rows = nlohmann::json::array();
    for (const Run& run : runs) {
        for (const RunRow& row : run.rows) {
            nlohmann::json entry = {{"case", run.subject->id},
                                    {"title", run.subject->title},
                                    {"what", row.row.what},
                                    {"measured", number(row.row.measured)},
                                    {"expected", number(row.row.expected)},
                                    {"error", number(row.row.error)},
                                    {"tolerance", number(row.row.tolerance)},
                                    {"ratio", number(row.row.ratio())},
                                    {"met", row.row.is_met()}};
            if (has_solver(run)) {
                entry["solver"] = name(run.setup.solver);
                entry["dt"] = run.setup.dt;
            }
            if (has_narrow_phase(run)) entry["narrow_phase"] = name(run.setup.narrow_phase);
            if (!row.reason.empty()) entry["unmet_because"] = row.reason;
            rows.push_back(std::move(entry));
        }
    }
    std::fprintf(out, "%s\n", nlohmann::json{{"rows", rows}}.dump(2).c_str());
}

}  // namespace

const char* name(Solver solver) {
    switch (solver) {
        case Solver::SequentialImpulse: return "sequential-impulse";
        case Solver::SoftStep: return "soft-step";
        case Solver::Xpbd: return "xpbd";
    }
    return "";
}

const char* name(NarrowPhase narrow_phase) {
    return narrow_phase == NarrowPhase::Sat ? "sat" : "gjk-epa";
}

std::vector<Case> all_cases() {
    std::vector<Case> all;
    for (const auto& family :
         {free_body_cases(), mass_cases(), collision_cases(), bounce_cases(), friction_cases(),
          rolling_cases(), rest_cases(), structure_cases(), impact_cases(), determinism_cases()}) {
        all.insert(all.end(), family.begin(), family.end());
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Case& a, const Case& b) { return a.id < b.id; });
    return all;
}

std::vector<Run> plan_runs(const std::vector<Case>& cases, const Selection& selection) {
    std::vector<Run> runs;
    for (const Case& subject : cases) {
        if (!selection.case_id.empty() && !subject.id.starts_with(selection.case_id)) continue;
        if (selection.quick && !subject.quick) continue;
        const bool moves = subject.subject == Subject::Motion || subject.subject == Subject::Piling;
        const bool both =
            subject.subject == Subject::Collision || subject.subject == Subject::Piling;
        std::set<std::string> seen;
        for (const Solver solver : {Solver::SequentialImpulse, Solver::SoftStep, Solver::Xpbd}) {
            for (const NarrowPhase narrow : {NarrowPhase::Sat, NarrowPhase::GjkEpa}) {
                for (const double dt : subject.steps) {
                    Run run{&subject, {solver, narrow, dt, selection.verbose}, 0, {}};
                    if (selection.solver && moves && *selection.solver != solver) continue;
                    if (subject.only && *subject.only != solver) continue;
                    // Asked for by name, a narrow phase goes for every case.
                    const NarrowPhase only = selection.narrow_phase.value_or(NarrowPhase::Sat);
                    if ((selection.narrow_phase || !both) && narrow != only) continue;
                    const bool other_step = std::lround(1 / dt) != selection.steps_per_second;
                    if (selection.steps_per_second > 0 && moves && other_step) continue;
                    if (selection.quick && dt != subject.steps.front()) continue;
                    // The same to all that matters to the case: once is enough.
                    const std::string key = solver_of(run) + narrow_phase_of(run) + step_of(run);
                    if (seen.insert(key).second) runs.push_back(run);
                }
            }
        }
    }
    return runs;
}

void run_all(std::vector<Run>& runs, int workers) {
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < runs.size(); i = next++) run_one(runs[i]);
    };
    std::vector<std::jthread> others;
    for (int i = 1; i < workers; ++i) others.emplace_back(work);
    work();
}

void print(std::FILE* out, const std::vector<Run>& runs, Format format) {
    if (format == Format::Json) {
        print_json(out, runs);
    } else {
        print_lines(out, runs, format == Format::Markdown);
    }
}

bool print_summary(std::FILE* out, const std::vector<Run>& runs, bool whole_table) {
    struct Count {
        std::map<std::string_view, bool> met;  // by case
        int rows = 0, rows_met = 0;
    };
    std::map<std::string, Count> counts;
    int surprises = 0;
    std::set<std::string> reasons;
    for (const Run& run : runs) {
        Count& count = counts[has_solver(run) ? name(run.setup.solver) : "all solvers alike"];
        bool& met = count.met.try_emplace(run.subject->id, true).first->second;
        for (const RunRow& row : run.rows) {
            ++count.rows;
            count.rows_met += row.row.is_met() ? 1 : 0;
            met = met && row.row.is_met();
            surprises += row.is_as_recorded() ? 0 : 1;
            if (!row.reason.empty()) {
                reasons.insert(std::string(run.subject->id) + " " + solver_of(run) + ": " +
                               std::string(row.reason));
            }
        }
    }
    bool good = surprises == 0;
    for (const auto& [solver, count] : counts) {
        const auto met = std::count_if(count.met.begin(), count.met.end(),
                                       [](const auto& entry) { return entry.second; });
        const auto all = static_cast<std::ptrdiff_t>(count.met.size());
        std::fprintf(out, "%s: %td of %td cases met, %d of %d rows\n", solver.c_str(), met, all,
                     count.rows_met, count.rows);
        if (whole_table && (all - met) * 10 > all) {
            std::fprintf(out, "  more than one case in ten is unmet\n");
            good = false;
        }
    }
    for (const std::string& reason : reasons) std::fprintf(out, "unmet: %s\n", reason.c_str());
    if (surprises > 0) std::fprintf(out, "%d rows are not as recorded\n", surprises);
    std::fprintf(out, "%s\n", good ? "The table holds." : "The table does NOT hold.");
    return good;
}

}  // namespace cairn::physics

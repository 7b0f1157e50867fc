#pragma once
// Runs the cases in every way asked for and prints what came out.

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "case.h"

namespace cairn::physics {

enum class Format { Plain, Markdown, Json };

// Which runs are wanted; what is not set leaves all.
struct Selection {
    std::string case_id;
    std::optional<Solver> solver;
    std::optional<NarrowPhase> narrow_phase;
    double steps_per_second = 0;
    bool quick = false;  // the quick cases, at their coarsest step
    bool verbose = false;
};

struct RunRow {
    Row row;
    std::string_view reason;  // of the record that says it cannot be met; empty where there is none
    // Met, or on record as unmet and really so.
    bool is_as_recorded() const { return row.is_met() == reason.empty(); }
};

struct Run {
    const Case* subject = nullptr;
    Setup setup;
    double seconds = 0;  // wall time
    std::vector<RunRow> rows;
};

std::vector<Case> all_cases();
std::vector<Run> plan_runs(const std::vector<Case>& cases, const Selection& selection);
// Runs share nothing; `workers` of them go side by side, and the order of the answers is the
// plan's.
void run_all(std::vector<Run>& runs, int workers);
void print(std::FILE* out, const std::vector<Run>& runs, Format format);
// Counts for each solver; true where every row is as recorded and no record is too long.
bool print_summary(std::FILE* out, const std::vector<Run>& runs, bool whole_table);

const char* name(Solver solver);
const char* name(NarrowPhase narrow_phase);

}  // namespace cairn::physics

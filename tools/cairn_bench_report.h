#pragma once
// What a benchmark found, and the three ways in which it is told: Markdown, JSON, a page with bars.

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace cairn::tool {

struct BenchEngine {
    std::string variant;  // as the command line names it: "jolt", "cairn:xpbd"
    std::string label;    // as people write it: "Jolt 5.5.1"
    std::string program;
};

/// One run: the worker's line of fields, or what went wrong.
struct BenchRun {
    nlohmann::ordered_json fields;
    std::string problem;
};

struct BenchRow {
    std::size_t engine = 0;
    std::vector<BenchRun> runs;
};

/// One scene at one number of threads.
struct BenchTable {
    std::string scene;
    std::string line;  // what the scene is
    int threads = 1;
    int steps = 0;
    std::vector<double> latencies_ns;  // between two cores, one way, a figure a round
    std::vector<BenchRow> rows;        // Cairn's first
};

struct BodyMemory {
    std::size_t engine = 0;
    std::optional<double> static_bytes, moving_bytes;
};

struct BenchReport {
    std::string cairn_version;
    std::string processor, system, compiler;
    unsigned cores = 0;
    std::string date;  // UTC, YYYY-MM-DD
    int repeats = 0;
    std::vector<BenchEngine> engines;
    std::vector<BenchTable> tables;
    std::vector<BodyMemory> memory;
};

/// Of a row's runs that went well: the middle one and the outermost.
struct BenchSpread {
    double median = 0;
    double least = 0;
    double most = 0;
};

/// ms a step: processor time on one thread, wall time on more. Nothing where no run went well.
std::optional<BenchSpread> spread_of_time(const BenchTable& table, const BenchRow& row);
/// Cairn's median over the row's; nothing for Cairn's own row.
std::optional<double> ratio_to(const BenchTable& table, const BenchRow& row);
/// Wall time on one thread over that on this table's threads, where the report has both.
std::optional<double> speedup_of(const BenchReport& report, const BenchTable& table,
                                 const BenchRow& row);
/// A field of the last run that went well.
std::optional<double> find_field(const BenchRow& row, const char* name);
std::string find_settings(const BenchRow& row);
/// What went wrong, with how many of the runs it did; empty where all went well.
std::string describe_problem(const BenchRow& row);

/// A column of the figures beside the time: its title, and each row's text, empty where it has
/// none.
struct BenchColumn {
    std::string title;
    std::vector<std::string> cells;
    /// The row with the least figure, where less is better and no other row has as little.
    std::optional<std::size_t> best;
};
/// Without the columns in which no row has a figure.
std::vector<BenchColumn> make_columns(const BenchReport& report, const BenchTable& table);

/// Of every engine that has run: "label: settings".
std::vector<std::string> list_settings(const BenchReport& report);

void print_head(std::FILE* file, const BenchReport& report);
void print_table(std::FILE* file, const BenchReport& report, const BenchTable& table);
void print_memory(std::FILE* file, const BenchReport& report);
void print_settings(std::FILE* file, const BenchReport& report);
std::string make_json(const BenchReport& report);
std::string make_page(const BenchReport& report);

}  // namespace cairn::tool

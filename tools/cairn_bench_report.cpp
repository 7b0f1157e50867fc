// A benchmark's figures, and how they are told in Markdown and JSON. The page is in
// cairn_bench_page.cpp.

#include "cairn_bench_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cairn::tool {

namespace {

using Json = nlohmann::ordered_json;

// Three figures, without an exponent where people would write none.
std::string say(double x) {
    const double size = std::abs(x);
    if (size >= 1e6 || (size > 0 && size < 1e-3)) return fmt::format("{:.2e}", x);
    return fmt::format("{:.{}f}", x,
                       size >= 99.95    ? 0
                       : size >= 9.995  ? 1
                       : size >= 0.9995 ? 2
                                        : 3);
}

std::string say_length(double metres) {
    const double size = std::abs(metres);
    if (size == 0) return "0";
    if (size >= 0.9995) return say(metres) + " m";
    return size >= 0.9995e-6 ? say(1000 * metres) + " mm" : say(1e9 * metres) + " nm";
}

std::string say_whole(double x) { return fmt::format("{:.0f}", x); }

const char* say_clock(const BenchTable& table) { return table.threads == 1 ? "processor" : "wall"; }

std::string say_count(int n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

}  // namespace

namespace {

std::optional<BenchSpread> spread_of(const BenchRow& row, const char* field) {
    std::vector<double> values;
    for (const BenchRun& run : row.runs) {
        if (run.problem.empty()) values.push_back(run.fields.at(field).get<double>());
    }
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const std::size_t count = values.size();
    return BenchSpread{0.5 * (values[(count - 1) / 2] + values[count / 2]), values.front(),
                       values.back()};
}

}  // namespace

std::optional<BenchSpread> spread_of_time(const BenchTable& table, const BenchRow& row) {
    return spread_of(row, table.threads == 1 ? "cpu_ms" : "wall_ms");
}

std::optional<double> speedup_of(const BenchReport& report, const BenchTable& table,
                                 const BenchRow& row) {
    if (table.threads == 1) return {};
    const std::optional<BenchSpread> many = spread_of(row, "wall_ms");
    for (const BenchTable& other : report.tables) {
        if (other.scene != table.scene || other.threads != 1) continue;
        const std::optional<BenchSpread> one = spread_of(other.rows[row.engine], "wall_ms");
        if (one && many && many->median > 0) return one->median / many->median;
    }
    return {};
}

std::optional<double> ratio_to(const BenchTable& table, const BenchRow& row) {
    if (&row == &table.rows.front()) return {};
    const std::optional<BenchSpread> ours = spread_of_time(table, table.rows.front());
    const std::optional<BenchSpread> theirs = spread_of_time(table, row);
    if (!ours || !theirs || !(theirs->median > 0)) return {};
    return ours->median / theirs->median;
}

std::optional<double> find_field(const BenchRow& row, const char* name) {
    for (auto run = row.runs.rbegin(); run != row.runs.rend(); ++run) {
        if (!run->problem.empty()) continue;
        const Json& value = run->fields.at(name);
        return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
    }
    return {};
}

std::string find_settings(const BenchRow& row) {
    for (const BenchRun& run : row.runs) {
        if (run.problem.empty()) return run.fields.at("settings").get<std::string>();
    }
    return {};
}

std::string describe_problem(const BenchRow& row) {
    const auto is_bad = [](const BenchRun& run) { return !run.problem.empty(); };
    const auto count = std::count_if(row.runs.begin(), row.runs.end(), is_bad);
    if (count == 0) return {};
    const std::string& first = std::find_if(row.runs.begin(), row.runs.end(), is_bad)->problem;
    if (count == static_cast<std::ptrdiff_t>(row.runs.size())) return first;
    return fmt::format("{} of {} runs: {}", count, row.runs.size(), first);
}

namespace {

enum class Better { Less, Neither };

using Figures = std::vector<std::optional<double>>;

std::optional<std::size_t> find_best(const Figures& figures) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < figures.size(); ++i) {
        if (figures[i] && (!best || *figures[i] < *figures[*best])) best = i;
    }
    if (!best || std::count(figures.begin(), figures.end(), figures[*best]) > 1) return {};
    const auto there = std::count_if(figures.begin(), figures.end(),
                                     [](const auto& figure) { return figure.has_value(); });
    return there > 1 ? best : std::nullopt;
}

BenchColumn make_column(const char* title, const Figures& figures, Better better,
                        std::string (*tell)(double)) {
    BenchColumn column{.title = title, .cells = {}, .best = {}};
    for (const std::optional<double>& figure : figures) {
        column.cells.push_back(figure ? tell(*figure) : std::string());
    }
    if (better == Better::Less) column.best = find_best(figures);
    return column;
}

Figures list_fields(const BenchTable& table, const char* name) {
    Figures figures;
    for (const BenchRow& row : table.rows) figures.push_back(find_field(row, name));
    return figures;
}

// MB beyond the empty world.
Figures list_peaks(const BenchTable& table) {
    Figures figures = list_fields(table, "peak_kib");
    const Figures empty = list_fields(table, "empty_kib");
    for (std::size_t i = 0; i < figures.size(); ++i) {
        if (figures[i] && empty[i]) figures[i] = std::max(0.0, *figures[i] - *empty[i]) * 1024e-6;
    }
    return figures;
}

// Microseconds a step, over the bodies that can move.
Figures list_times_a_body(const BenchTable& table) {
    Figures figures = list_fields(table, "moving");
    for (std::size_t i = 0; i < figures.size(); ++i) {
        const std::optional<BenchSpread> time = spread_of_time(table, table.rows[i]);
        if (figures[i] && time) figures[i] = 1000 * time->median / *figures[i];
    }
    return figures;
}

}  // namespace

std::vector<BenchColumn> make_columns(const BenchReport& report, const BenchTable& table) {
    std::vector<BenchColumn> columns;
    const auto add = [&](const char* title, const Figures& figures, Better better,
                         std::string (*tell)(double)) {
        const auto is_there = [](const auto& figure) { return figure.has_value(); };
        if (!std::any_of(figures.begin(), figures.end(), is_there)) return;
        columns.push_back(make_column(title, figures, better, tell));
    };
    const auto add_field = [&](const char* title, const char* name, Better better,
                               std::string (*tell)(double)) {
        add(title, list_fields(table, name), better, tell);
    };
    Figures speedups;
    for (const BenchRow& row : table.rows) speedups.push_back(speedup_of(report, table, row));
    add("over one thread", speedups, Better::Neither,
        [](double times) { return fmt::format("{:.2f} x", times); });
    add("\u00b5s a body", list_times_a_body(table), Better::Neither, say);
    add_field("first step, ms", "first_ms", Better::Less, say);
    add_field("mean penetration", "mean_penetration", Better::Less, say_length);
    add_field("deepest", "deepest_penetration", Better::Less, say_length);
    add_field("drift", "drift", Better::Less, say_length);
    add_field("sag before 3 s", "sag_before_3s", Better::Less, say_length);
    add_field("sag from 3 s on", "sag_from_3s", Better::Less, say_length);
    add_field("kinetic energy, J", "kinetic_energy", Better::Neither, say);
    add_field("lost", "lost", Better::Less, say_whole);
    add_field("awake", "awake", Better::Neither, say_whole);
    add("peak, MB", list_peaks(table), Better::Less, say);
    return columns;
}

std::vector<std::string> list_settings(const BenchReport& report) {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < report.engines.size(); ++i) {
        std::string settings;
        for (const BenchTable& table : report.tables) {
            for (const BenchRow& row : table.rows) {
                if (row.engine == i && settings.empty()) settings = find_settings(row);
            }
        }
        if (!settings.empty()) {
            lines.push_back(fmt::format("{}: {}", report.engines[i].label, settings));
        }
    }
    return lines;
}

void print_head(std::FILE* file, const BenchReport& report) {
    fmt::print(file, "# Cairn {} beside its peers\n\n", report.cairn_version);
    fmt::print(file, "{}, {}, {}, {}; compiler {}; {} by turns, each in a fresh process.\n",
               report.processor, say_count(static_cast<int>(report.cores), "core"), report.system,
               report.date, report.compiler, say_count(report.repeats, "round"));
    fmt::print(file,
               "Penetration is that of the last step, on the exact geometry, by one ruler for all; "
               "drift is how far\nthe worst of what should stand is from its place; lost is what "
               "fell under the ground. The first step, and\nwhat a scene needs to settle, are not "
               "in the time.\n");
}

void print_table(std::FILE* file, const BenchReport& report, const BenchTable& table) {
    fmt::print(file, "\n## {}, {}\n\n{}; {}.", table.scene, say_count(table.threads, "thread"),
               table.line, say_count(table.steps, "step"));
    if (!table.latencies_ns.empty()) {
        std::vector<double> sorted = table.latencies_ns;
        std::sort(sorted.begin(), sorted.end());
        fmt::print(file, " Core to core, one way: {:.0f} to {:.0f} ns over the rounds.",
                   sorted.front(), sorted.back());
    }
    const std::vector<BenchColumn> columns = make_columns(report, table);
    fmt::print(file, "\n\n| engine | {} ms a step: median (least to most) | Cairn / it |",
               say_clock(table));
    for (const BenchColumn& column : columns) fmt::print(file, " {} |", column.title);
    fmt::print(file, "\n|---|---|---|");
    for (std::size_t i = 0; i < columns.size(); ++i) fmt::print(file, "---|");
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const BenchRow& row = table.rows[i];
        const std::optional<BenchSpread> time = spread_of_time(table, row);
        const std::optional<double> ratio = ratio_to(table, row);
        std::string told = describe_problem(row);
        if (time) {
            told = fmt::format("{} ({} to {}){}{}", say(time->median), say(time->least),
                               say(time->most), told.empty() ? "" : "; ", told);
        }
        fmt::print(file, "\n| {} | {} | {} |", report.engines[row.engine].label, told,
                   ratio ? say(*ratio) : "");
        for (const BenchColumn& column : columns) fmt::print(file, " {} |", column.cells[i]);
    }
    fmt::print(file, "\n");
    std::fflush(file);
}

void print_memory(std::FILE* file, const BenchReport& report) {
    if (report.memory.empty()) return;
    const auto tell = [](std::optional<double> bytes) {
        return bytes ? fmt::format("{:.0f}", *bytes) : std::string();
    };
    fmt::print(file, "\n## Bytes a body\n\n| engine | static box | moving box |\n|---|---|---|\n");
    for (const BodyMemory& memory : report.memory) {
        fmt::print(file, "| {} | {} | {} |\n", report.engines[memory.engine].label,
                   tell(memory.static_bytes), tell(memory.moving_bytes));
    }
}

void print_settings(std::FILE* file, const BenchReport& report) {
    fmt::print(file, "\nSettings, each engine's default:\n\n");
    for (const std::string& line : list_settings(report)) fmt::print(file, "- {}\n", line);
}

std::string make_json(const BenchReport& report) {
    Json json;
    json["cairn"] = report.cairn_version;
    json["machine"] = {{"processor", report.processor},
                       {"cores", report.cores},
                       {"system", report.system},
                       {"compiler", report.compiler}};
    json["date"] = report.date;
    json["repeats"] = report.repeats;
    json["tables"] = Json::array();
    for (const BenchTable& table : report.tables) {
        Json rows = Json::array();
        for (const BenchRow& row : table.rows) {
            Json told = {{"engine", report.engines[row.engine].variant},
                         {"label", report.engines[row.engine].label},
                         {"settings", find_settings(row)}};
            if (const auto time = spread_of_time(table, row)) {
                told["ms"] = {{"median", time->median},
                              {"least", time->least},
                              {"most", time->most},
                              {"spread", (time->most - time->least) / time->median}};
            }
            if (const auto ratio = ratio_to(table, row)) told["cairn_over_this"] = *ratio;
            if (const auto speedup = speedup_of(report, table, row)) {
                told["over_one_thread"] = *speedup;
            }
            if (!describe_problem(row).empty()) told["problem"] = describe_problem(row);
            told["runs"] = Json::array();
            for (const BenchRun& run : row.runs) {
                told["runs"].push_back(run.problem.empty() ? run.fields
                                                           : Json{{"problem", run.problem}});
            }
            rows.push_back(std::move(told));
        }
        json["tables"].push_back({{"scene", table.scene},
                                  {"threads", table.threads},
                                  {"steps", table.steps},
                                  {"clock", say_clock(table)},
                                  {"core_latency_ns", table.latencies_ns},
                                  {"rows", std::move(rows)}});
    }
    json["memory"] = Json::array();
    for (const BodyMemory& memory : report.memory) {
        Json told = {{"engine", report.engines[memory.engine].variant}};
        if (memory.static_bytes) told["static_bytes"] = *memory.static_bytes;
        if (memory.moving_bytes) told["moving_bytes"] = *memory.moving_bytes;
        json["memory"].push_back(std::move(told));
    }
    // What a program printed when it failed need not be UTF-8.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace cairn::tool

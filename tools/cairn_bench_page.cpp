// The benchmark's page: one file without a script, a font or a network, light or dark as the
// reader's system is. Bars are inline SVG; their colours are classes, so that the page's style
// sheet decides.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cairn_bench_report.h"

namespace cairn::tool {

namespace {

constexpr const char* style_sheet = R"css(
:root { color-scheme: light dark;
  --page: #f6f5f1; --card: #ffffff; --ink: #1d2327; --soft: #626b72; --line: #e3e1d9;
  --cairn: #0f766e; --cairn2: #5eaaa2; --jolt: #c2703d; --box3d: #5b63b7; --bullet: #8a6d9e;
  --ode: #7d8a94; --good: #0f766e; --bad: #b3402a; }
@media (prefers-color-scheme: dark) { :root {
  --page: #14181b; --card: #1c2226; --ink: #e6e9ea; --soft: #98a3aa; --line: #2e363b;
  --cairn: #3cc9b8; --cairn2: #23837a; --jolt: #e0915f; --box3d: #8c94ea; --bullet: #b494ca;
  --ode: #8f9ca6; --good: #3cc9b8; --bad: #f08c74; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--ink);
  font: 16px/1.55 system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif;
  font-variant-numeric: tabular-nums; }
main { max-width: 1060px; margin: 0 auto; padding: 56px 24px 72px; }
h1 { font-size: 40px; line-height: 1.15; letter-spacing: -0.02em; margin: 0 0 10px; }
h2 { font-size: 21px; letter-spacing: -0.01em; margin: 0; }
p { margin: 6px 0; } .soft { color: var(--soft); }
.lead { max-width: 46em; }
.card { background: var(--card); border: 1px solid var(--line); border-radius: 14px;
  padding: 24px 28px 20px; margin-top: 28px; }
.card header { display: flex; flex-wrap: wrap; gap: 4px 14px; align-items: baseline; }
.card header span { color: var(--soft); font-size: 14px; }
svg { display: block; width: 100%; height: auto; margin: 14px 0 8px; overflow: visible; }
svg text { fill: var(--ink); font-size: 13.5px; } svg .soft { fill: var(--soft); }
svg .name { text-anchor: end; } svg .first { font-weight: 650; }
svg .grid { stroke: var(--line); } svg .one { stroke: var(--cairn); stroke-width: 1.5; }
svg .whisker { stroke: var(--ink); stroke-width: 1.2; opacity: 0.55; }
svg .bad { fill: var(--bad); }
.cairn { fill: var(--cairn); } .cairn2 { fill: var(--cairn2); } .jolt { fill: var(--jolt); }
.box3d { fill: var(--box3d); } .bullet { fill: var(--bullet); } .ode { fill: var(--ode); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: 13.5px; }
th { color: var(--soft); font-weight: 500; text-align: right; vertical-align: bottom;
  line-height: 1.25; padding: 8px 0 6px 16px; }
td { text-align: right; white-space: nowrap; padding: 6px 0 6px 16px;
  border-top: 1px solid var(--line); }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
table.narrow { width: auto; } table.narrow td + td { padding-left: 48px; }
tr.first td { font-weight: 650; } td.best { color: var(--good); }
.legend { display: flex; flex-wrap: wrap; gap: 4px 20px; font-size: 13.5px; margin-top: 10px; }
.legend svg { display: inline-block; width: 11px; height: 11px; margin: 0 7px 0 0; }
ul { padding-left: 1.1em; margin: 8px 0; font-size: 14.5px; }
@media (max-width: 640px) { main { padding: 32px 14px; } h1 { font-size: 30px; }
  .card { padding: 18px 16px; } .plot { min-width: 640px; } }
)css";

constexpr double width = 960;
constexpr double label_width = 190;
constexpr double row_height = 32;

std::string escape(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        if (c == '<') {
            safe += "&lt;";
        } else if (c == '&') {
            safe += "&amp;";
        } else if (c == '"') {
            safe += "&quot;";
        } else {
            safe += c;
        }
    }
    return safe;
}

std::string color_of(const BenchEngine& engine) {
    if (engine.variant == "cairn") return "cairn";
    return engine.variant.rfind("cairn", 0) == 0 ? "cairn2" : engine.variant;
}

std::string say_ms(double ms) {
    return fmt::format("{:.{}f}", ms,
                       ms >= 100   ? 0
                       : ms >= 10  ? 1
                       : ms >= 1   ? 2
                       : ms >= 0.1 ? 3
                                   : 4);
}

std::string say_times(double times) {
    return fmt::format("{:.{}f}", times, times >= 9.95 ? 0 : times >= 0.995 ? 1 : 2);
}

// 1, 2 or 5 times a power of ten, so that at most five steps reach the value.
double choose_grid(double most) {
    const double power = std::pow(10, std::floor(std::log10(most / 5)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (most / (factor * power) <= 5) return factor * power;
    }
    return 10 * power;
}

std::string draw_bars(const BenchReport& report, const BenchTable& table) {
    double most = 0;
    for (const BenchRow& row : table.rows) {
        if (const auto time = spread_of_time(table, row)) most = std::max(most, time->most);
    }
    if (!(most > 0)) most = 1;
    // Room at the right for the figures behind the longest bar.
    const double scale = (width - label_width - 170) / most;
    const double bottom = row_height * static_cast<double>(table.rows.size());
    std::string svg =
        fmt::format(R"(<div class="scroll"><svg class="plot" viewBox="0 0 {} {}" role="img" )"
                    R"(aria-label="Milliseconds a step">)",
                    width, bottom + 26);
    const double grid = choose_grid(most);
    for (int i = 0; i * grid <= most * 1.001; ++i) {
        const double x = label_width + i * grid * scale;
        svg += fmt::format(
            R"(<line class="grid" x1="{0:.1f}" x2="{0:.1f}" y1="0" y2="{1}"/>)"
            R"(<text class="soft" x="{0:.1f}" y="{2}" text-anchor="middle">{3:g}{4}</text>)",
            x, bottom + 4, bottom + 20, i * grid, i == 0 ? " ms" : "");
    }
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const BenchRow& row = table.rows[i];
        const BenchEngine& engine = report.engines[row.engine];
        const double middle = row_height * (static_cast<double>(i) + 0.5);
        svg += fmt::format(R"(<text class="name{}" x="{}" y="{:.1f}">{}</text>)",
                           i == 0 ? " first" : "", label_width - 14, middle + 4.5,
                           escape(engine.label));
        const auto time = spread_of_time(table, row);
        if (!time) {
            svg += fmt::format(R"(<text class="bad" x="{}" y="{:.1f}">{}</text>)", label_width + 8,
                               middle + 4.5, escape(describe_problem(row)));
            continue;
        }
        svg += fmt::format(
            R"(<rect class="{}" x="{}" y="{:.1f}" width="{:.1f}" height="20" rx="3"/>)",
            color_of(engine), label_width, middle - 10, std::max(1.5, time->median * scale));
        svg += fmt::format(
            R"(<line class="whisker" x1="{:.1f}" x2="{:.1f}" y1="{:.1f}" y2="{:.1f}"/>)",
            label_width + time->least * scale, label_width + time->most * scale, middle, middle);
        const auto ratio = ratio_to(table, row);
        const std::string beside =
            !ratio ? ""
                   : fmt::format(R"( <tspan class="soft">{} &#215; Cairn</tspan>)",
                                 say_times(1 / *ratio));
        svg += fmt::format(R"(<text x="{:.1f}" y="{:.1f}"{}>{}{}</text>)",
                           label_width + time->most * scale + 10, middle + 4.5,
                           i == 0 ? R"( class="first")" : "", say_ms(time->median), beside);
    }
    return svg + "</svg></div>";
}

// Of the engines that ran; the best of a column, where less is better, stands out.
std::string draw_figures(const BenchReport& report, const BenchTable& table) {
    const std::vector<BenchColumn> columns = make_columns(report, table);
    std::string html = R"(<div class="scroll"><table><tr><th></th>)";
    for (const BenchColumn& column : columns) {
        html += "<th>" + escape(column.title) + "</th>";
    }
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        if (!spread_of_time(table, table.rows[i])) continue;
        html += fmt::format("</tr><tr{}><td>{}</td>", i == 0 ? R"( class="first")" : "",
                            escape(report.engines[table.rows[i].engine].label));
        for (const BenchColumn& column : columns) {
            html += column.best == i ? R"(<td class="best">)" : "<td>";
            html += escape(column.cells[i]) + "</td>";
        }
    }
    return html + "</tr></table></div>";
}

std::string draw_table(const BenchReport& report, const BenchTable& table) {
    std::string latency;
    if (!table.latencies_ns.empty()) {
        const auto [least, most] =
            std::minmax_element(table.latencies_ns.begin(), table.latencies_ns.end());
        latency = fmt::format(", core to core {:.0f} to {:.0f} ns", *least, *most);
    }
    return fmt::format(
               R"(<section class="card"><header><h2>{}</h2><span>{}</span><span>{} thread{}, {} )"
               R"(steps, ms a step of {} time{}</span></header>)",
               escape(table.scene), escape(table.line), table.threads,
               table.threads == 1 ? "" : "s", table.steps,
               table.threads == 1 ? "processor" : "wall", latency) +
           draw_bars(report, table) + draw_figures(report, table) + "</section>\n";
}

// Every scene a line, every peer a mark at its time over Cairn's, on a scale of factors.
std::string draw_overview(const BenchReport& report) {
    double least = 0.5;
    double most = 2;
    std::vector<const BenchTable*> tables;  // those with something to compare
    for (const BenchTable& table : report.tables) {
        for (const BenchRow& row : table.rows) {
            const auto ratio = ratio_to(table, row);
            if (!ratio) continue;
            least = std::min(least, 0.9 / *ratio);
            most = std::max(most, 1.1 / *ratio);
            if (tables.empty() || tables.back() != &table) tables.push_back(&table);
        }
    }
    if (tables.empty()) return {};
    const double scale = (width - label_width - 40) / std::log(most / least);
    const auto x_of = [&](double factor) { return label_width + std::log(factor / least) * scale; };
    const double bottom = 26 * static_cast<double>(tables.size());
    std::string svg =
        fmt::format(R"(<div class="scroll"><svg class="plot" viewBox="0 0 {} {}" role="img" )"
                    R"(aria-label="Time over Cairn's">)",
                    width, bottom + 26);
    for (const double factor :
         {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0}) {
        if (factor < least || factor > most) continue;
        svg += fmt::format(
            R"(<line class="{3}" x1="{0:.1f}" x2="{0:.1f}" y1="0" y2="{1}"/>)"
            R"(<text class="soft" x="{0:.1f}" y="{2}" text-anchor="middle">{4:g}&#215;</text>)",
            x_of(factor), bottom + 4, bottom + 20, factor == 1.0 ? "one" : "grid", factor);
    }
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const BenchTable& table = *tables[i];
        const double y = 26 * (static_cast<double>(i) + 0.5);
        svg += fmt::format(R"(<text class="name" x="{}" y="{:.1f}">{}{}</text>)", label_width - 14,
                           y + 4.5, escape(table.scene),
                           table.threads == 1 ? "" : fmt::format(" &#215;{}", table.threads));
        for (const BenchRow& row : table.rows) {
            const auto ratio = ratio_to(table, row);
            if (!ratio) continue;
            const BenchEngine& engine = report.engines[row.engine];
            svg += fmt::format(
                R"(<circle class="{}" cx="{:.1f}" cy="{:.1f}" r="6"><title>{}: {} times</title>)"
                R"(</circle>)",
                color_of(engine), x_of(1 / *ratio), y, escape(engine.label), say_times(1 / *ratio));
        }
    }
    svg += R"(</svg></div><div class="legend">)";
    for (std::size_t i = 1; i < report.engines.size(); ++i) {
        svg += fmt::format(
            R"(<span><svg viewBox="0 0 12 12"><circle class="{}" cx="6" cy="6" r="6"/></svg>{}</span>)",
            color_of(report.engines[i]), escape(report.engines[i].label));
    }
    return R"(<section class="card"><header><h2>Time over Cairn's</h2><span>right of the line: )"
           R"(slower than Cairn</span></header>)" +
           svg + "</div></section>\n";
}

std::string draw_memory(const BenchReport& report) {
    if (report.memory.empty()) return {};
    const auto tell = [](std::optional<double> bytes) {
        return bytes ? fmt::format("{:.0f}", *bytes) : std::string();
    };
    std::string html =
        R"(<section class="card"><header><h2>Bytes a body</h2><span>what 100,000 static and )"
        R"(10,000 moving boxes add to the program</span></header><div class="scroll"><table class="narrow">)"
        R"(<tr><th></th><th>static box</th><th>moving box</th></tr>)";
    for (const BodyMemory& memory : report.memory) {
        html += fmt::format("<tr{}><td>{}</td><td>{}</td><td>{}</td></tr>",
                            memory.engine == 0 ? R"( class="first")" : "",
                            escape(report.engines[memory.engine].label), tell(memory.static_bytes),
                            tell(memory.moving_bytes));
    }
    return html + "</table></div></section>\n";
}

}  // namespace

std::string make_page(const BenchReport& report) {
    std::string html = fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
        "<link rel=\"icon\" href=\"data:,\"><title>Cairn {} beside its peers</title><style>",
        escape(report.cairn_version));
    html += style_sheet;
    html += fmt::format(
        "</style></head><body><main><h1>Cairn {} beside its peers</h1>"
        "<p class=\"lead\">The same scenes in every engine that was there, each at its default "
        "settings, by turns and each run in a fresh process. A bar is the median of {} run{}, its "
        "line reaches from the least to the most.</p>"
        "<p class=\"soft\">{}, {} cores, {}, compiler {}, {}</p>\n",
        escape(report.cairn_version), report.repeats, report.repeats == 1 ? "" : "s",
        escape(report.processor), report.cores, escape(report.system), escape(report.compiler),
        report.date);
    html += draw_overview(report);
    for (const BenchTable& table : report.tables) html += draw_table(report, table);
    html += draw_memory(report);
    html +=
        R"(<section class="card"><header><h2>Settings, each engine's default</h2></header><ul>)";
    for (const std::string& line : list_settings(report)) html += "<li>" + escape(line) + "</li>";
    html +=
        "</ul><p class=\"soft\">Penetration is that of the last step, measured on the exact "
        "geometry "
        "by one ruler for every engine: the shortest way that would part two shapes, its mean over "
        "the pairs that overlap. Drift is how far the worst of what should stand is from its "
        "place; "
        "sag, how far a tower's top was below it; lost, what fell under the ground. The first step "
        "and what a scene needs to settle are not in the time.</p></section>\n";
    return html + "</main></body></html>\n";
}

}  // namespace cairn::tool

// `cairn bench`: which scenes and which engines, then A B A B ..., and the report.
//
// Every engine has a program of its own, cairn_bench_ENGINE beside this one, that runs one scene
// and prints a line of JSON. This file knows their names and asks them for all else.

#include "cairn_bench.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "cairn/version.h"
#include "cairn_bench_machine.h"
#include "cairn_bench_process.h"
#include "cairn_bench_report.h"
#include "cairn_terminal.h"

namespace cairn::tool {

namespace {

using Json = nlohmann::ordered_json;

// Cairn's own first: the others are measured against it.
constexpr const char* engine_names[] = {"cairn", "jolt", "box3d", "bullet", "ode"};

struct BenchSceneInfo {
    std::string name, line;
    int steps = 0;
    bool is_memory_probe = false;
};

struct BenchPlan {
    std::vector<BenchSceneInfo> scenes;
    std::vector<BenchSceneInfo> probes;
    std::vector<int> threads;
};

Error refuse(std::string message) { return {ErrorCode::OutOfRange, std::move(message)}; }

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> words;
    std::stringstream stream(text);
    for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
    return words;
}

std::string find_program(const std::string& engine) {
    std::error_code ignored;
    const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
    const std::filesystem::path program = self.parent_path() / ("cairn_bench_" + engine);
    return access(program.c_str(), X_OK) == 0 ? program.string() : std::string();
}

// Every variant of every engine that is there. What a program says of itself is ours, so a program
// that cannot even do that is broken, and named.
Result<std::vector<BenchEngine>> list_engines() {
    std::vector<BenchEngine> engines;
    for (const char* name : engine_names) {
        const std::string program = find_program(name);
        if (program.empty()) continue;
        const ProcessOutcome outcome = run_process(program, {"--describe"}, 10);
        const Json told = Json::parse(outcome.out, nullptr, false);
        if (!outcome.problem.empty() || !told.is_object()) {
            return refuse(fmt::format("{}: cannot describe itself: {}", program, outcome.problem));
        }
        const std::string label =
            told.at("name").get<std::string>() + " " + told.at("version").get<std::string>();
        for (const Json& variant : told.at("variants")) {
            const auto full = variant.get<std::string>();
            const std::size_t colon = full.find(':');
            engines.push_back(
                {full, colon == full.npos ? label : label + " " + full.substr(colon + 1), program});
        }
    }
    if (engines.empty() || engines.front().variant != "cairn") {
        return refuse(
            "bench: found no cairn_bench_cairn beside this program; build it with "
            "-DCAIRN_BENCH=ON");
    }
    return engines;
}

std::string join_variants(const std::vector<BenchEngine>& engines) {
    std::string joined;
    for (const BenchEngine& engine : engines) {
        if (engine.variant != "cairn") joined += (joined.empty() ? "" : ", ") + engine.variant;
    }
    return joined;
}

// Cairn at its defaults, and the peers that were asked for.
Result<std::vector<BenchEngine>> choose_engines(const std::string& peers) {
    Result<std::vector<BenchEngine>> listed = list_engines();
    if (!listed) return listed.error();
    const std::vector<BenchEngine>& there = *listed;
    std::vector<BenchEngine> chosen = {there.front()};
    if (peers == "none") return chosen;
    for (const BenchEngine& engine : there) {
        const bool is_peer = engine.variant.rfind("cairn", 0) != 0;
        if (peers == "all" && is_peer) chosen.push_back(engine);
    }
    if (peers == "all") return chosen;
    const std::vector<std::string> wanted = split(peers);
    if (wanted.empty()) return refuse("--peers: found nothing; allowed: all, none, or names");
    for (const std::string& name : wanted) {
        const auto match = [&](const BenchEngine& engine) { return engine.variant == name; };
        if (std::any_of(chosen.begin(), chosen.end(), match)) continue;
        const auto found = std::find_if(there.begin(), there.end(), match);
        if (found != there.end()) {
            chosen.push_back(*found);
            continue;
        }
        const auto end = std::end(engine_names);
        const bool is_known = std::find(std::begin(engine_names), end, name) != end;
        return refuse(fmt::format(
            "--peers: found \"{}\"{}; allowed: all, none, or some of {}", name,
            is_known ? ", which was not installed when this was built" : "", join_variants(there)));
    }
    return chosen;
}

Result<std::vector<BenchSceneInfo>> list_scenes(const std::string& program) {
    const ProcessOutcome outcome = run_process(program, {"--scenes"}, 10);
    std::vector<BenchSceneInfo> scenes;
    std::stringstream stream(outcome.out);
    for (std::string line; std::getline(stream, line);) {
        const Json told = Json::parse(line, nullptr, false);
        if (!told.is_object()) continue;
        scenes.push_back({told.at("name").get<std::string>(), told.at("line").get<std::string>(),
                          told.at("steps").get<int>(), told.at("is_memory_probe").get<bool>()});
    }
    if (!outcome.problem.empty() || scenes.empty()) {
        return refuse(fmt::format("{}: cannot list its scenes: {}", program, outcome.problem));
    }
    return scenes;
}

Result<BenchPlan> plan_scenes(const BenchCommand& command, const std::string& program) {
    const Result<std::vector<BenchSceneInfo>> listed = list_scenes(program);
    if (!listed) return listed.error();
    BenchPlan plan;
    std::string names;
    for (const BenchSceneInfo& scene : *listed) {
        names += (names.empty() ? "" : ", ") + scene.name;
        if (scene.is_memory_probe) plan.probes.push_back(scene);
        if (command.scenes.empty() && !scene.is_memory_probe) plan.scenes.push_back(scene);
    }
    for (const std::string& name : command.scenes) {
        const auto found =
            std::find_if(listed->begin(), listed->end(),
                         [&](const BenchSceneInfo& scene) { return scene.name == name; });
        if (found == listed->end()) {
            return refuse(fmt::format("bench: found the scene \"{}\"; allowed: {}", name, names));
        }
        plan.scenes.push_back(*found);
    }
    if (!command.scenes.empty() && !command.memory) plan.probes.clear();
    for (BenchSceneInfo& scene : plan.scenes) {
        if (command.steps) scene.steps = *command.steps;
    }
    return plan;
}

Result<std::vector<int>> read_threads(const std::string& text) {
    std::vector<int> threads;
    for (const std::string& word : split(text)) {
        int count = 0;
        const char* const end = word.data() + word.size();
        const auto read = std::from_chars(word.data(), end, count);
        if (read.ec != std::errc() || read.ptr != end || count < 1 || count > 1024) {
            return refuse(fmt::format(
                "--threads: found \"{}\"; allowed: counts from 1 to 1024 with commas", text));
        }
        threads.push_back(count);
    }
    if (threads.empty()) return refuse("--threads: found nothing; allowed: counts such as 1,2");
    return threads;
}

Status check_counts(const BenchCommand& command) {
    const auto check = [](const char* flag, int found, int least, int most) -> Status {
        if (found >= least && found <= most) return Done{};
        return refuse(fmt::format("{}: found {}; allowed: {} to {}", flag, found, least, most));
    };
    if (Status status = check("--repeats", command.repeats, 1, 1000); !status) return status;
    if (Status status = check("--time-limit", command.time_limit, 1, 86'400); !status) {
        return status;
    }
    return check("--steps", command.steps.value_or(2), 2, 1'000'000);
}

// Before minutes of running, not after them.
Status check_target(const char* flag, const std::string& path) {
    namespace fs = std::filesystem;
    if (path.empty() || path == "-") return Done{};
    std::error_code ignored;
    const fs::path folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : ".";
    const bool can_write = access(folder.c_str(), W_OK) == 0 && !fs::is_directory(path, ignored);
    if (can_write) return Done{};
    return refuse(
        fmt::format("{}: cannot write {}; allowed: a file in a folder that is there", flag, path));
}

BenchRun run_once(const BenchEngine& engine, const BenchSceneInfo& scene, int threads,
                  int time_limit) {
    const ProcessOutcome outcome = run_process(
        engine.program,
        {scene.name, engine.variant, std::to_string(threads), std::to_string(scene.steps)},
        time_limit);
    if (!outcome.problem.empty()) return {{}, outcome.problem};
    // An engine may print lines of its own before the worker's.
    std::string last;
    std::stringstream stream(outcome.out);
    for (std::string line; std::getline(stream, line);) {
        if (!line.empty()) last = line;
    }
    Json fields = Json::parse(last, nullptr, false);
    if (!fields.is_object()) return {{}, "ended without its line of figures"};
    return {std::move(fields), {}};
}

// A line on standard error, where that is a terminal, that says what runs now.
void show_progress(const std::string& text) {
    if (isatty(STDERR_FILENO) == 1)
        fmt::print(stderr, "\r{:<78}{}", text, text.empty() ? "\r" : "");
}

BenchTable run_table(const BenchCommand& command, const std::vector<BenchEngine>& engines,
                     const BenchSceneInfo& scene, int threads) {
    BenchTable table{.scene = scene.name,
                     .line = scene.line,
                     .threads = threads,
                     .steps = scene.steps,
                     .latencies_ns = {},
                     .rows = std::vector<BenchRow>(engines.size())};
    for (int round = 0; round < command.repeats; ++round) {
        if (threads > 1) {
            if (const auto latency = measure_core_latency()) table.latencies_ns.push_back(*latency);
        }
        for (std::size_t i = 0; i < engines.size(); ++i) {
            show_progress(fmt::format("{}, threads {}, round {} of {}: {}", scene.name, threads,
                                      round + 1, command.repeats, engines[i].label));
            table.rows[i].engine = i;
            // What an engine cannot do it cannot do twice.
            std::vector<BenchRun>& runs = table.rows[i].runs;
            if (round > 0 && !runs.back().problem.empty()) continue;
            runs.push_back(run_once(engines[i], scene, threads, command.time_limit));
        }
    }
    show_progress("");
    return table;
}

std::vector<BodyMemory> run_probes(const BenchCommand& command, const BenchPlan& plan,
                                   const std::vector<BenchEngine>& engines) {
    std::vector<BodyMemory> memory;
    if (plan.probes.empty()) return memory;
    for (std::size_t i = 0; i < engines.size(); ++i) {
        BodyMemory told{.engine = i, .static_bytes = {}, .moving_bytes = {}};
        for (const BenchSceneInfo& probe : plan.probes) {
            show_progress(fmt::format("{}: {}", probe.name, engines[i].label));
            const BenchRow row{i, {run_once(engines[i], probe, 1, command.time_limit)}};
            const std::optional<double> empty = find_field(row, "empty_kib");
            const std::optional<double> built = find_field(row, "built_kib");
            const std::optional<double> bodies = find_field(row, "bodies");
            if (!empty || !built || !bodies) continue;
            const bool is_moving = find_field(row, "moving") > 0;
            (is_moving ? told.moving_bytes : told.static_bytes) =
                (*built - *empty) * 1024 / *bodies;
        }
        memory.push_back(told);
    }
    show_progress("");
    return memory;
}

int write_file(const std::string& path, const std::string& text, const char* flag) {
    if (path.empty()) return done;
    if (path == "-") {
        fmt::print("{}", text);
        return std::fflush(stdout) == 0 ? done : fail(went_wrong, "standard output is closed");
    }
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    return file ? done : fail(went_wrong, fmt::format("{}: {} cannot be written", flag, path));
}

}  // namespace

int bench(const BenchCommand& command) {
    if (const Status status = check_counts(command); !status) {
        return fail(bad_usage, status.error().message);
    }
    for (const Status& status :
         {check_target("--json", command.json), check_target("--html", command.html)}) {
        if (!status) return fail(bad_usage, status.error().message);
    }
    const Result<std::vector<int>> threads = read_threads(command.threads);
    if (!threads) return fail(bad_usage, threads.error().message);
    const Result<std::vector<BenchEngine>> engines = choose_engines(command.peers);
    if (!engines) return fail(bad_usage, engines.error().message);
    const Result<BenchPlan> plan = plan_scenes(command, engines->front().program);
    if (!plan) return fail(bad_usage, plan.error().message);

    BenchReport report{.cairn_version = version(),
                       .processor = name_processor(),
                       .system = name_system(),
                       .compiler = __VERSION__,
                       .cores = count_cores(),
                       .date = name_today(),
                       .repeats = command.repeats,
                       .engines = *engines,
                       .tables = {},
                       .memory = {}};
    std::FILE* const out = command.json == "-" ? stderr : stdout;
    print_head(out, report);
    bool has_failed = false;
    for (const BenchSceneInfo& scene : plan->scenes) {
        for (const int count : *threads) {
            report.tables.push_back(run_table(command, *engines, scene, count));
            print_table(out, report, report.tables.back());
            has_failed = has_failed ||
                         !spread_of_time(report.tables.back(), report.tables.back().rows.front());
        }
    }
    report.memory = run_probes(command, *plan, *engines);
    print_memory(out, report);
    print_settings(out, report);
    const int json = write_file(command.json, make_json(report), "--json");
    const int html = write_file(command.html, make_page(report), "--html");
    if (json != done || html != done) return went_wrong;
    // A peer's failure is a row of the table; Cairn's own is ours to answer for.
    return has_failed ? went_wrong : done;
}

}  // namespace cairn::tool

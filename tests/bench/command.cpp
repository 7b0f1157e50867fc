// `cairn bench` from outside: the fields of its figures, what it refuses, and what becomes of a run
// that goes wrong.

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

using Json = nlohmann::ordered_json;

struct Outcome {
    int status = -1;
    std::string out, err;
};

std::string read_all(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// A folder of this test's own, gone when it ends.
class Scratch {
public:
    Scratch() {
        std::string name = (std::filesystem::temp_directory_path() / "cairn_bench_XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~Scratch() { std::filesystem::remove_all(path_); }
    std::string file(const std::string& name) const { return path_ + "/" + name; }

private:
    std::string path_;
};

Outcome call(const Scratch& scratch, const std::string& command, const std::string& arguments) {
    const std::string line = command + " bench " + arguments + " </dev/null >" +
                             scratch.file("out") + " 2>" + scratch.file("err");
    const int code = std::system(line.c_str());
    return {WIFEXITED(code) ? WEXITSTATUS(code) : -1, read_all(scratch.file("out")),
            read_all(scratch.file("err"))};
}

std::vector<std::string> list_keys(const Json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    return keys;
}

using Keys = std::vector<std::string>;

void check_refused(const std::string& arguments, const std::string& words) {
    CAPTURE(arguments);
    const Scratch scratch;
    const Outcome outcome = call(scratch, CAIRN_COMMAND, arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(outcome.err.find(words) != std::string::npos);
}

// A copy of the command beside a Jolt of our own making: it describes itself, and does `then` when
// told to run.
void install_false_jolt(const Scratch& scratch, const std::string& then) {
    namespace fs = std::filesystem;
    const fs::path command = CAIRN_COMMAND;
    fs::copy_file(command, scratch.file("cairn"));
    fs::copy_file(command.parent_path() / "cairn_bench_cairn", scratch.file("cairn_bench_cairn"));
    std::ofstream(scratch.file("cairn_bench_jolt"))
        << "#!/bin/sh\n"
           "if [ \"$1\" = --describe ]; then\n"
           "  echo '{\"name\":\"Jolt\",\"version\":\"0\",\"variants\":[\"jolt\"]}'\n"
           "  exit\n"
           "fi\n"
        << then << "\n";
    chmod(scratch.file("cairn_bench_jolt").c_str(), 0700);
}

// What the row of the false Jolt says, in a run that else goes well.
std::string problem_of_false_jolt(const std::string& then, const std::string& options = "") {
    const Scratch scratch;
    install_false_jolt(scratch, then);
    const Outcome outcome = call(scratch, scratch.file("cairn"),
                                 "pyramid20 --steps 2 --repeats 1 --peers all --json - " + options);
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);
    const Json rows = Json::parse(outcome.out)["tables"][0]["rows"];
    REQUIRE(rows.size() == 2);
    CHECK(!rows[0].contains("problem"));
    CHECK(!rows[1].contains("ms"));
    return rows[1].value("problem", "");
}

}  // namespace

TEST_CASE("five steps of the pyramid give every figure of a benchmark") {
    const Scratch scratch;
    const Outcome outcome = call(scratch, CAIRN_COMMAND,
                                 "pyramid20 --repeats 1 --steps 5 --peers none --json " +
                                     scratch.file("json") + " --html " + scratch.file("html"));
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.err.empty());
    CHECK(outcome.out.find("| Cairn ") != std::string::npos);

    const Json json = Json::parse(read_all(scratch.file("json")));
    CHECK(list_keys(json) == Keys{"cairn", "machine", "date", "repeats", "tables", "memory"});
    CHECK(json["repeats"] == 1);
    REQUIRE(json["tables"].size() == 1);
    const Json& table = json["tables"][0];
    CHECK(list_keys(table) ==
          Keys{"scene", "threads", "steps", "clock", "core_latency_ns", "rows"});
    CHECK(table["scene"] == "pyramid20");
    CHECK(table["steps"] == 5);
    REQUIRE(table["rows"].size() == 1);
    const Json& row = table["rows"][0];
    CHECK(list_keys(row) == Keys{"engine", "label", "settings", "ms", "runs"});
    CHECK(row["engine"] == "cairn");
    CHECK(row["ms"]["median"].get<double>() > 0);
    REQUIRE(row["runs"].size() == 1);
    const Json& run = row["runs"][0];
    CHECK(list_keys(run) == Keys{"settings",
                                 "bodies",
                                 "moving",
                                 "counted_steps",
                                 "first_ms",
                                 "wall_ms",
                                 "cpu_ms",
                                 "worst_ms",
                                 "empty_kib",
                                 "built_kib",
                                 "peak_kib",
                                 "deepest_penetration",
                                 "mean_penetration",
                                 "overlapping_pairs",
                                 "drift",
                                 "sag_before_3s",
                                 "sag_from_3s",
                                 "kinetic_energy",
                                 "lost",
                                 "awake"});
    CHECK(run["bodies"] == 211);
    CHECK(run["moving"] == 210);
    CHECK(run["counted_steps"] == 4);
    CHECK(run["lost"] == 0);
    CHECK(run["drift"].get<double>() < 0.01);
    CHECK(run["sag_from_3s"].is_null());

    const std::string page = read_all(scratch.file("html"));
    CHECK(page.find("<svg") != std::string::npos);
    CHECK(page.find("http") == std::string::npos);
}

TEST_CASE("bad usage of the benchmark says what was found and what exists") {
    check_refused("pyramid21", "found the scene \"pyramid21\"; allowed: pyramid20, pyramid40");
    check_refused("pyramid20 --peers havok", "found \"havok\"; allowed: all, none, or some of");
    check_refused("pyramid20 --peers none --repeats 0", "--repeats: found 0; allowed: 1 to 1000");
    check_refused("pyramid20 --peers none --steps 1", "--steps: found 1; allowed: 2 to");
    check_refused("pyramid20 --peers none --threads 1,,2", "--threads: found \"1,,2\"");
    check_refused("pyramid20 --peers none --time-limit 0", "--time-limit: found 0");
    check_refused("pyramid20 --peers none --json /no/such/figures",
                  "cannot write /no/such/figures");
    check_refused("pyramid20 --peers none --html /", "cannot write /;");
}

TEST_CASE("a peer that crashes, hangs or talks nonsense is a row that says so") {
    CHECK(problem_of_false_jolt("kill -SEGV $$").find("ended by signal 11") == 0);
    CHECK(problem_of_false_jolt("echo out of luck >&2; exit 1") == "out of luck");
    CHECK(problem_of_false_jolt("echo hello") == "ended without its line of figures");
    CHECK(problem_of_false_jolt("exec sleep 60", "--time-limit 1") == "not done after 1 s");
}

TEST_CASE("a library's solvers can be compared with each other") {
    const Scratch scratch;
    const Outcome outcome =
        call(scratch, CAIRN_COMMAND, "seesaw --repeats 2 --steps 4 --peers cairn:xpbd --json -");
    REQUIRE(outcome.status == 0);
    const Json rows = Json::parse(outcome.out)["tables"][0]["rows"];
    REQUIRE(rows.size() == 2);
    CHECK(rows[1]["engine"] == "cairn:xpbd");
    CHECK(rows[1]["runs"].size() == 2);
    CHECK(rows[1]["cairn_over_this"].get<double>() > 0);
}

TEST_CASE("medians, spreads and the gain of a thread are those of the runs") {
    // A Jolt whose runs of one thread take 1, 5 and 3 ms of processor time a step, and 8 ms of wall
    // time over its threads.
    const Scratch scratch;
    install_false_jolt(scratch,
                       "runs=$(dirname \"$0\")/runs; echo . >>\"$runs\"\n"
                       "case $(wc -l <\"$runs\") in 1) cpu=1 ;; 2) cpu=5 ;; *) cpu=3 ;; esac\n"
                       "echo an engine may talk\n"
                       "printf '{\"settings\":\"s\",\"bodies\":3,\"moving\":2,' \n"
                       "printf '\"cpu_ms\":%s,\"wall_ms\":%s,' $cpu $((8 / $3))\n"
                       "printf '\"first_ms\":9,\"empty_kib\":10,\"peak_kib\":20,'\n"
                       "printf '\"deepest_penetration\":0.5,\"mean_penetration\":0.25,'\n"
                       "printf '\"drift\":null,\"sag_before_3s\":null,\"sag_from_3s\":null,'\n"
                       "printf '\"kinetic_energy\":1,\"lost\":0,\"awake\":null}\\n'");
    const Outcome outcome =
        call(scratch, scratch.file("cairn"),
             "seesaw --steps 4 --repeats 3 --threads 1,2 --json " + scratch.file("json"));
    CAPTURE(outcome.out);
    const Json tables = Json::parse(read_all(scratch.file("json")))["tables"];
    REQUIRE(tables.size() == 2);
    const Json& ours = tables[0]["rows"][0];
    const Json& one = tables[0]["rows"][1];
    const Json& two = tables[1]["rows"][1];
    CHECK(one["ms"]["median"] == 3);
    CHECK(one["ms"]["least"] == 1);
    CHECK(one["ms"]["most"] == 5);
    CHECK(one["ms"]["spread"].get<double>() == doctest::Approx(4.0 / 3));
    CHECK(one["cairn_over_this"].get<double>() ==
          doctest::Approx(ours["ms"]["median"].get<double>() / 3));
    CHECK(!one.contains("over_one_thread"));
    CHECK(two["ms"]["median"] == 4);
    CHECK(two["over_one_thread"] == 2);
    CHECK(outcome.out.find("| 250 mm | 500 mm |") != std::string::npos);
}

// The command line from outside: exit statuses, what goes to which stream, the result file to the
// letter.

#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/command.h"

using namespace cairn::test;

namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> list_keys(const Json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.push_back(key);
    return keys;
}

using Keys = std::vector<std::string>;

// One line on standard error that holds the words, nothing on standard output, status 2.
void check_refused(const std::string& arguments, const std::string& words,
                   const std::string& input = "") {
    CAPTURE(arguments);
    const Outcome outcome = call(arguments, input);
    CAPTURE(outcome.err);
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(outcome.err.find(words) != std::string::npos);
}

}  // namespace

TEST_CASE("a result has the format's fields in the format's order") {
    const Outcome outcome = call("run drop --steps 120 --sample-every 40 --json - --quiet");
    REQUIRE(outcome.status == 0);
    CHECK(outcome.err.empty());
    const Json result = Json::parse(outcome.out);
    CHECK(list_keys(result) == Keys{"cairn", "scene", "step", "threads", "steps", "time", "bodies",
                                    "joints", "contacts", "energy", "momentum", "max_penetration",
                                    "mean_penetration", "non_finite", "state_hash", "step_ms",
                                    "stage_ms", "samples"});
    CHECK(result["scene"] == "Drop");
    CHECK(list_keys(result["step"]) ==
          Keys{"dt", "solver", "substeps", "iterations", "narrow_phase", "broad_phase"});
    CHECK(result["step"]["dt"] == 1.0 / 60);
    CHECK(result["step"]["substeps"] == 4);
    CHECK(result["step"]["iterations"] == 1);
    CHECK(result["threads"] == 1);
    CHECK(result["steps"] == 120);
    CHECK(result["time"] == 120 * (1.0 / 60));
    REQUIRE(result["bodies"].size() == 4);
    CHECK(list_keys(result["bodies"][1]) == Keys{"name", "position", "rotation", "linear_velocity",
                                                 "angular_velocity", "asleep", "mass",
                                                 "center_of_mass", "inertia"});
    CHECK(result["bodies"][0]["name"] == "ground");
    CHECK(result["bodies"][0]["mass"] == 0);
    CHECK(result["bodies"][1]["mass"] == 1000);
    REQUIRE(result["contacts"].size() > 0);
    const Json& contact = result["contacts"][0];
    CHECK(list_keys(contact) == Keys{"bodies", "shapes", "normal", "points", "friction_impulse",
                                     "spinning_impulse", "rolling_impulse"});
    CHECK(list_keys(contact["points"][0]) == Keys{"position", "separation", "normal_impulse"});
    CHECK(list_keys(result["energy"]) == Keys{"kinetic", "potential", "total"});
    CHECK(list_keys(result["momentum"]) == Keys{"linear", "angular"});
    CHECK(result["state_hash"].get<std::string>().size() == 16);
    CHECK(list_keys(result["step_ms"]) == Keys{"first", "mean", "p50", "p95", "max"});
    REQUIRE(result["samples"].size() == 4);
    CHECK(list_keys(result["samples"][0]) ==
          Keys{"time", "bodies", "energy", "momentum", "max_penetration", "contact_count"});
    CHECK(result["samples"][0]["time"] == 0);
    CHECK(result["samples"][3]["time"] == result["time"]);
    CHECK(result["samples"][3]["bodies"][2]["position"] == result["bodies"][2]["position"]);
    CHECK(result["samples"][3]["contact_count"] == result["contacts"].size());
}

TEST_CASE("no steps report the initial state, its contacts included") {
    const Outcome outcome = call("run tower --set height=2 --steps 0 --json - --quiet");
    REQUIRE(outcome.status == 0);
    const Json result = Json::parse(outcome.out);
    CHECK(result["steps"] == 0);
    CHECK(result["time"] == 0);
    CHECK(result["contacts"].size() == 2);
    CHECK(result["bodies"][2]["position"] == Json({0, 1.5, 0}));
}

TEST_CASE("two runs, an exported scene and a scene on standard input end in the same state") {
    const auto hash = [](const std::string& arguments, const std::string& input = "") {
        const Outcome outcome = call("run " + arguments + " --steps 60 --json - --quiet", input);
        REQUIRE(outcome.status == 0);
        return Json::parse(outcome.out)["state_hash"].get<std::string>();
    };
    const std::string first = hash("pit --set count=30");
    CHECK(hash("pit --set count=30") == first);
    CHECK(hash("-", call("export pit --set count=30").out) == first);
    CHECK(hash("pit --set count=31") != first);
    CHECK(hash("pit --set count=30 --threads 4 --lanes 8") == first);
}

TEST_CASE(
    "steps are the seconds over dt, rounded, at least one; another solver brings its own "
    "defaults") {
    const auto run = [](const std::string& arguments) {
        const Outcome outcome = call("run tower --set height=1 --json - --quiet " + arguments);
        REQUIRE(outcome.status == 0);
        return Json::parse(outcome.out);
    };
    CHECK(run("--seconds 0.5")["steps"] == 30);
    CHECK(run("--seconds 0.008")["steps"] == 1);
    CHECK(run("--seconds 1 --dt 0.03")["steps"] == 33);
    CHECK(run("--steps 1 --solver xpbd")["step"]["substeps"] == 20);
    CHECK(run("--steps 1 --solver xpbd")["step"]["iterations"] == 1);
    CHECK(run("--steps 1 --solver xpbd --substeps 3")["step"]["substeps"] == 3);
    CHECK(run("--steps 1 --narrow-phase gjk-epa")["step"]["narrow_phase"] == "gjk-epa");
    const std::string scene = R"({"cairn": 1, "step": {"solver": "xpbd", "substeps": 7}})";
    const auto substeps = [&](const std::string& flags) {
        return Json::parse(
            call("run - --steps 1 --json - --quiet " + flags, scene).out)["step"]["substeps"];
    };
    CHECK(substeps("") == 7);
    CHECK(substeps("--solver xpbd") == 7);
    CHECK(substeps("--solver sequential-impulse") == 1);
}

TEST_CASE(
    "without --quiet a run ends with a summary, on standard error where the result has standard "
    "output") {
    const Outcome plain = call("run drop --steps 10");
    CHECK(plain.status == 0);
    for (const char* words : {"bodies", "contacts", "ms", "energy", "penetration", "real time"}) {
        CHECK(plain.out.find(words) != std::string::npos);
    }
    const Outcome beside = call("run drop --steps 10 --json -");
    CHECK(Json::accept(beside.out));
    CHECK(beside.err.find("penetration") != std::string::npos);
    const Outcome quiet = call("run drop --steps 10 --quiet");
    CHECK(quiet.out.empty());
    CHECK(quiet.err.empty());
}

TEST_CASE("the summary tells threads, stages and sleepers, and no stages of a first step alone") {
    const Outcome one = call("run tower --set height=2 --seconds 5");
    REQUIRE(one.status == 0);
    CHECK(one.out.find("\n  simulated    5 s in 300 steps\n") != std::string::npos);
    // The ground and two cubes, which have come to rest.
    CHECK(one.out.find("\n  bodies       3, of which 2 sleep at the end\n") != std::string::npos);
    CHECK(one.out.find(", one thread\n") != std::string::npos);
    std::size_t at = one.out.find("\n  stages       find-pairs ");
    for (const char* stage : {"find-axes ", "build-manifolds ", "solve ", "finish ", " ms\n"}) {
        CAPTURE(stage);
        REQUIRE(at != std::string::npos);
        at = one.out.find(stage, at);
    }
    CHECK(at < one.out.find("\n  energy "));
    CHECK(call("run drop --steps 3 --threads 2").out.find(", 2 threads\n") != std::string::npos);
    CHECK(call("run drop --steps 1").out.find("stages") == std::string::npos);
}

TEST_CASE("bad usage is refused with status 2 and one line") {
    check_refused("", "subcommand");
    check_refused("run", "SCENE");
    check_refused("walk", "walk");
    check_refused("run drop --bogus", "bogus");
    check_refused("run drpo", "did you mean \"drop\"");
    check_refused("run no/such/scene.json", "no such file");
    check_refused("run drop --steps -1", "--steps");
    check_refused("run drop --steps 1.5", "--steps");
    check_refused("run drop --steps 5 --seconds 1", "one of them");
    check_refused("run drop --seconds nan", "--seconds");
    check_refused("run drop --dt 0", "--dt");
    check_refused("run drop --solver avbd", "not yet supported");
    check_refused("run drop --solver magic", "soft-step, sequential-impulse, xpbd");
    check_refused("run drop --broad-phase bush", "tree, brute-force");
    check_refused("run drop --narrow-phase mpr", "sat, gjk-epa");
    check_refused("run drop --substeps 0", "1 to 1000");
    check_refused("run drop --threads 0", "--threads");
    check_refused("run drop --lanes x", "--lanes");
    check_refused("run drop --sample-every 0", "--sample-every");
    check_refused("run drop --set height", "key=value");
    check_refused("run drop --set hight=2", "did you mean \"height\"");
    check_refused("run drop --set height=-2", "0.1 to 1000");
    check_refused("run drop --json /no/such/folder/result.json", "cannot write");
    check_refused("export no-such-scene", "no built-in scene");
    check_refused("check - --set a=1", "--set", "{\"cairn\": 1}");
    check_refused("report", "not yet part of this version");
    check_refused("report --solver xpbd", "not yet part of this version");
}

TEST_CASE(
    "a trace holds each step on the caller's row, its stages within, and a second thread's work") {
    const Scratch scratch;
    const std::string path = scratch.file("trace.json");
    const Outcome outcome =
        call("run pyramid --set base=40 --steps 60 --threads 2 --trace " + path);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.out.find("trace        " + path) != std::string::npos);
    const auto json = nlohmann::json::parse(read_all(path));

    std::map<int, std::vector<double>> open;  // by thread: ends of the spans not over yet
    std::map<std::string, int> counts;
    double last = 0;
    for (const auto& event : json.at("traceEvents")) {
        if (event.at("ph") == "M") continue;
        const double begin = event.at("ts");
        const double end = begin + event.at("dur").get<double>();
        const int thread = event.at("tid");
        CHECK(begin >= last);
        last = begin;
        // What began is over before a span begins, or holds all of it; half a nanosecond is the
        // rounding of the sum.
        auto& ends = open[thread];
        while (!ends.empty() && ends.back() <= begin + 0.0005) ends.pop_back();
        if (!ends.empty()) CHECK(end <= ends.back() + 0.0005);
        const bool is_stage = thread == 0 && ends.size() == 1;
        ends.push_back(end);
        const std::string name = event.at("name");
        if (thread == 0 && ends.size() == 1) CHECK(name == "step");
        if (name == "step" || is_stage) ++counts[name];
        if (thread == 1) ++counts["on the second thread"];
    }
    for (const char* name :
         {"step", "apply-changes", "find-pairs", "find-axes", "build-manifolds", "join-islands",
          "solve", "move-bodies", "report-contacts", "put-to-rest"}) {
        CAPTURE(name);
        CHECK(counts[name] == 60);
    }
    CHECK(counts["on the second thread"] > 0);
}

TEST_CASE("a trace that cannot be written is refused before the run") {
    check_refused("run drop --trace /nowhere/at/all.json", "--trace /nowhere/at/all.json");
    check_refused("run drop --trace -", "--trace: found -; allowed: a file");
    check_refused("run drop --trace", "--trace");
}

TEST_CASE("a broken scene is refused by run and by check, with the path, and writes no result") {
    const std::string scene =
        R"({"cairn": 1, "bodies": [{"shapes": [{"kind": "sphere", "radius": -1}]}]})";
    const std::string words =
        "standard input: bodies[0].shapes[0].radius: found -1; allowed: a number greater than 0";
    check_refused("run - --json -", words, scene);
    check_refused("check -", words, scene);
    const Scratch scratch;
    std::ofstream(scratch.file("result.json")) << "kept";
    check_refused("run - --json " + scratch.file("result.json"), words, scene);
    CHECK(read_all(scratch.file("result.json")) == "kept");
}

TEST_CASE("a body that becomes non-finite makes status 1, and the result says which and when") {
    // A force that binary32 holds, on a mass that turns it into more than binary32 holds.
    const std::string scene = R"({"cairn": 1, "bodies": [
        {"name": "well", "shapes": [{"kind": "sphere", "radius": 0.1}]},
        {"name": "doomed", "position": [9, 0, 0], "linear_velocity": [3e38, 0, 0], "force": [3e38, 0, 0],
         "shapes": [{"kind": "sphere", "radius": 0.1}]}]})";
    const Outcome outcome = call("run - --steps 600 --json - --quiet", scene);
    CAPTURE(outcome.err);
    if (outcome.status == 2) {
        // The world may refuse such numbers at the door instead.
        CHECK(outcome.err.find("bodies[1]") != std::string::npos);
        return;
    }
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("doomed") != std::string::npos);
    const Json result = Json::parse(outcome.out);
    REQUIRE(result["non_finite"].size() == 1);
    CHECK(list_keys(result["non_finite"][0]) == Keys{"body", "step", "time", "quantity"});
    CHECK(result["non_finite"][0]["body"] == "doomed");
    CHECK(result["steps"] == 600);
}

TEST_CASE("every built-in scene is listed, exports, passes the check and runs") {
    const std::string listing = call("scenes").out;
    for (const char* name :
         {"showcase", "drop", "bounce", "incline", "pyramid", "tower", "dominoes", "card-house",
          "billiards", "cradle", "t-handle", "roll", "conveyor", "mass-ratio", "pit"}) {
        CAPTURE(name);
        CHECK(listing.find(std::string(name) + " ") != std::string::npos);
        CHECK(Json::accept(call(std::string("export ") + name).out));
        CHECK(call(std::string("check ") + name).status == 0);
        CHECK(call(std::string("run --quiet --steps 2 ") + name).status == 0);
    }
}

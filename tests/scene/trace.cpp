// The Trace Event Format of a step's spans, read back by another library.

#include "scene/trace.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <vector>

using cairn::TraceSpan;

TEST_CASE("a trace begins at zero, counts microseconds, and names its threads") {
    const std::vector<TraceSpan> spans = {
        {"step", 0, 5'000'000'000'000, 5'000'000'002'500},
        {"solve \"hard\"", 2, 5'000'000'001'001, 5'000'000'002'000}};
    const auto json = nlohmann::json::parse(cairn::scene::trace_to_json(spans));
    const auto& events = json.at("traceEvents");
    REQUIRE(events.size() == 4);

    CHECK(events[0].at("ph") == "M");
    CHECK(events[0].at("name") == "thread_name");
    CHECK(events[0].at("tid") == 0);
    CHECK(events[0].at("args").at("name") == "caller");
    CHECK(events[1].at("tid") == 2);
    CHECK(events[1].at("args").at("name") == "worker 2");

    CHECK(events[2].at("ph") == "X");
    CHECK(events[2].at("name") == "step");
    CHECK(events[2].at("ts") == 0.0);
    CHECK(events[2].at("dur") == 2.5);
    CHECK(events[3].at("name") == "solve \"hard\"");
    CHECK(events[3].at("tid") == 2);
    CHECK(events[3].at("pid") == events[2].at("pid"));
    CHECK(events[3].at("ts") == 1.001);
    CHECK(events[3].at("dur") == 0.999);
}

TEST_CASE("no spans make an empty trace that is JSON all the same") {
    const auto json = nlohmann::json::parse(cairn::scene::trace_to_json({}));
    CHECK(json.at("traceEvents").empty());
}

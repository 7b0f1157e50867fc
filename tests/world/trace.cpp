// What a world says of its own steps: who did what when, and that looking changes nothing.

#include "cairn/trace.h"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "cairn/cairn.h"

namespace {

using namespace cairn;

constexpr double dt = 1.0 / 60;

// Enough bodies and pairs for a step to be shared.
World make_wall(int threads) {
    World world;
    (void)world.create_body({.kind = BodyKind::Static, .shapes = {{.geometry = Plane{}}}});
    for (int i = 0; i < 900; ++i) {
        (void)world.create_body({.position = {1.01 * (i % 30), 0.5 + i / 30, 0},
                                 .shapes = {{.geometry = Box{{0.5f, 0.5f, 0.5f}}}}});
    }
    (void)world.set_threads({.count = threads});
    (void)world.step(dt);
    return world;
}

int count_steps(const Trace& trace) {
    int count = 0;
    for (const TraceSpan& span : trace.spans) count += std::string(span.name) == "step" ? 1 : 0;
    return count;
}

}  // namespace

TEST_CASE("a traced world goes through the states of its untraced copy, on several threads") {
    World traced = make_wall(3);
    REQUIRE(traced.set_trace(1000).ok());
    World other = traced;
    for (int step = 0; step < 10; ++step) {
        (void)traced.step(dt);
        (void)other.step(dt);
        CHECK(traced.state_hash() == other.state_hash());
    }
    CHECK(count_steps(traced.trace()) > 0);
    CHECK(other.trace().spans.empty());
}

TEST_CASE("every worker of a shared step has spans, all of them within the step") {
    World world = make_wall(2);
    REQUIRE(world.set_trace(100000).ok());
    // Whether the system lets the second thread run in any one step is the system's affair.
    for (int step = 0; step < 60; ++step) (void)world.step(dt);
    const Trace trace = world.trace();
    CHECK(count_steps(trace) == 60);
    CHECK(trace.forgotten_count == 0);
    std::set<int> workers;
    TraceSpan step;
    bool is_within = true;
    for (const TraceSpan& span : trace.spans) {
        workers.insert(span.worker);
        if (std::string(span.name) == "step") step = span;
        is_within = is_within && step.begin_ns <= span.begin_ns && span.end_ns <= step.end_ns;
    }
    CHECK(is_within);
    CHECK(workers == std::set<int>{0, 1});
}

TEST_CASE("a trace keeps the latest spans, begins anew with other threads, and ends when told") {
    World world = make_wall(1);
    REQUIRE(world.set_trace(20).ok());
    for (int step = 0; step < 5; ++step) (void)world.step(dt);
    CHECK(world.trace().spans.size() == 20);
    CHECK(world.trace().forgotten_count > 0);
    REQUIRE(world.set_threads({.count = 2}).ok());
    CHECK(world.trace().spans.empty());
    (void)world.step(dt);
    CHECK(!world.trace().spans.empty());
    REQUIRE(world.set_trace(0).ok());
    (void)world.step(dt);
    CHECK(world.trace().spans.empty());
    CHECK(!world.set_trace(max_trace_spans + 1).ok());
}

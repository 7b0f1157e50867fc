// Spans go in by worker and come out by time.

#include "base/stage_trace.h"

#include <doctest/doctest.h>

#include <string>

#include "base/scheduler.h"

using cairn::StageTrace;
using cairn::TraceScope;
using cairn::TraceSpan;

TEST_CASE("spans come out in the order of their beginnings, the outer before the inner") {
    StageTrace trace(2, 8);
    trace.record(1, "late", 30, 40);
    trace.record(0, "inner", 10, 15);
    trace.record(0, "outer", 10, 50);
    trace.record(1, "first", 5, 6);
    std::string order;
    for (const TraceSpan& span : trace.spans()) order += std::string(span.name) + " ";
    CHECK(order == "first outer inner late ");
    CHECK(trace.forgotten_count() == 0);
}

TEST_CASE("a full ring forgets its oldest spans, and says how many") {
    StageTrace trace(2, 4);
    for (int i = 0; i < 11; ++i) trace.record(0, "span", i, i + 1);
    trace.record(1, "other", 3, 4);
    const auto spans = trace.spans();
    REQUIRE(spans.size() == 5);
    CHECK(spans.front().worker == 1);
    CHECK(spans[1].begin_ns == 7);
    CHECK(spans.back().begin_ns == 10);
    CHECK(trace.forgotten_count() == 7);
    trace.clear();
    CHECK(trace.spans().empty());
    CHECK(trace.forgotten_count() == 0);
}

TEST_CASE("workers without a ring, and scopes without a trace, leave no mark") {
    StageTrace trace(1, 4);
    trace.record(1, "nobody", 0, 1);
    trace.record(-1, "nobody", 0, 1);
    { const TraceScope scope(nullptr, 0, "off"); }
    CHECK(trace.spans().empty());
}

TEST_CASE("workers of a team record at once, each span within the run it belongs to") {
    const auto scheduler = *cairn::make_scheduler({.count = 4});
    cairn::Team team(scheduler);
    StageTrace trace(team.worker_count(), 1000);
    {
        const TraceScope whole(&trace, 0, "whole");
        team.for_range(
            500, 1, [&](int, int, int worker) { const TraceScope scope(&trace, worker, "block"); });
    }
    const auto spans = trace.spans();
    REQUIRE(spans.size() == 501);
    const TraceSpan whole = spans.front();
    CHECK(std::string(whole.name) == "whole");
    bool is_within = true;
    for (const TraceSpan& span : spans) {
        is_within = is_within && whole.begin_ns <= span.begin_ns && span.begin_ns <= span.end_ns &&
                    span.end_ns <= whole.end_ns;
    }
    CHECK(is_within);
}

// Spans as complete events ("ph": "X") and the names of threads as metadata ("M"); see trace.h.

#include "scene/trace.h"

#include <algorithm>
#include <set>

#include "scene/json_writer.h"

namespace cairn::scene {
namespace {

constexpr double ns_per_us = 1000;

void write_thread(JsonWriter& json, int worker) {
    const std::string name = worker == 0 ? "caller" : "worker " + std::to_string(worker);
    json.begin_object(Layout::Inline);
    json.member("name", "thread_name").member("ph", "M").member("pid", 1).member("tid", worker);
    json.key("args").begin_object(Layout::Inline).member("name", std::string_view(name)).end();
    json.end();
}

void write_span(JsonWriter& json, const TraceSpan& span, std::int64_t origin_ns) {
    json.begin_object(Layout::Inline);
    json.member("name", span.name).member("ph", "X").member("pid", 1).member("tid", span.worker);
    json.member("ts", double(span.begin_ns - origin_ns) / ns_per_us);
    json.member("dur", double(span.end_ns - span.begin_ns) / ns_per_us);
    json.end();
}

}  // namespace

std::string trace_to_json(std::span<const TraceSpan> spans) {
    std::set<int> workers;
    std::int64_t origin_ns = spans.empty() ? 0 : spans.front().begin_ns;
    for (const TraceSpan& span : spans) {
        workers.insert(span.worker);
        origin_ns = std::min(origin_ns, span.begin_ns);
    }
    JsonWriter json;
    json.begin_object();
    json.member("displayTimeUnit", "ms");
    json.key("traceEvents").begin_array();
    for (const int worker : workers) write_thread(json, worker);
    for (const TraceSpan& span : spans) write_span(json, span, origin_ns);
    json.end().end();
    return json.take();
}

}  // namespace cairn::scene

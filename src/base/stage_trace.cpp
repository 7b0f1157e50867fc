// Rings of spans; see stage_trace.h.

#include "base/stage_trace.h"

#include <algorithm>
#include <tuple>

namespace cairn {

StageTrace::StageTrace(int worker_count, std::size_t spans_per_worker)
    : rings_(std::size_t(std::max(worker_count, 0))) {
    for (Ring& ring : rings_) ring.spans.resize(std::max<std::size_t>(spans_per_worker, 1));
}

void StageTrace::record(int worker, const char* name, std::int64_t begin_ns, std::int64_t end_ns) {
    if (worker < 0 || std::size_t(worker) >= rings_.size()) return;
    Ring& ring = rings_[std::size_t(worker)];
    ring.spans[std::size_t(ring.recorded % ring.spans.size())] = {name, worker, begin_ns, end_ns};
    ++ring.recorded;
}

std::vector<TraceSpan> StageTrace::spans() const {
    std::vector<TraceSpan> all;
    for (const Ring& ring : rings_) {
        const std::size_t held =
            std::size_t(std::min<std::uint64_t>(ring.recorded, ring.spans.size()));
        all.insert(all.end(), ring.spans.begin(), ring.spans.begin() + std::ptrdiff_t(held));
    }
    // The longer first: who reads them in order meets a span before those within it.
    std::stable_sort(all.begin(), all.end(), [](const TraceSpan& a, const TraceSpan& b) {
        return std::tuple(a.begin_ns, a.worker, b.end_ns) <
               std::tuple(b.begin_ns, b.worker, a.end_ns);
    });
    return all;
}

std::uint64_t StageTrace::forgotten_count() const {
    std::uint64_t count = 0;
    for (const Ring& ring : rings_) {
        count += ring.recorded - std::min<std::uint64_t>(ring.recorded, ring.spans.size());
    }
    return count;
}

void StageTrace::clear() {
    for (Ring& ring : rings_) ring.recorded = 0;
}

}  // namespace cairn

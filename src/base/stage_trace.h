#pragma once
// Collects who did what when: spans of time, a ring of them a worker.
//
// Each worker writes to its own ring alone, so there is no lock and no atomic. A full ring forgets
// its oldest. Read it between steps, by the thread that steps. Nothing here may ever reach a
// result.
//
// The thread that steps says which stage it is in; what a team's workers do meanwhile is named
// after it.
//
//     TraceScope scope(trace, worker, "solve contacts");   // until the end of the block; null: off

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "cairn/trace.h"

namespace cairn {

class StageTrace {
public:
    // Room for that many spans of each worker, all of it taken now.
    StageTrace(int worker_count, std::size_t spans_per_worker);

    // By that worker only. A worker that the trace has no ring for is not recorded.
    void record(int worker, const char* name, std::int64_t begin_ns, std::int64_t end_ns);

    // All that the rings hold, by beginning; of equal ones, by worker, then the longer first.
    std::vector<TraceSpan> spans() const;
    // How many spans were recorded since the last clear() and are forgotten.
    std::uint64_t forgotten_count() const;
    void clear();
    std::size_t spans_per_worker() const { return rings_.empty() ? 0 : rings_[0].spans.size(); }

    // By the thread that steps, between two runs of its team.
    void enter_stage(const char* name) { stage_ = name; }
    const char* stage() const { return stage_; }

    static std::int64_t now_ns() {
        using std::chrono::nanoseconds;
        const auto now = std::chrono::steady_clock::now().time_since_epoch();
        return std::chrono::duration_cast<nanoseconds>(now).count();
    }

private:
    // A cache line each, since all workers count at once.
    struct alignas(64) Ring {
        std::vector<TraceSpan> spans;
        std::uint64_t recorded = 0;
    };
    std::vector<Ring> rings_;
    const char* stage_ = "";
};

// The trace of one world: a copy of the world begins without.
class OwnTrace {
public:
    OwnTrace() = default;
    OwnTrace(const OwnTrace&) {}
    OwnTrace(OwnTrace&&) noexcept = default;
    OwnTrace& operator=(const OwnTrace&) {
        trace_.reset();
        return *this;
    }
    OwnTrace& operator=(OwnTrace&&) noexcept = default;

    // 0 spans: none.
    void begin(int worker_count, std::size_t spans_per_worker) {
        trace_.reset();
        if (spans_per_worker > 0)
            trace_ = std::make_unique<StageTrace>(worker_count, spans_per_worker);
    }
    StageTrace* get() const { return trace_.get(); }

private:
    std::unique_ptr<StageTrace> trace_;
};

class TraceScope {
public:
    TraceScope(StageTrace* trace, int worker, const char* name)
        : trace_(trace),
          name_(name),
          begin_ns_(trace != nullptr ? StageTrace::now_ns() : 0),
          worker_(worker) {}
    ~TraceScope() {
        if (trace_ != nullptr) trace_->record(worker_, name_, begin_ns_, StageTrace::now_ns());
    }
    TraceScope(const TraceScope&) = delete;
    TraceScope& operator=(const TraceScope&) = delete;

private:
    StageTrace* trace_;
    const char* name_;
    std::int64_t begin_ns_;
    int worker_;
};

}  // namespace cairn

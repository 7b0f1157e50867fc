#pragma once
// What a step did when, thread by thread: for looking at, never for deciding anything.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cairn {

/// One piece of a step's work on one thread.
struct TraceSpan {
    const char* name = "";  ///< what was done; lives as long as the program
    int worker = 0;         ///< who did it; 0 is the thread that called the step
    /// Nanoseconds of a clock that never goes back; only differences mean anything.
    std::int64_t begin_ns = 0;
    std::int64_t end_ns = 0;
};

/// More spans of a thread than this are an error, not a wish.
constexpr std::size_t max_trace_spans = std::size_t{1} << 24;

/// What a world's last steps did, World::trace.
struct Trace {
    /// By beginning, the outer before what lies in it: each step on worker 0, in it its stages, and
    /// in these what each worker did of the blocks that were shared out. What a worker waits for is
    /// in no span of its own.
    std::vector<TraceSpan> spans;
    std::uint64_t forgotten_count = 0;  ///< older spans for which there was no room
};

}  // namespace cairn

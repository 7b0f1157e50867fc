#pragma once
// What a step did when, thread by thread: for looking at, never for deciding anything.

#include <cstdint>

namespace cairn {

/// One piece of a step's work on one thread.
struct TraceSpan {
    const char* name = "";  ///< what was done; lives as long as the program
    int worker = 0;         ///< who did it; 0 is the thread that called the step
    /// Nanoseconds of a clock that never goes back; only differences mean anything.
    std::int64_t begin_ns = 0;
    std::int64_t end_ns = 0;
};

}  // namespace cairn

#pragma once
// Which threads may work on a step: none but the caller's, Cairn's own, or those of the host.
//
// The state after a step is the same to the bit whatever is said here; only the time differs. What
// is too small to share stays on the caller's thread.

namespace cairn {

/// More threads than this are an error, not a wish.
constexpr int max_thread_count = 64;

/// One job of a host's run: the host passes back the context it was given, and the job's index.
using Job = void (*)(void* job_context, int index);

/// A host's own pool. It must call `job(job_context, index)` once for each index from 0 to
/// `job_count` - 1 and return when every call has returned.
///
/// - On any threads, the calling one among them or not, in any order. Jobs that run at the same
///   time share the work; if the host runs them one after another, the first does all of it and the
///   rest return at once. No job waits for one that has not begun.
/// - A job lasts as long as one part of a step, milliseconds in a large scene; a step makes a
///   handful of calls. While it waits for the others a job spins, then yields: it does not block.
///   A job never calls `run` in turn.
/// - It cannot fail: what the host's jobs have left undone when it returns, the caller does.
/// - It must throw nothing. Jobs put the processor's rounding and denormal modes back as they found
///   them.
using RunJobs = void (*)(void* host_context, int job_count, Job job, void* job_context);

/// How many threads, and whose.
struct Threads {
    /// How many work on a step at best, the caller's among them: 0 to `max_thread_count`. With 0 or
    /// 1 there is only the caller's thread, and the hook is not used.
    int count = 1;
    /// Null: Cairn starts count - 1 threads of its own (fewer, if the system refuses some; none,
    /// where the platform has none). They sleep between steps, at no cost, and take no signals.
    RunJobs run = nullptr;
    /// Handed to `run`, never looked into. Must outlive every world that it was given to and every
    /// copy of such a world: copies share the threads. Two worlds that step at once may both come
    /// here; one of them does, and the other works on its own thread alone.
    void* host_context = nullptr;
};

}  // namespace cairn

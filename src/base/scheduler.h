#pragma once
// Who does which part of a step's loops: a few threads that share blocks of a range, one range
// after another, without going to sleep in between.
//
// A stage is a range [0, count) cut into blocks of a fixed size; how many threads there are never
// moves a block's boundaries, so a kernel whose blocks do not depend on each other gives the same
// result on any number of threads. Every stage is over before the next begins.
//
//     Team team(scheduler);                                   // for the time of one step
//     team.for_range(bodies, 64, [&](int begin, int end, int worker) { ... });
//     team.run_stages(stages);                                // barriers between them
//
// A stage's blocks are dealt out in equal shares, one a worker and the same from stage to stage, so
// that a worker meets again what its cache holds; who is done helps the others. The caller works
// too, as worker 0, and does everything itself where nobody comes, so nothing waits for a thread
// that has not begun. docs/decisions/0009-threads.md says why it is made like this.

#include <cassert>
#include <cstdint>
#include <span>
#include <utility>

#include "base/function_ref.h"
#include "cairn/result.h"
#include "cairn/threads.h"

namespace cairn {

// Works on [begin, end), which is one block. `worker` is below the team's worker_count() and no two
// calls that run at once have the same: it may index scratch memory.
using Kernel = FunctionRef<void(int begin, int end, int worker)>;

// A range and what is to be done with it. It refers to the callable, which must outlive the run: a
// temporary is refused.
struct TeamStage {
    template <class Callable>
    TeamStage(int range, int range_block, Callable& callable)
        : count(range), block_size(range_block), kernel(callable) {}
    template <class Callable>
    TeamStage(int, int, const Callable&&) = delete;

    int count;
    int block_size;
    Kernel kernel;
};

class Scheduler;
class StageTrace;

// A scheduler that worlds share: their copies, too, hold the same. It ends with the last of its
// holders. Empty where there is none but the caller's thread. It counts by itself: of the
// standard's pointer a program may bring functions that look for run-time types, which this library
// has not.
class SharedScheduler {
public:
    SharedScheduler() noexcept = default;
    // Takes the scheduler over.
    explicit SharedScheduler(Scheduler* scheduler) noexcept : scheduler_(scheduler) { hold(); }
    SharedScheduler(const SharedScheduler& other) noexcept : scheduler_(other.scheduler_) {
        hold();
    }
    SharedScheduler(SharedScheduler&& other) noexcept
        : scheduler_(std::exchange(other.scheduler_, nullptr)) {}
    SharedScheduler& operator=(SharedScheduler other) noexcept {
        std::swap(scheduler_, other.scheduler_);
        return *this;
    }
    ~SharedScheduler() { let_go(); }

    Scheduler* get() const { return scheduler_; }
    // Of a team that has it; 1 where there is none.
    int worker_count() const;
    explicit operator bool() const { return get() != nullptr; }

private:
    void hold() const noexcept;
    void let_go() const noexcept;

    Scheduler* scheduler_ = nullptr;
};

// The scheduler for these threads; empty where they are none but the caller's. An error for a count
// out of range.
Result<SharedScheduler> make_scheduler(const Threads& threads);

// The workers of one step: a scheduler's, or the caller alone where there is no scheduler or where
// another team has it. Belongs to the thread that made it. A kernel must not call its own team; it
// may make one of its own, which then is the caller alone.
class Team {
public:
    // What its workers do goes into the trace, if there is one, which outlives it.
    explicit Team(const SharedScheduler& scheduler, StageTrace* trace = nullptr);
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    // 1 where the caller is alone.
    int worker_count() const { return worker_count_; }

    // Returns when every block is done. What one block holds never leaves the caller's thread.
    void for_range(int count, int block_size, Kernel kernel) {
        assert(block_size > 0);
        if (count <= block_size) {
            if (count > 0) kernel(0, count, 0);
            return;
        }
        const TeamStage stage(count, block_size, kernel);
        run_stages({&stage, 1});
    }

    // One stage after the other, each over before the next begins. Whatever the number of stages,
    // the workers are called together once.
    void run_stages(std::span<const TeamStage> stages);

private:
    SharedScheduler scheduler_;
    StageTrace* trace_;
    int worker_count_ = 1;
    bool running_ = false;
};

}  // namespace cairn

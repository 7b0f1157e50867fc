// Teams, and the threads behind them: Cairn's own, which sleep between steps, or the host's; see
// scheduler.h. What they do together is in stage_board.h.
//
// Own threads are woken by the first run of a team that finds them asleep. From then on they look
// out for the next run, first spinning, then yielding, and sleep again when the team ends or has
// had nothing for them for a while. A step that never runs a stage wakes nobody.

#include "base/scheduler.h"

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "base/float_environment.h"
#include "base/os_thread.h"
#include "base/stage_board.h"

namespace cairn {
namespace {

// How often an own thread looks out for the next run of an open team before it sleeps: beyond its
// first pauses, that many yields, or some hundred microseconds of a stage on one thread.
constexpr int looks_before_sleep = Patience::pauses + 400;

void run_alone(const TeamStage& stage) {
    assert(stage.block_size > 0);
    for (int begin = 0; begin < stage.count;) {
        const int size = std::min(stage.block_size, stage.count - begin);
        stage.kernel(begin, begin + size, 0);
        begin += size;
    }
}

}  // namespace

class Scheduler {
public:
    std::atomic<int> holders = 0;

    explicit Scheduler(const Threads& threads)
        : board_(threads.count),
          host_(threads),
          threads_(threads.run == nullptr ? std::size_t(threads.count - 1) : 0) {
        for (OsThread& thread : threads_) {
            if (!thread.start(&Scheduler::enter_own_thread, this, started_ + 1)) break;
            ++started_;
        }
    }

    ~Scheduler() {
        stopping_.store(true, std::memory_order_seq_cst);
        bell_.ring();
        for (int i = 0; i < started_; ++i) threads_[std::size_t(i)].join();
    }

    Scheduler(const Scheduler&) = delete;
    Scheduler& operator=(const Scheduler&) = delete;

    int worker_count() const { return board_.worker_count(); }

    // True for one team at a time.
    bool open() {
        if (is_open_.load(std::memory_order_relaxed)) return false;
        return !is_open_.exchange(true, std::memory_order_acquire);
    }
    void close() { is_open_.store(false, std::memory_order_release); }

    // At most as many stages as the board holds. Only while open, by the opener.
    void run(std::span<const TeamStage> stages, StageTrace* trace) {
        const StageBoard::Ticket first = board_.publish(stages, trace);
        Walk walk = {&board_, first, board_.end()};
        if (host_.run != nullptr) {
            host_.run(host_.host_context, worker_count(), &Scheduler::enter_host_job, &walk);
        } else if (sleepers_.load(std::memory_order_seq_cst) > 0) {
            bell_.ring();
        }
        walk.go(0);
    }

private:
    // One worker's way through the stages of a run.
    struct Walk {
        StageBoard* board;
        StageBoard::Ticket first;
        StageBoard::Ticket end;

        void go(int worker) const {
            for (StageBoard::Ticket at = first; at < end;) at = board->work_on(at, worker);
        }
    };

    static void enter_host_job(void* walk, int index) {
        const FloatEnvironment ieee;
        const Walk& shared = *static_cast<const Walk*>(walk);
        if (index >= 0 && index < shared.board->worker_count()) shared.go(index);
    }

    static void enter_own_thread(void* scheduler, int worker) {
        const FloatEnvironment ieee;
        static_cast<Scheduler*>(scheduler)->work_until_stopped(worker);
    }

    void work_until_stopped(int worker) {
        // From the very first: stages may have been published before this thread began.
        StageBoard::Ticket at = StageBoard::first_ticket;
        Patience patience;
        while (!stopping_.load(std::memory_order_acquire)) {
            if (at < board_.end()) {
                at = board_.work_on(at, worker);
                patience = {};
            } else if (is_open_.load(std::memory_order_relaxed) &&
                       patience.waits() < looks_before_sleep) {
                patience.wait();
            } else {
                sleep(at);
                patience = {};
            }
        }
    }

    // Whoever publishes after the sleeper was counted rings; what was published before is seen
    // here.
    void sleep(StageBoard::Ticket at) {
        sleepers_.fetch_add(1, std::memory_order_seq_cst);
        bell_.sleep([&] { return at < board_.end() || stopping_.load(std::memory_order_seq_cst); });
        sleepers_.fetch_sub(1, std::memory_order_seq_cst);
    }

    StageBoard board_;
    const Threads host_;
    std::vector<OsThread> threads_;
    int started_ = 0;
    Doorbell bell_;
    alignas(64) std::atomic<bool> is_open_{false};
    std::atomic<bool> stopping_{false};
    std::atomic<int> sleepers_{0};
};

Result<SharedScheduler> make_scheduler(const Threads& threads) {
    if (threads.count < 0 || threads.count > max_thread_count) {
        return Error{ErrorCode::OutOfRange, "threads.count is " + std::to_string(threads.count) +
                                                ", allowed: 0 to " +
                                                std::to_string(max_thread_count)};
    }
    if (threads.count <= 1) return SharedScheduler();
    if (threads.run == nullptr && CAIRN_THREADS == 0) return SharedScheduler();
    return SharedScheduler(new Scheduler(threads));
}

void SharedScheduler::hold() const noexcept {
    if (scheduler_) scheduler_->holders.fetch_add(1, std::memory_order_relaxed);
}

void SharedScheduler::let_go() const noexcept {
    if (scheduler_ && scheduler_->holders.fetch_sub(1, std::memory_order_acq_rel) == 1)
        delete scheduler_;
}

int SharedScheduler::worker_count() const { return scheduler_ ? scheduler_->worker_count() : 1; }

Team::Team(const SharedScheduler& scheduler, StageTrace* trace) : trace_(trace) {
    if (!scheduler || !scheduler.get()->open()) return;
    scheduler_ = scheduler;
    worker_count_ = scheduler.get()->worker_count();
}

Team::~Team() {
    assert(!running_);
    if (scheduler_) scheduler_.get()->close();
}

void Team::run_stages(std::span<const TeamStage> stages) {
    assert(!running_);
    const auto has_several_blocks = [](const TeamStage& s) { return s.count > s.block_size; };
    if (worker_count_ == 1 || !std::any_of(stages.begin(), stages.end(), has_several_blocks)) {
        for (const TeamStage& stage : stages) run_alone(stage);
        return;
    }
    running_ = true;
    while (!stages.empty()) {
        const std::size_t size = std::min(stages.size(), StageBoard::capacity);
        scheduler_.get()->run(stages.first(size), trace_);
        stages = stages.subspan(size);
    }
    running_ = false;
}

}  // namespace cairn

#pragma once
// Where the stages of a run hang while several threads work through them: who takes which blocks,
// and when a stage is over. No thread, no sleep and no lock: atomics alone.
//
// Every stage that was ever published has a number of its own, its ticket. Workers walk through the
// tickets, each at its own pace, and three facts keep them right:
//
// - Blocks are taken by compare-and-swap on the word of the share that they belong to, and the word
//   holds the ticket. Whoever is late, by however much, takes nothing: the words have moved on.
// - A count of finished units, which never falls, says that a stage is over: units, not threads, so
//   nobody waits for a thread that holds none. Everyone finds this out by themselves, so a barrier
//   costs one way from the last worker to the others.
// - What a stage is stands in a slot that carries its ticket, written last and read twice, so that
//   a late reader knows when the slot is about another stage by now.
//
// Hence nobody signs in or out: a worker that was put aside by the system in the middle of a walk
// wakes many runs later, finds nothing to take, and jumps to the present.

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>

#include "base/scheduler.h"
#include "base/stage_trace.h"

namespace cairn {

class StageBoard {
public:
    using Ticket = std::uint64_t;
    // More stages than this go onto the board in parts.
    static constexpr std::size_t capacity = 512;
    static constexpr Ticket first_ticket = 1;

    explicit StageBoard(int worker_count);

    int worker_count() const { return worker_count_; }

    // Hangs up at most `capacity` stages, but for those that are empty. Only when all earlier ones
    // are over, and by one thread at a time. Returns the ticket of the first. What workers do of
    // them goes into the trace, if there is one.
    Ticket publish(std::span<const TeamStage> stages, StageTrace* trace = nullptr);
    // One past the last ticket that was published. A worker reads it to see whether there is work,
    // before it goes to sleep too, which is why it is sequentially consistent.
    Ticket end() const { return end_.load(std::memory_order_seq_cst); }

    // Does what this worker can of one stage below end() and returns when the stage is over: the
    // ticket to look at next. A worker takes the tickets in order, beginning with one that
    // publish() returned.
    Ticket work_on(Ticket ticket, int worker);

private:
    // A stage as workers see it, and how its blocks are dealt out: `blocks_per_unit` neighbours are
    // taken at once, and worker w owns the units [first_unit(w), first_unit(w + 1)).
    struct View {
        Kernel::Call call = nullptr;
        void* object = nullptr;
        int count = 0;
        int block_size = 1;
        int unit_count = 0;
        int blocks_per_unit = 1;
        std::uint64_t done_at = 0;  // how many units, of all stages ever, when it is over
        StageTrace* trace = nullptr;
    };
    struct Slot {
        std::atomic<Ticket> ticket{0};
        std::atomic<Kernel::Call> call{nullptr};
        std::atomic<void*> object{nullptr};
        std::atomic<int> count{0};
        std::atomic<int> block_size{1};
        std::atomic<int> unit_count{0};
        std::atomic<int> blocks_per_unit{1};
        std::atomic<std::uint64_t> done_at{0};
        std::atomic<StageTrace*> trace{nullptr};
    };
    // One worker's share of the stage that it says. A cache line each, mostly its owner's.
    struct alignas(64) Share {
        std::atomic<std::uint64_t> left{0};
        std::atomic<Ticket> owner_at{0};  // the last stage that the owner came to
    };
    enum class End { Front, Back };

    int first_unit(const View& view, int worker) const;
    View deal_out(const TeamStage& stage) const;
    void write(Slot& slot, const View& view, Ticket ticket);
    bool read(Ticket ticket, View& view) const;
    int take(Share& share, Ticket ticket, int size, End end, int leave);
    int work_share(const View& view, Ticket ticket, int worker);
    int help(const View& view, Ticket ticket, int worker, bool with_the_last);
    static void run_unit(const View& view, int unit, int worker);
    template <class Work>
    void do_units(const View& view, int worker, const Work& work);

    const int worker_count_;
    std::unique_ptr<Share[]> shares_;
    std::unique_ptr<std::array<Slot, capacity>> slots_;

    // Of the publishing thread: what done_ will be when all that is published is over.
    std::uint64_t done_at_end_ = 0;
    alignas(64) std::atomic<Ticket> first_{first_ticket};  // of the stages that were published last
    std::atomic<Ticket> end_{first_ticket};
    alignas(64) std::atomic<std::uint64_t> done_{0};
};

}  // namespace cairn

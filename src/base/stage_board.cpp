// How workers take blocks and learn that a stage is over; see stage_board.h.
//
// A share's word: ticket << 16 | first << 8 | last, with the units [first, last) of the share left.
// A word of an earlier ticket stands for a share that is whole yet, so that nobody has to fill the
// shares before a stage. 48 bits of ticket last four years at a million stages a second.

#include "base/stage_board.h"

#include <algorithm>

#include "base/os_thread.h"

namespace cairn {
namespace {

constexpr int none = -1;
constexpr int max_units_a_share = 255;

// How long a worker leaves an owner its last unit, in pauses: about a microsecond, in which an
// owner that runs will have come to it. To fetch what lies in the owner's cache takes longer.
constexpr int pauses_before_the_last = 32;

// What no stage has.
constexpr StageBoard::Ticket no_ticket = 0;

std::uint64_t pack(StageBoard::Ticket ticket, unsigned first, unsigned last) {
    return ticket << 16 | first << 8 | last;
}

}  // namespace

StageBoard::StageBoard(int worker_count)
    : worker_count_(worker_count),
      shares_(std::make_unique<Share[]>(std::size_t(worker_count))),
      slots_(std::make_unique<std::array<Slot, capacity>>()) {}

// Rounded up, so that where there is one unit it is the caller's.
int StageBoard::first_unit(const View& view, int worker) const {
    return (view.unit_count * worker + worker_count_ - 1) / worker_count_;
}

StageBoard::View StageBoard::deal_out(const TeamStage& stage) const {
    assert(stage.block_size > 0);
    const int block_count = (stage.count - 1) / stage.block_size + 1;
    View view;
    view.call = stage.kernel.call();
    view.object = stage.kernel.object();
    view.count = stage.count;
    view.block_size = stage.block_size;
    view.blocks_per_unit = (block_count - 1) / (max_units_a_share * worker_count_) + 1;
    view.unit_count = (block_count - 1) / view.blocks_per_unit + 1;
    return view;
}

StageBoard::Ticket StageBoard::publish(std::span<const TeamStage> stages, StageTrace* trace) {
    assert(stages.size() <= capacity);
    const Ticket first = end_.load(std::memory_order_relaxed);
    first_.store(first, std::memory_order_release);
    Ticket ticket = first;
    for (const TeamStage& stage : stages) {
        if (stage.count <= 0) continue;
        View view = deal_out(stage);
        done_at_end_ += std::uint64_t(view.unit_count);
        view.done_at = done_at_end_;
        view.trace = trace;
        write((*slots_)[ticket % capacity], view, ticket);
        ++ticket;
    }
    end_.store(ticket, std::memory_order_seq_cst);
    return first;
}

// Late readers of what stood here see the old ticket gone before they see anything new.
void StageBoard::write(Slot& slot, const View& view, Ticket ticket) {
    slot.ticket.store(no_ticket, std::memory_order_relaxed);
    slot.call.store(view.call, std::memory_order_release);
    slot.object.store(view.object, std::memory_order_release);
    slot.count.store(view.count, std::memory_order_release);
    slot.block_size.store(view.block_size, std::memory_order_release);
    slot.unit_count.store(view.unit_count, std::memory_order_release);
    slot.blocks_per_unit.store(view.blocks_per_unit, std::memory_order_release);
    slot.done_at.store(view.done_at, std::memory_order_release);
    slot.trace.store(view.trace, std::memory_order_release);
    slot.ticket.store(ticket, std::memory_order_release);
}

// False where the slot has gone on to a later stage.
bool StageBoard::read(Ticket ticket, View& view) const {
    const Slot& slot = (*slots_)[ticket % capacity];
    if (slot.ticket.load(std::memory_order_acquire) != ticket) return false;
    view.call = slot.call.load(std::memory_order_acquire);
    view.object = slot.object.load(std::memory_order_acquire);
    view.count = slot.count.load(std::memory_order_acquire);
    view.block_size = slot.block_size.load(std::memory_order_acquire);
    view.unit_count = slot.unit_count.load(std::memory_order_acquire);
    view.blocks_per_unit = slot.blocks_per_unit.load(std::memory_order_acquire);
    view.done_at = slot.done_at.load(std::memory_order_acquire);
    view.trace = slot.trace.load(std::memory_order_acquire);
    return slot.ticket.load(std::memory_order_relaxed) == ticket;
}

StageBoard::Ticket StageBoard::work_on(Ticket ticket, int worker) {
    View view;
    if (!read(ticket, view)) return first_.load(std::memory_order_acquire);
    if (done_.load(std::memory_order_acquire) >= view.done_at) return ticket + 1;

    shares_[worker].owner_at.store(ticket, std::memory_order_relaxed);
    do_units(view, worker,
             [&] { return work_share(view, ticket, worker) + help(view, ticket, worker, false); });
    Patience patience;
    while (done_.load(std::memory_order_acquire) < view.done_at) {
        patience.wait();
        // Once more now and then: an owner may have been put aside by the system since.
        if (patience.waits() % pauses_before_the_last == 0) {
            do_units(view, worker, [&] { return help(view, ticket, worker, true); });
        }
    }
    return ticket + 1;
}

// Lets the worker do what units it finds, then tells everyone of them, and hands on what they
// wrote. Only who has done units may look at the trace: the stage is not over then, and who traces
// it is still there.
template <class Work>
void StageBoard::do_units(const View& view, int worker, const Work& work) {
    const std::int64_t begin_ns = view.trace != nullptr ? StageTrace::now_ns() : 0;
    const int units = work();
    if (units == 0) return;
    if (view.trace != nullptr)
        view.trace->record(worker, view.trace->stage(), begin_ns, StageTrace::now_ns());
    done_.fetch_add(std::uint64_t(units), std::memory_order_acq_rel);
}

// All that is left of the worker's own share; returns how many units it did.
int StageBoard::work_share(const View& view, Ticket ticket, int worker) {
    const int first = first_unit(view, worker);
    const int size = first_unit(view, worker + 1) - first;
    int done = 0;
    for (int unit; (unit = take(shares_[worker], ticket, size, End::Front, 0)) != none; ++done) {
        run_unit(view, first + unit, worker);
    }
    return done;
}

// What others have not come to yet, from the end that they come to last. Their very last unit stays
// theirs as long as they are about, unless it is asked for.
int StageBoard::help(const View& view, Ticket ticket, int worker, bool with_the_last) {
    int done = 0;
    for (int i = 1; i < worker_count_; ++i) {
        const int other = worker + i < worker_count_ ? worker + i : worker + i - worker_count_;
        const int first = first_unit(view, other);
        const int size = first_unit(view, other + 1) - first;
        Share& share = shares_[other];
        const bool is_about = share.owner_at.load(std::memory_order_relaxed) + 1 >= ticket;
        const int leave = is_about && !with_the_last ? 1 : 0;
        for (int unit; (unit = take(share, ticket, size, End::Back, leave)) != none; ++done) {
            run_unit(view, first + unit, worker);
        }
    }
    return done;
}

// Takes one unit of a share that has `size` when it is whole, if it holds more than `leave`. The
// order of memory comes from done_ and end_; the word has only to be exact.
int StageBoard::take(Share& share, Ticket ticket, int size, End end, int leave) {
    std::uint64_t word = share.left.load(std::memory_order_relaxed);
    for (;;) {
        unsigned first = unsigned(word >> 8 & 0xff);
        unsigned last = unsigned(word & 0xff);
        if (word >> 16 > ticket) return none;
        if (word >> 16 < ticket) first = 0, last = unsigned(size);
        if (int(last - first) <= leave) return none;
        const int unit = end == End::Front ? int(first++) : int(--last);
        if (share.left.compare_exchange_weak(word, pack(ticket, first, last),
                                             std::memory_order_relaxed)) {
            return unit;
        }
    }
}

void StageBoard::run_unit(const View& view, int unit, int worker) {
    // In 64 bits: the last unit of a range near the end of int reaches past it.
    const std::int64_t unit_size = std::int64_t{view.blocks_per_unit} * view.block_size;
    const int end = int(std::min<std::int64_t>(unit_size * (unit + 1), view.count));
    for (int begin = int(unit_size * unit); begin < end;) {
        const int size = std::min(view.block_size, end - begin);
        view.call(view.object, begin, begin + size, worker);
        begin += size;
    }
}

}  // namespace cairn

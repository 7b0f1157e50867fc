// The scheduler as its users see it: what is done, in which order, by whom, and what happens when
// threads are missing, busy, too many or the host's.

#include "base/scheduler.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/float_environment.h"
#include "base/os_thread.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif
#if CAIRN_THREADS
#include <signal.h>
#endif

using cairn::Job;
using cairn::make_scheduler;
using cairn::SharedScheduler;
using cairn::Team;
using cairn::TeamStage;
using cairn::Threads;

namespace {

SharedScheduler scheduler_of(int count) { return *make_scheduler({.count = count}); }

// Runs one range and says whether every index was met once, in blocks that begin at multiples of
// the block size, by workers that the team has.
bool is_covered_once(Team& team, int count, int block_size) {
    std::vector<std::uint8_t> met(std::size_t(count), 0);
    std::atomic<int> wrong{0};
    const int workers = team.worker_count();
    team.for_range(count, block_size, [&](int begin, int end, int worker) {
        const bool is_a_block =
            begin % block_size == 0 && end == std::min(begin + block_size, count) && begin < end;
        if (!is_a_block || worker < 0 || worker >= workers) ++wrong;
        // Not atomic: two threads at one index would be a race that the thread sanitizer reports.
        for (int i = begin; i < end; ++i) ++met[std::size_t(i)];
    });
    return wrong == 0 && std::ranges::all_of(met, [](int times) { return times == 1; });
}

// Waits until the claim holds, for ten seconds at most: an overloaded machine is slow, not wrong.
template <class Claim>
bool comes_true(Claim claim) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (!claim()) {
        if (std::chrono::steady_clock::now() > deadline) return false;
        std::this_thread::yield();
    }
    return true;
}

// A kernel that holds each worker until all of `expected` have come.
struct Gathering {
    int expected;
    std::atomic<unsigned> came{0};
    std::atomic<int> missed{0};

    void operator()(int, int, int worker) {
        came |= 1u << worker;
        if (!comes_true([&] { return came.load() == (1u << expected) - 1; })) ++missed;
    }
    bool all_came() const { return missed == 0; }
};

}  // namespace

TEST_CASE("every index is met exactly once, in blocks that do not know the number of workers") {
    for (const int workers : {1, 2, 3, 4, 8}) {
        const SharedScheduler scheduler = scheduler_of(workers);
        Team team(scheduler);
        REQUIRE(team.worker_count() == workers);
        for (const int count : {0, 1, 2, 3, 7, 8, 9, 63, 64, 65, 1000, 4097}) {
            for (const int block_size : {1, 2, 3, 16, 64, 1000, 5000}) {
                CAPTURE(workers);
                CAPTURE(count);
                CAPTURE(block_size);
                CHECK(is_covered_once(team, count, block_size));
            }
        }
        // More blocks than a share has units: neighbours are taken together.
        CHECK(is_covered_once(team, 30011, 1));
        CHECK(is_covered_once(team, 100003, 7));
    }
}

TEST_CASE("a range that ends where int does has its last blocks too") {
    constexpr int count = 2147483647;
    const SharedScheduler scheduler = scheduler_of(3);
    Team team(scheduler);
    std::atomic<std::int64_t> met{0};
    std::atomic<int> largest{0};
    team.for_range(count, 1 << 20, [&](int begin, int end, int) {
        met += end - begin;
        int known = largest.load();
        while (known < end && !largest.compare_exchange_weak(known, end)) {
        }
    });
    CHECK(met == count);
    CHECK(largest == count);
}

TEST_CASE("nothing of a stage begins before all of the stage before it is done") {
    // Each stage adds neighbours of what the last one wrote: plain memory, across every block's
    // edge. More stages than the board holds at once, some of them empty, some of one block.
    static constexpr int size = 96;
    static constexpr int stage_count = 1300;
    struct Ring {
        const std::vector<unsigned>* from;
        std::vector<unsigned>* to;
        void operator()(int begin, int end, int) const {
            for (int i = begin; i < end; ++i) {
                const std::size_t before = std::size_t(i + size - 1) % size;
                const std::size_t after = std::size_t(i + 1) % size;
                (*to)[std::size_t(i)] = (*from)[before] * 3 + (*from)[after] + 1;
            }
        }
    };
    const auto run = [](int workers) {
        std::vector<unsigned> even(size, 1);
        std::vector<unsigned> odd(size, 0);
        const Ring to_odd = {&even, &odd};
        const Ring to_even = {&odd, &even};
        std::vector<TeamStage> stages;
        for (int k = 0; k < stage_count; ++k) {
            const int block_size = k % 7 == 0 ? size : 1 + k % 5;
            stages.emplace_back(size, block_size, k % 2 == 0 ? to_odd : to_even);
            if (k % 11 == 0) stages.emplace_back(0, 4, to_even);
        }
        const SharedScheduler scheduler = scheduler_of(workers);
        Team team(scheduler);
        team.run_stages(stages);
        return even;
    };
    const std::vector<unsigned> expected = run(1);
    for (const int workers : {2, 3, 4, 8}) {
        CAPTURE(workers);
        CHECK(run(workers) == expected);
    }
}

TEST_CASE("a stage is over for those who come late: the counts of all stages add up") {
    // Every kernel call checks that all of the earlier stages' blocks have ended.
    static constexpr int blocks = 13;
    std::atomic<int> ended{0};
    std::atomic<int> too_early{0};
    struct Check {
        int stage;
        std::atomic<int>* ended;
        std::atomic<int>* too_early;
        void operator()(int, int, int) const {
            const int sofar = ended->load();
            if (sofar < stage * blocks || sofar >= (stage + 1) * blocks) ++*too_early;
            ++*ended;
        }
    };
    std::vector<Check> checks;
    for (int k = 0; k < 600; ++k) checks.push_back({k, &ended, &too_early});
    std::vector<TeamStage> stages;
    for (const Check& check : checks) stages.emplace_back(blocks, 1, check);
    const SharedScheduler scheduler = scheduler_of(4);
    Team(scheduler).run_stages(stages);
    CHECK(too_early == 0);
    CHECK(ended == 600 * blocks);
}

TEST_CASE("no two calls that run at once have the same worker's number") {
    constexpr int workers = 4;
    const SharedScheduler scheduler = scheduler_of(workers);
    Team team(scheduler);
    std::array<std::atomic<bool>, workers> is_in = {};
    std::atomic<int> clashes{0};
    for (int run = 0; run < 200; ++run) {
        team.for_range(64, 1, [&](int, int, int worker) {
            if (is_in[std::size_t(worker)].exchange(true)) ++clashes;
            std::this_thread::yield();
            is_in[std::size_t(worker)].store(false);
        });
    }
    CHECK(clashes == 0);
}

TEST_CASE("ten thousand short runs in a row are each done") {
    const SharedScheduler scheduler = scheduler_of(3);
    std::vector<int> sums(12, 0);
    const auto add = [&](int begin, int end, int) {
        for (int i = begin; i < end; ++i) ++sums[std::size_t(i)];
    };
    const std::vector<TeamStage> stages = {TeamStage(12, 4, add), TeamStage(12, 5, add)};
    for (int run = 0; run < 5000; ++run) {
        // Now within one team, now each with its own.
        Team team(scheduler);
        team.for_range(12, 2, add);
        team.run_stages(stages);
    }
    Team team(scheduler);
    for (int run = 0; run < 5000; ++run) team.for_range(12, 2, add);
    CHECK(std::ranges::all_of(sums, [](int sum) { return sum == 20000; }));
}

TEST_CASE("own threads come when there is work, again after they have slept") {
    const SharedScheduler scheduler = scheduler_of(3);
    for (int round = 0; round < 3; ++round) {
        Gathering gathering = {.expected = 3};
        Team(scheduler).for_range(3, 1, gathering);
        CHECK(gathering.all_came());
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    // And in the midst of a team that had nothing for them for long.
    Team team(scheduler);
    Gathering first = {.expected = 3};
    team.for_range(3, 1, first);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    Gathering second = {.expected = 3};
    team.for_range(3, 1, second);
    CHECK(first.all_came());
    CHECK(second.all_came());
}

TEST_CASE("a range of one block is the caller's, and wakes nobody") {
    const SharedScheduler scheduler = scheduler_of(2);
    Team team(scheduler);
    const std::thread::id caller = std::this_thread::get_id();
    int calls = 0;
    const auto note = [&](int begin, int end, int worker) {
        calls += std::this_thread::get_id() == caller && begin == 0 && end == 5 && worker == 0;
    };
    team.for_range(5, 5, note);
    const std::vector<TeamStage> stages(9, TeamStage(5, 8, note));
    team.run_stages(stages);
    CHECK(calls == 10);
}

TEST_CASE("without a scheduler the caller does it all") {
    Team team(SharedScheduler{});
    CHECK(team.worker_count() == 1);
    CHECK(is_covered_once(team, 1000, 7));
    team.run_stages({});
    CHECK(!scheduler_of(0));
    CHECK(!scheduler_of(1));
}

TEST_CASE("whoever finds the scheduler busy is alone, and gets it when it is free") {
    const SharedScheduler scheduler = scheduler_of(2);
    {
        Team first(scheduler);
        Team second(scheduler);
        CHECK(first.worker_count() == 2);
        CHECK(second.worker_count() == 1);
        CHECK(is_covered_once(second, 100, 3));
        CHECK(is_covered_once(first, 100, 3));
    }
    CHECK(Team(scheduler).worker_count() == 2);
}

TEST_CASE("a kernel may have a team of its own, on any thread: it is alone") {
    const SharedScheduler scheduler = scheduler_of(3);
    Team team(scheduler);
    std::atomic<int> met{0};
    std::atomic<int> not_alone{0};
    team.for_range(40, 1, [&](int, int, int) {
        Team inner(scheduler);
        if (inner.worker_count() != 1) ++not_alone;
        inner.for_range(10, 3, [&](int begin, int end, int) { met += end - begin; });
    });
    CHECK(met == 400);
    CHECK(not_alone == 0);
}

TEST_CASE("two threads of the user share one scheduler, each gets its own result") {
    const SharedScheduler scheduler = scheduler_of(2);
    std::array<std::atomic<bool>, 2> is_right = {};
    const auto steps = [&](std::size_t user) {
        bool right = true;
        for (int step = 0; step < 300; ++step) {
            Team team(scheduler);
            right = is_covered_once(team, 50 + step, 4) && right;
        }
        is_right[user] = right;
    };
    std::thread other(steps, 1);
    steps(0);
    other.join();
    CHECK(is_right[0]);
    CHECK(is_right[1]);
}

TEST_CASE("more threads than cores get on") {
    // Eight workers, and two threads that never let go of a core.
    std::atomic<bool> is_over{false};
    const auto burn = [&] {
        while (!is_over.load(std::memory_order_relaxed)) {
        }
    };
    std::thread first(burn);
    std::thread second(burn);
    const SharedScheduler scheduler = scheduler_of(8);
    std::vector<int> sums(64, 0);
    const auto add = [&](int begin, int end, int) {
        for (int i = begin; i < end; ++i) ++sums[std::size_t(i)];
    };
    const std::vector<TeamStage> stages(100, TeamStage(64, 2, add));
    for (int step = 0; step < 5; ++step) Team(scheduler).run_stages(stages);
    is_over = true;
    first.join();
    second.join();
    CHECK(std::ranges::all_of(sums, [](int sum) { return sum == 500; }));
}

TEST_CASE("copies hold one scheduler, and so does a team for as long as it lasts") {
    SharedScheduler first = scheduler_of(2);
    SharedScheduler copy = first;
    CHECK(copy.get() == first.get());
    const Team team(first);
    CHECK(Team(copy).worker_count() == 1);
    first = SharedScheduler();
    CHECK(!first);
    CHECK(team.worker_count() == 2);
    SharedScheduler moved = std::move(copy);
    CHECK(moved);
}

TEST_CASE("a scheduler can end at any time when no team has it") {
    for (int i = 0; i < 100; ++i) {
        const SharedScheduler scheduler = scheduler_of(1 + i % 5);
        if (i % 3 == 0) continue;
        Team team(scheduler);
        CHECK(is_covered_once(team, 20 * (i % 4), 3));
    }
}

TEST_CASE("a count of threads out of range is an error that says the range") {
    for (const int count : {-1, 65, 2147483647}) {
        const auto result = make_scheduler({.count = count});
        REQUIRE(!result.ok());
        CHECK(result.error().message ==
              "threads.count is " + std::to_string(count) + ", allowed: 0 to 64");
    }
    CHECK(Team(scheduler_of(64)).worker_count() == 64);
}

// What would dangle does not compile.
using Temporary = decltype([](int, int, int) {});
static_assert(!std::is_constructible_v<TeamStage, int, int, Temporary>);
static_assert(!std::is_constructible_v<TeamStage, int, int, const Temporary>);
static_assert(std::is_constructible_v<TeamStage, int, int, Temporary&>);

namespace {

// Hosts, good and bad. The context counts the calls.
void run_forward(void* calls, int job_count, Job job, void* context) {
    ++*static_cast<int*>(calls);
    for (int i = 0; i < job_count; ++i) job(context, i);
}
void run_backward(void* calls, int job_count, Job job, void* context) {
    ++*static_cast<int*>(calls);
    for (int i = job_count - 1; i >= 0; --i) job(context, i);
}
void run_on_threads(void* calls, int job_count, Job job, void* context) {
    ++*static_cast<int*>(calls);
    std::vector<std::thread> threads;
    for (int i = 0; i < job_count; ++i) threads.emplace_back(job, context, i);
    for (std::thread& thread : threads) thread.join();
}
void run_nothing(void* calls, int, Job, void*) { ++*static_cast<int*>(calls); }
void run_with_wrong_indices(void* calls, int job_count, Job job, void* context) {
    ++*static_cast<int*>(calls);
    for (const int index : {-1, job_count, job_count + 1000}) job(context, index);
}

}  // namespace

TEST_CASE("a host's threads do the work, in whichever order it runs the jobs, or fails to") {
    for (const cairn::RunJobs run :
         {run_forward, run_backward, run_on_threads, run_nothing, run_with_wrong_indices}) {
        int calls = 0;
        const Threads threads = {.count = 3, .run = run, .host_context = &calls};
        const SharedScheduler scheduler = *make_scheduler(threads);
        Team team(scheduler);
        CHECK(team.worker_count() == 3);
        CHECK(is_covered_once(team, 1000, 7));
        CHECK(calls == 1);
        std::atomic<int> met{0};
        const auto add = [&](int begin, int end, int) { met += end - begin; };
        const std::vector<TeamStage> stages(20, TeamStage(30, 4, add));
        team.run_stages(stages);
        CHECK(met == 600);
        CHECK(calls == 2);
        // What is one block's work does not go to the host.
        team.for_range(30, 30, add);
        CHECK(calls == 2);
    }
}

TEST_CASE("jobs of a host that run at once share the work") {
    int calls = 0;
    const Threads threads = {.count = 2, .run = run_on_threads, .host_context = &calls};
    const SharedScheduler scheduler = *make_scheduler(threads);
    Gathering gathering = {.expected = 2};
    Team(scheduler).for_range(2, 1, gathering);
    CHECK(gathering.all_came());
}

TEST_CASE("a host of one thread is never called") {
    int calls = 0;
    const Threads threads = {.count = 1, .run = run_forward, .host_context = &calls};
    const SharedScheduler scheduler = *make_scheduler(threads);
    Team team(scheduler);
    CHECK(is_covered_once(team, 100, 7));
    CHECK(calls == 0);
}

#if defined(__SSE2__)

namespace {

constexpr unsigned round_up_and_flush = 0x1f80 | 0x8000 | 0x4000;

unsigned mode() { return _mm_getcsr() & ~0x3fu; }

// A host whose threads have modes of their own, which they must find again.
void run_on_odd_threads(void* changed, int job_count, Job job, void* context) {
    std::vector<std::thread> threads;
    for (int i = 0; i < job_count; ++i) {
        threads.emplace_back([=] {
            _mm_setcsr(round_up_and_flush);
            job(context, i);
            if (mode() != round_up_and_flush) ++*static_cast<std::atomic<int>*>(changed);
        });
    }
    for (std::thread& thread : threads) thread.join();
}

}  // namespace

TEST_CASE("kernels find the IEEE modes on every thread, whatever was set where it began") {
    std::atomic<int> changed{0};
    const unsigned before = _mm_getcsr();
    // Own threads inherit the modes of the thread that makes the scheduler.
    _mm_setcsr(round_up_and_flush);
    const std::array<SharedScheduler, 2> schedulers = {
        scheduler_of(3),
        *make_scheduler({.count = 3, .run = run_on_odd_threads, .host_context = &changed})};
    for (const SharedScheduler& scheduler : schedulers) {
        const cairn::FloatEnvironment ieee;
        Gathering gathering = {.expected = 3};
        std::atomic<int> odd{0};
        Team(scheduler).for_range(3, 1, [&](int begin, int end, int worker) {
            if (mode() != 0x1f80) ++odd;
            gathering(begin, end, worker);
        });
        CHECK(gathering.all_came());
        CHECK(odd == 0);
    }
    CHECK(mode() == round_up_and_flush);
    CHECK(changed == 0);
    _mm_setcsr(before);
}

#endif

#if CAIRN_THREADS

TEST_CASE("own threads leave the host's signals to the host's threads") {
    const SharedScheduler scheduler = scheduler_of(2);
    std::atomic<int> open_on_others{0};
    std::atomic<int> faults_blocked{0};
    Gathering gathering = {.expected = 2};
    Team(scheduler).for_range(2, 1, [&](int begin, int end, int worker) {
        sigset_t blocked;
        pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
        if (worker != 0) {
            open_on_others += sigismember(&blocked, SIGINT) == 0;
            open_on_others += sigismember(&blocked, SIGUSR1) == 0;
            faults_blocked += sigismember(&blocked, SIGSEGV) == 1;
        } else {
            faults_blocked += sigismember(&blocked, SIGUSR1) == 1;
        }
        gathering(begin, end, worker);
    });
    CHECK(gathering.all_came());
    CHECK(open_on_others == 0);
    CHECK(faults_blocked == 0);
}

#endif

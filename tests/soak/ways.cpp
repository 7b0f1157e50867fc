// Threads, lanes and broad phases; see ways.h.

#include "ways.h"

#include <atomic>
#include <thread>
#include <vector>

#include "user.h"

namespace cairn::soak {

namespace {

// Outlives every world.
std::atomic<std::uint64_t> host_runs = 0;

void run_backwards(void* runs, int count, Job job, void* context) {
    ++*static_cast<std::atomic<std::uint64_t>*>(runs);
    for (int i = count; i-- > 0;) job(context, i);
}

// A thread a job, as the simplest of hosts would.
void run_on_threads(void* runs, int count, Job job, void* context) {
    ++*static_cast<std::atomic<std::uint64_t>*>(runs);
    std::vector<std::thread> threads;
    for (int i = 0; i < count; ++i) threads.emplace_back(job, context, i);
    for (std::thread& thread : threads) thread.join();
}

std::vector<std::uint64_t> follow(World& world, int steps) {
    std::vector<std::uint64_t> hashes;
    for (int step = 0; step < steps; ++step) {
        (void)world.step(dt);
        hashes.push_back(world.state_hash());
    }
    return hashes;
}

}  // namespace

void change_way(World& world, Dice& dice) {
    Threads threads{.count = 1 + dice.below(4), .host_context = &host_runs};
    const int whose = dice.below(4);
    if (whose == 0) threads.run = run_backwards;
    if (whose == 1) threads.run = run_on_threads;
    (void)world.set_threads(threads);
    (void)world.set_trace(dice.one_in(3) ? 500 : 0);
    WorldSettings settings = world.settings();
    constexpr int lanes[] = {0, 1, 4, 8, 16};
    settings.step.lanes = lanes[dice.below(5)];
    settings.step.broad_phase = dice.one_in(3) ? BroadPhase::BruteForce : BroadPhase::Tree;
    (void)world.set_settings(settings);
}

std::uint64_t host_run_count() { return host_runs; }

const char* step_together(World& world, Dice& dice) {
    change_way(world, dice);
    const int steps = 4 + dice.below(8);
    std::vector<std::uint64_t> first, second;
    {
        // Each copy goes, and lets go of the threads, on the thread that steps it.
        std::thread one([&, copy = world]() mutable { first = follow(copy, steps); });
        std::thread other([&, copy = world]() mutable { second = follow(copy, steps); });
        const std::vector<std::uint64_t> own = follow(world, steps);
        one.join();
        other.join();
        if (first != own || second != own) return "worlds that share threads disturb each other";
    }
    return nullptr;
}

}  // namespace cairn::soak

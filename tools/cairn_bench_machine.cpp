// Asks the system, and plays ping-pong between two cores.

#include "cairn_bench_machine.h"

#include <pthread.h>
#include <sched.h>
#include <sys/utsname.h>
#include <time.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <limits>
#include <thread>
#include <vector>

namespace cairn::tool {

namespace {

std::vector<int> list_cores() {
    cpu_set_t set;
    CPU_ZERO(&set);
    std::vector<int> cores;
    if (sched_getaffinity(0, sizeof set, &set) != 0) return cores;
    for (int core = 0; core < CPU_SETSIZE; ++core) {
        if (CPU_ISSET(core, &set)) cores.push_back(core);
    }
    return cores;
}

void pin_to(int core) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(core, &set);
    pthread_setaffinity_np(pthread_self(), sizeof set, &set);
}

// A word that the two players have to themselves.
struct alignas(256) Ball {
    std::atomic<std::uint32_t> value = 0;
};

}  // namespace

std::string name_processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    }
    utsname names{};
    uname(&names);
    return names.machine;
}

std::string name_system() {
    utsname names{};
    uname(&names);
    return names.sysname;
}

unsigned count_cores() { return static_cast<unsigned>(list_cores().size()); }

std::string name_today() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[16];
    std::strftime(text, sizeof text, "%Y-%m-%d", &parts);
    return text;
}

std::optional<double> measure_core_latency() {
    // The shortest of many short rounds: a longer one meets whatever else the machine is doing.
    constexpr std::uint32_t rounds = 40;
    constexpr std::uint32_t trips = 500;
    const std::vector<int> cores = list_cores();
    if (cores.size() < 2) return {};
    Ball ball;
    const auto await = [&](std::uint32_t value) {
        while (ball.value.load(std::memory_order_acquire) != value) {
        }
    };
    std::thread partner([&] {
        pin_to(cores[1]);
        for (std::uint32_t i = 0; i < rounds * trips; ++i) {
            await(2 * i + 1);
            ball.value.store(2 * i + 2, std::memory_order_release);
        }
    });
    double shortest = std::numeric_limits<double>::infinity();
    std::thread player([&] {
        pin_to(cores[0]);
        for (std::uint32_t round = 0; round < rounds; ++round) {
            const auto begin = std::chrono::steady_clock::now();
            for (std::uint32_t i = round * trips; i < (round + 1) * trips; ++i) {
                ball.value.store(2 * i + 1, std::memory_order_release);
                await(2 * i + 2);
            }
            const std::chrono::duration<double, std::nano> taken =
                std::chrono::steady_clock::now() - begin;
            shortest = std::min(shortest, taken.count() / (2 * trips));
        }
    });
    player.join();
    partner.join();
    return shortest;
}

}  // namespace cairn::tool

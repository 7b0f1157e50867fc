// Times the pyramid in Cairn and in the peers that were there when this was built, and prints a
// table in Markdown: time beside what stands for quality, since speed without it says nothing.
//
//   cairn_bench [--rounds N] [--steps N] [--base N]
//
// The engines take turns (A B C D, A B C D, ...), each with a fresh world, so that a machine that
// slows down slows them all. One thread. The time is the median over the rounds of the mean step,
// the first left out.

#include <sys/utsname.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

#include "measure.h"
#include "scenes.h"

namespace {

using namespace cairn::bench;

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    }
    utsname names{};
    uname(&names);
    return names.machine;
}

std::vector<EngineEntry> all_engines() {
    std::vector<EngineEntry> engines = cairn_engines();
#ifdef CAIRN_BENCH_BULLET
    for (const EngineEntry& engine : bullet_engines()) engines.push_back(engine);
#endif
#ifdef CAIRN_BENCH_ODE
    for (const EngineEntry& engine : ode_engines()) engines.push_back(engine);
#endif
    return engines;
}

void print_table(const std::vector<EngineEntry>& engines,
                 const std::vector<std::vector<Run>>& runs) {
    std::printf(
        "| engine | budget | processor ms a step: median (least to most) | ratio | wall ms | top "
        "box drifted by | deepest penetration | kinetic energy |\n");
    std::printf("|---|---|---|---|---|---|---|---|\n");
    double reference = 0;
    for (std::size_t i = 0; i < engines.size(); ++i) {
        std::vector<double> wall;
        std::vector<double> cpu;
        for (const Run& run : runs[i]) {
            wall.push_back(run.wall_ms);
            cpu.push_back(run.cpu_ms);
        }
        const Spread time = spread_of(cpu);
        if (i == 0) reference = time.median;
        const Run& last = runs[i].back();
        std::printf(
            "| %s | %s | %.2f (%.2f to %.2f) | %.2f | %.2f | %.1f mm | %.2f mm | %.3g J |\n",
            engines[i].name.c_str(), engines[i].setting.c_str(), time.median, time.least, time.most,
            time.median / reference, spread_of(wall).median, 1000 * last.top_drift,
            1000 * last.deepest_penetration, last.kinetic_energy);
    }
}

}  // namespace

int main(int argc, char** argv) {
    int rounds = 7;
    int steps = 300;
    int base = 20;
    for (int i = 1; i < argc; i += 2) {
        const std::string_view name = argv[i];
        int* const target = name == "--rounds"  ? &rounds
                            : name == "--steps" ? &steps
                            : name == "--base"  ? &base
                                                : nullptr;
        const int value = i + 1 < argc ? std::atoi(argv[i + 1]) : 0;
        if (target == nullptr || value < 1) {
            std::fprintf(stderr,
                         "usage: cairn_bench [--rounds N] [--steps N] [--base N], N >= 1\n");
            return 2;
        }
        *target = value;
    }
    if (steps < 2) steps = 2;

    const BenchScene scene = make_pyramid(base);
    const std::vector<EngineEntry> engines = all_engines();
    std::vector<std::vector<Run>> runs(engines.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < engines.size(); ++i) {
            std::fprintf(stderr, "\rround %d of %d: %-40s", round + 1, rounds,
                         engines[i].name.c_str());
            runs[i].push_back(run_scene(engines[i], scene, steps));
        }
    }
    std::fprintf(stderr, "\n");

    std::printf("# %s, %d steps of 1/60 s\n\n", scene.name.c_str(), steps);
    std::printf(
        "On %s, compiler %s, one thread, no sleeping, friction %.1f, %d rounds by turns.\n\n",
        processor_name().c_str(), __VERSION__, scene.friction, rounds);
    print_table(engines, runs);
    return 0;
}

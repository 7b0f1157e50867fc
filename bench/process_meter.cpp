// The peak is read from /proc and not from getrusage, whose figure for a program that was just
// started includes the memory of the one that started it.

#include "process_meter.h"

#include <time.h>

#include <fstream>
#include <string>

namespace cairn::bench {

namespace {

double read_clock(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::int64_t read_status(const std::string& field) {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);) {
        if (line.rfind(field, 0) == 0) return std::stoll(line.substr(field.size()));
    }
    return 0;
}

}  // namespace

double wall_seconds() { return read_clock(CLOCK_MONOTONIC); }

double processor_seconds() { return read_clock(CLOCK_PROCESS_CPUTIME_ID); }

std::int64_t resident_kib() { return read_status("VmRSS:"); }

std::int64_t peak_resident_kib() { return read_status("VmHWM:"); }

void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5\n"; }

}  // namespace cairn::bench

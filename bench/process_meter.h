#pragma once
// Clocks and memory of this process, as Linux tells them.

#include <cstdint>

namespace cairn::bench {

/// Seconds since some moment.
double wall_seconds();
/// Seconds of processor time, over all threads.
double processor_seconds();

/// KiB of this program in memory now; 0 where the system does not say.
std::int64_t resident_kib();
/// KiB at most since `forget_peak`, or since the program began where that is not to be had.
std::int64_t peak_resident_kib();
void forget_peak();

}  // namespace cairn::bench

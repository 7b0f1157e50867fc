#pragma once
// The machine that a benchmark runs on.

#include <optional>
#include <string>

namespace cairn::tool {

std::string name_processor();
std::string name_system();
unsigned count_cores();
/// UTC, YYYY-MM-DD.
std::string name_today();

/// How long a word that one core writes takes to reach another, ns, one way: half of the shortest
/// round trip. Nothing where this process may use one core only. Takes some milliseconds.
std::optional<double> measure_core_latency();

}  // namespace cairn::tool

#pragma once
// A program run to its end, with what it printed and how it went.

#include <string>
#include <vector>

namespace cairn::tool {

struct ProcessOutcome {
    std::string out;      // all of standard output
    std::string err;      // the last 4 KiB of standard error
    std::string problem;  // empty where it ended by itself with status 0
};

/// Waits for it. Whatever it does, crashing and hanging included, becomes an outcome. `seconds` is
/// how long it may take.
ProcessOutcome run_process(const std::string& program, const std::vector<std::string>& arguments,
                           int seconds);

}  // namespace cairn::tool

#pragma once
// `cairn bench`: each scene in each engine that is there, in turn, each run in a process of its
// own.

#include <optional>
#include <string>
#include <vector>

#include "cairn/result.h"

namespace cairn::tool {

struct BenchCommand {
    std::vector<std::string> scenes;  // none: every scene, and the memory of each engine
    std::string threads = "1";        // counts, with commas
    std::string peers = "all";        // all, none, or names with commas
    int repeats = 3;
    std::optional<int> steps;  // nothing: each scene's own
    int time_limit = 600;      // s a run; what takes longer is ended
    bool memory = false;       // bytes a body too
    std::string json;          // a path, "-", or empty
    std::string html;          // a path, or empty
};

/// Returns the exit status.
int bench(const BenchCommand& command);

}  // namespace cairn::tool

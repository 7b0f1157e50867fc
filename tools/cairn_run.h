#pragma once
// `cairn run`: a scene, simulated.

#include <string>
#include <vector>

#include "scene/run.h"

namespace cairn::tool {

struct RunCommand {
    std::string scene;
    std::vector<std::string> settings;  // of a built-in scene, key=value
    scene::RunOptions options;
    std::int64_t threads = 1;
    std::int64_t lanes = 0;  // 0: as many as the processor can
    std::string json;        // a path, "-", or empty
    std::string replay;      // a path, or empty
    std::string trace;       // a path, or empty
    bool quiet = false;
};

/// A file, standard input or a built-in scene; the error says which and what is wrong.
Result<scene::Scene> load_scene(const std::string& source,
                                const std::vector<std::string>& settings);

/// Returns the exit status.
int run(const RunCommand& command);

}  // namespace cairn::tool

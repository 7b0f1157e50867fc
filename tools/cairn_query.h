#pragma once
// `cairn query`: what rays meet in a scene, what is near a point, which bodies are in a box.

#include <cstdint>
#include <string>
#include <vector>

namespace cairn::tool {

struct QueryCommand {
    std::string scene;
    std::vector<std::string> settings;  // of a built-in scene, key=value
    std::int64_t steps = 0;             // to take before the questions
    // Numbers with commas between them.
    std::vector<std::string> rays;    // origin, direction, length or not
    std::vector<std::string> points;  // position, reach or not
    std::vector<std::string> boxes;   // lower and upper corner
    bool all = false;                 // all that a ray meets, not only the first
};

/// Prints the answers as JSON on standard output; returns the exit status.
int query(const QueryCommand& command);

}  // namespace cairn::tool

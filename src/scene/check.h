#pragma once
// The doctor: what in a valid scene will misbehave, where, and what cures it.

#include <string>
#include <vector>

#include "scene/scene.h"

namespace cairn::scene {

struct Finding {
    std::string where;  ///< a path, or the names of bodies
    std::string what;
    std::string cure;
};

/// Findings in the order world, bodies, contacts; alike ones are told once, with how many more
/// there are. An error where the scene does not make a world at all.
Result<std::vector<Finding>> find_misbehaviour(const Scene& scene);

}  // namespace cairn::scene

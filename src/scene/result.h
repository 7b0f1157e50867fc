#pragma once
// Pieces of the result file that are written while a run goes on.

#include <string>

#include "scene/scene.h"

namespace cairn::scene {

/// Appends one element of "samples" to `samples`, with a comma before it where it is not the first.
void append_sample(std::string& samples, const BuiltWorld& built, double time);

}  // namespace cairn::scene

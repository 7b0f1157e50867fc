#pragma once
// The scenes that the program carries with it: one table, each scene with its parameters.
//
// A built-in scene is an ordinary Scene; `cairn export` writes it as a file. Their construction
// uses square roots, the library's own sine and cosine, and PCG32, so a scene is the same on every
// machine.

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace cairn::scene {

struct Parameter {
    const char* name;
    double standard;  // what it is unless told otherwise
    double least;
    double most;
    bool is_whole;
    const char* meaning;
};

struct Builtin {
    const char* name;
    const char* line;  // what it is
    const char* look;  // what to look at
    std::span<const Parameter> parameters;
    Scene (*make)(std::span<const double> values);  // in the order of the parameters
};

std::span<const Builtin> builtins();
/// Null where no built-in scene has that name.
const Builtin* find_builtin(std::string_view name);
/// The built-in name that was likely meant; empty where none is near.
std::string_view find_nearest_builtin(std::string_view name);

/// A built-in scene with some parameters set, each "key=value". A bad key or value is an error that
/// lists the parameters with their ranges.
Result<Scene> make_builtin(const Builtin& builtin, std::span<const std::string> settings);
/// "base=20 (1 to 200, whole): boxes in the lowest row", one line a parameter.
std::vector<std::string> describe_parameters(const Builtin& builtin);

}  // namespace cairn::scene

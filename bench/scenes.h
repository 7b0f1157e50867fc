#pragma once
// The scenes of the benchmark: their names, how long each runs unless told otherwise, and how each
// is made. The makers are in scenes_stacks.cpp (what should stand), scenes_heaps.cpp (what falls
// into a heap) and scenes_worlds.cpp (what is large, and mostly still).

#include <span>
#include <string_view>

#include "scene.h"

namespace cairn::bench {

struct SceneEntry {
    const char* name;
    const char* line;  // what it is, for a list
    int steps;
    BenchScene (*make)();
    bool is_memory_probe = false;  // asked for its bytes a body, not for its time
};

std::span<const SceneEntry> scene_entries();
/// Null where there is none of that name.
const SceneEntry* find_scene(std::string_view name);

BenchScene make_pyramid20();
BenchScene make_pyramid40();
BenchScene make_large_pyramid();
BenchScene make_many_pyramids();
BenchScene make_pyramids_30k();
BenchScene make_pyramids_100k();
BenchScene make_wide_pyramid();
BenchScene make_grid1000();
BenchScene make_tower();
BenchScene make_tower_heavy();
BenchScene make_seesaw();

BenchScene make_spheres5000();
BenchScene make_spheres10000();
BenchScene make_mixed4096();
BenchScene make_capsules1000();
BenchScene make_washer();

BenchScene make_large_world();
BenchScene make_field();
BenchScene make_field_one();
BenchScene make_static_boxes();
BenchScene make_moving_boxes();

}  // namespace cairn::bench

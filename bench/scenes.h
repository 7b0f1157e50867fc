#pragma once
// The scenes of the benchmark.

#include "engine.h"

namespace cairn::bench {

// A two-dimensional pyramid of unit cubes, `base` of them in the lowest row, on a large box: rows
// touch, neighbours in a row are 1 cm apart. Base 20 makes 210.
BenchScene make_pyramid(int base);

}  // namespace cairn::bench

#pragma once
// The scenes by which builds are held to the same bits, each written once: for the test of every
// native build (golden.cpp) and for the program that also runs where that test cannot
// (program/hash_scenes.cpp). What each is for stands at its functions in golden_scenes.cpp.
//
// A scene is made through the public face alone and follows from indices alone: no random numbers,
// no file, nothing whose result a compiler or a C++ library may choose.

#include <span>

#include "cairn/cairn.h"

namespace cairn::test {

struct GoldenScene {
    const char* name;
    int steps;
    void (*build)(World& world);
    // What the user does before a step, counted from 0; null where that is nothing.
    void (*before_step)(World& world, int step);
};

inline constexpr double golden_dt = 1.0 / 60;

std::span<const GoldenScene> golden_scenes();

}  // namespace cairn::test

#pragma once
// What a world can be told about how to step. Every setting can be changed between two steps.

#include <cstdint>

#include "cairn/types.h"

namespace cairn {

/// How constraints are met.
enum class Solver : std::uint8_t {
    SequentialImpulse,  ///< velocities by projected Gauss-Seidel, positions corrected after
    Xpbd,               ///< positions corrected in many substeps, velocities derived
};

/// How the axis between two convex polyhedra is found.
enum class NarrowPhase : std::uint8_t {
    Sat,     ///< the separating axis test over face normals and edge pairs
    GjkEpa,  ///< GJK for distance, EPA for penetration
};

/// How pairs are found.
enum class BroadPhase : std::uint8_t {
    BruteForce,  ///< every box against every other: the reference
};

struct StepSettings {
    Solver solver = Solver::SequentialImpulse;
    int substeps = 0;    ///< 1 to 1000; 0: the solver's own default (1; XPBD 20)
    int iterations = 0;  ///< 1 to 1000; 0: the solver's own default (10; XPBD 1)
    NarrowPhase narrow_phase = NarrowPhase::Sat;
    BroadPhase broad_phase = BroadPhase::BruteForce;
    float contact_compliance = 0;  ///< XPBD only: how much a contact gives, m/N, >= 0
    friend constexpr bool operator==(const StepSettings&, const StepSettings&) = default;
};

/// What a solver runs with where the settings leave substeps or iterations at 0.
int default_substeps(Solver solver);
int default_iterations(Solver solver);

struct WorldSettings {
    Vec3 gravity = {0, -9.81f, 0};       ///< m/s^2
    float restitution_threshold = 1.0f;  ///< m/s, >= 0: slower impacts do not bounce
    StepSettings step = {};
    friend constexpr bool operator==(const WorldSettings&, const WorldSettings&) = default;
};

}  // namespace cairn

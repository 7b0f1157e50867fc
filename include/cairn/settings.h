#pragma once
// What a world can be told about how to step. Every setting can be changed between two steps.

#include <cstdint>

#include "cairn/types.h"

namespace cairn {

/// How constraints are met.
enum class Solver : std::uint8_t {
    SequentialImpulse,  ///< velocities by projected Gauss-Seidel, positions corrected after
    SoftStep,           ///< velocities in substeps, contacts first springs, then rigid
    Xpbd,               ///< positions corrected in many substeps, velocities derived
};

/// How the axis between two convex polyhedra is found.
enum class NarrowPhase : std::uint8_t {
    Sat,     ///< the separating axis test over face normals and edge pairs
    GjkEpa,  ///< GJK for distance, EPA for penetration
};

/// How pairs are found.
enum class BroadPhase : std::uint8_t {
    Tree,        ///< trees of fat boxes, looked up only for what has left its box
    BruteForce,  ///< every box against every other: the reference
};

struct StepSettings {
    Solver solver = Solver::SoftStep;
    /// 1 to 1000; 0: the solver's own default (soft step 4, sequential impulses 1, XPBD 20).
    int substeps = 0;
    /// 1 to 1000; 0: the solver's own default (sequential impulses 10, the others 1).
    int iterations = 0;
    NarrowPhase narrow_phase = NarrowPhase::Sat;
    /// Never changes a result.
    BroadPhase broad_phase = BroadPhase::Tree;
    /// Whether contacts are carried along while their bodies hardly move against each other, rather
    /// than found anew each step. Changes a result by rounding's order.
    bool reuse_contacts = true;
    float contact_compliance = 0;  ///< XPBD only: how much a contact gives, m/N, >= 0
    /// Soft step only: at most so many contacts side by side, 1 to 1024; 0: as many as the
    /// processor can. Never changes a result.
    int lanes = 0;
    friend constexpr bool operator==(const StepSettings&, const StepSettings&) = default;
};

/// What a solver runs with where the settings leave substeps or iterations at 0.
int default_substeps(Solver solver);
int default_iterations(Solver solver);

struct WorldSettings {
    Vec3 gravity = {0, -9.81f, 0};       ///< m/s^2
    float restitution_threshold = 1.0f;  ///< m/s, >= 0: slower impacts do not bounce
    /// Whether bodies that stand still, and all that touches them, are left out of the step until
    /// something comes near or is changed.
    bool sleeping = true;
    /// s, > 0: how long bodies must have stood still before they sleep. What still moves by a
    /// thousandth of its size a second, or gathers speed, never does.
    float sleep_time = 0.5f;
    StepSettings step = {};
    friend constexpr bool operator==(const WorldSettings&, const WorldSettings&) = default;
};

}  // namespace cairn

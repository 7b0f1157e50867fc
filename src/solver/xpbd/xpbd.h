#pragma once
// XPBD for rigid bodies: many small substeps, each of which predicts, corrects positions, and takes
// velocities from the corrections.
//
// One substep of length h:
//   impacts             bounces as a velocity pass, before any force acts (solver/impact.h)
//   predict             v += h a, and the friction that the last substep ended with, as far as the
//                       load was steady; x += h v;
//                       w += h I^-1 torque, free rotation
//   correct positions   C = s where s < 0: dl = (-C - a l) / (K(n) + a), a = compliance/h^2, l >= 0
//                       summed from zero over the substep, the points of a manifold together
//   velocities          v += dx/h, w += dtheta/h for the corrections dx, dtheta
//   velocity pass       the speed along n that the corrections made or left is taken away;
//                       friction, static and dynamic, brings the sliding to rest as far as
//                       |l_t| <= mu l allows; again where that stirred others up
//
// Corrections are kept apart from the prediction, so velocities never come from a difference of
// rounded positions; both bodies are corrected at one common point, so momentum is conserved.
//
// Source: Mueller, Macklin, Chentanez, Jeschke, Kim, "Detailed Rigid Body Simulation with Extended
// Position Based Dynamics", SCA 2020. Departures:
// - static friction acts in the velocity pass, as one law with the dynamic one, and begins where it
//   ended. A positional friction sees the sliding that one unfinished sweep leaves, and its torque
//   makes a column of two boxes sway by itself; and since friction turns what stands on it, the
//   prediction must know it, or the next normals turn it back and a block creeps down its slope.
// - the circle in place of all or nothing, which also mends the published bound h mu f_n, lacking
//   its factor w_1 + w_2; rotation by exponential map.
// - an overlap with which two shapes meet is removed at a limited speed.
// Normal multipliers do begin at zero: carried over, they and the positions drive each other.

#include <vector>

#include "solver/contact_rows.h"
#include "solver/impact.h"

namespace cairn {

class Xpbd {
public:
    static constexpr int default_substeps = 20;
    static constexpr int default_iterations = 1;

    void advance(const StepProblem& problem);

private:
    struct Correction {
        Vec3 linear;
        Vec3 angular;
    };
    // Multipliers of one substep, in kg m (impulse times h), and what they answer.
    struct Multipliers {
        std::array<float, 4> normal = {};
        std::array<Vec3, 4> friction = {};
        Vec3 rolling;
        float spinning = 0;
        std::array<float, 4> separation = {};  // after the prediction
        std::array<float, 4> gap = {};         // what the corrections have left of it
        std::array<float, 4> approach = {};    // n.v_rel before the substep's forces
    };

    // What the last substep ended with, one entry a row set: friction multipliers, the sum of the
    // normal ones, and that of the substep before it.
    struct Held {
        std::array<Vec3, 4> friction = {};
        float load = 0;
        float load_before = 0;
    };

    void recall(const StepProblem& problem, float h);
    void warm_start(const StepProblem& problem, float h);
    void predict(const StepProblem& problem, float h);
    void measure(const StepProblem& problem, float h);
    void correct_positions(const StepProblem& problem, float h);
    void derive_velocities(const StepProblem& problem, float h);
    void solve_velocities(const StepProblem& problem, float h);
    // One row set of the velocity pass; whether it changed enough for another sweep.
    bool solve_velocity(const StepProblem& problem, std::size_t k, float h, int sweep);
    // Returns the largest change of a point's speed along the normal, m/s.
    float quiet_normals(const StepProblem& problem, std::size_t k, float h);
    void rub_points(const StepProblem& problem, std::size_t k, float h);
    void rub_turning(const StepProblem& problem, std::size_t k, float h);
    void store_impulses(const StepProblem& problem, float h, bool first);

    std::vector<ContactRows> rows_;
    std::vector<Multipliers> multipliers_;
    std::vector<Held> held_;
    std::vector<Response> responses_;
    std::vector<Correction> corrections_;
    std::vector<int> stirred_in_;  // the sweep of the velocity pass that last stirred the body
    ImpactSolver impacts_;
};

}  // namespace cairn

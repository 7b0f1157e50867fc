#pragma once
// XPBD for rigid bodies: many small substeps, each of which predicts, corrects positions, and takes
// velocities from the corrections.
//
// One substep of length h:
//   impacts              bounces as a velocity pass, before any force acts (solver/impact.h)
//   predict              v += h a, x += h v; w += h I^-1 torque, free rotation
//   correct positions    C = s where s < 0: dl = (-C - a l) / (K(n) + a), a = compliance/h^2, l >=
//   0 summed
//                        over the substep; static friction at once after it: the sliding since the
//                        substep began is taken back by l_t, |l_t| <= mu l
//   velocities           v += dx/h, w += dtheta/h for the corrections dx, dtheta
//   velocity pass        the speed that pushing out has made is taken away; dynamic friction, with
//   what
//                        is left of mu l
//
// Corrections are kept apart from the prediction, so velocities never come from a difference of
// rounded positions; both bodies are corrected at one common point, so momentum is conserved.
//
// Source: Mueller, Macklin, Chentanez, Jeschke, Kim, "Detailed Rigid Body Simulation with Extended
// Position Based Dynamics", SCA 2020. Departures: friction on a circle, accumulated, in place of
// all or nothing (its dynamic bound h mu f_n lacks the factor w_1 + w_2, which the accumulated form
// does not need); rotation by exponential map; an overlap from before the substep is removed at a
// limited speed.

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
    // Multipliers of one substep, in kg m (impulse times h).
    struct Multipliers {
        std::array<float, 4> normal = {};
        std::array<Vec3, 4> friction = {};
        Vec3 rolling;
        float spinning = 0;
        std::array<float, 4> separation = {};  // after the prediction
        std::array<Vec3, 4> slip = {};         // sliding of B's point along A's in this substep
        std::array<float, 4> approach = {};    // n.v_rel before the substep's forces
    };

    void predict(const StepProblem& problem, float h);
    void measure(const StepProblem& problem, float h);
    void correct_positions(const StepProblem& problem, float h, bool backward);
    void derive_velocities(const StepProblem& problem, float h);
    void solve_velocities(const StepProblem& problem, float h);
    void store_impulses(const StepProblem& problem, float h, bool first);

    std::vector<ContactRows> rows_;
    std::vector<Multipliers> multipliers_;
    std::vector<Response> responses_;
    std::vector<Correction> corrections_;
    ImpactSolver impacts_;
};

}  // namespace cairn

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

#include "base/large_array.h"
#include "solver/contact_rows.h"
#include "solver/impact.h"
#include "solver/row_sweeps.h"
#include "solver/swept_bodies.h"

namespace cairn {

class Xpbd {
public:
    static constexpr int default_substeps = 20;
    static constexpr int default_iterations = 1;

    void advance(const StepProblem& problem);

private:
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

    // What the last substep ended with: friction multipliers, the sum of the normal ones, and that
    // of the substep before it; and what goes on through the step.
    struct Held {
        std::array<Vec3, 4> friction = {};
        float load = 0;
        float load_before = 0;
        float first_overlap = 0;  // see Contact
        float push_speed = 0;     // m/s at which it is removed
    };
    // Sums of the multipliers over the step.
    struct Totals {
        std::array<float, 4> normal = {};
        std::array<Vec3, 4> friction = {};
        Vec3 rolling;
        float spinning = 0;
    };
    struct Course {
        Quat known_rotation;      // when the masses of its contacts' friction were found
        bool turned_far = false;  // since then, when the substep began
    };

    void begin_step(const StepProblem& problem, float h);
    void predict(const StepProblem& problem, float h, bool first);
    void correct_positions(const StepProblem& problem, float h);
    void solve_velocities(const StepProblem& problem, float h);

    // Of one body.
    void move_body(const StepProblem& problem, std::uint32_t body, float h);
    void derive_velocity(const StepProblem& problem, std::uint32_t body, float h);
    void store_velocity(const StepProblem& problem, std::uint32_t body);

    // Of one row set, k.
    void recall(const StepProblem& problem, std::size_t k, float h);
    void begin_row(const StepProblem& problem, std::size_t k);
    void find_approach(const StepProblem& problem, std::size_t k);
    void warm_start(std::size_t k, float h);
    void measure(const StepProblem& problem, std::size_t k, float h);
    void correct_row(std::size_t k, float compliance);
    // Whether it changed enough for another sweep.
    bool solve_velocity(const StepProblem& problem, std::size_t k, float h, int sweep);
    // Returns the largest change of a point's speed along the normal, m/s.
    static float quiet_normals(const ContactRows& row, Multipliers& sum, float h, SweptPair& pair);
    static void rub_points(const ContactRows& row, Multipliers& sum, float h, SweptPair& pair);
    static void rub_turning(const ContactRows& row, Multipliers& sum, float h, SweptPair& pair);
    void hold(std::size_t k);
    void store_impulses(const StepProblem& problem, std::size_t k, float h, float share);

    RowSweeps sweeps_;
    // One entry a row set, and perhaps some that are of no meaning.
    LargeArray<ContactRows> rows_;
    LargeArray<Multipliers> multipliers_;
    LargeArray<Held> held_;
    LargeArray<Totals> totals_;
    // One entry a body, likewise.
    std::vector<Response> responses_;
    LargeArray<SweptBody> bodies_;
    LargeArray<Correction> corrections_;
    LargeArray<int> stirred_in_;  // the sweep of the velocity pass that last stirred the body
    LargeArray<Course> courses_;
    ImpactSolver impacts_;
};

}  // namespace cairn

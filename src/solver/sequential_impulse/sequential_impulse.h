#pragma once
// Sequential impulses: contact velocities by projected Gauss-Seidel over accumulated impulses, warm
// started from the last step, then overlap removed on positions alone.
//
// One substep of length h:
//   impacts                 bounces, before any force acts (solver/impact.h)
//   velocities              v += h a, w += h I^-1 torque
//   warm start              the last substep's impulses; for new contacts, the weight that they
//                           will bear (first_guess.h)
//   iterations, each:       friction of every contact, then its normal impulses, the points of a
//                           manifold together; sweeps go to and fro; between two, a step along the
//                           conjugate direction
//   poses                   x += h v, free rotation
//   positional correction   pseudo impulses on poses; velocities never learn of it
//
// Rows at a point: n.v_rel >= -max(s, 0)/h with impulse l >= 0; across the normal |l_t| <= mu l
// against v_t, on a circle: l_t <- clamp(l_t - m_t v_t), with one mass m_t for all directions,
// whose fixed point opposes the sliding exactly (a 2x2 block solve would favour the stiff one).
//
// Conjugate directions: with d the change of a sweep, in the norm of J (change squared over the
// row's mass), beta = |d|^2 / |d_before|^2; the next direction is beta times the last plus d, and
// the impulses move on by beta times the last. A beta above 1 starts anew.
//
// Sources: Catto, "Iterative Dynamics with Temporal Coherence", GDC 2005, and "Modeling and Solving
// Constraints", GDC 2009; Silcowitz, Niebuhr, Erleben, "A Nonsmooth Nonlinear Conjugate Gradient
// Method for Interactive Contact Force Problems", The Visual Computer 2010. Departures: the circle,
// the manifolds as blocks, the even sharing of loads, the first guess, restitution apart.

#include <vector>

#include "base/large_array.h"
#include "solver/contact_rows.h"
#include "solver/first_guess.h"
#include "solver/impact.h"
#include "solver/row_sweeps.h"
#include "solver/swept_bodies.h"

namespace cairn {

class SequentialImpulse {
public:
    static constexpr int default_substeps = 1;
    static constexpr int default_iterations = 10;

    void advance(const StepProblem& problem);

private:
    // The impulses (N s) of one row set.
    struct Impulses {
        std::array<float, 4> normal = {};
        std::array<Vec3, 4> friction = {};
        Vec3 rolling;
        float spinning = 0;

        // This plus s times the other.
        Impulses plus(float s, const Impulses& other) const {
            Impulses sum;
            for (std::size_t i = 0; i < 4; ++i) {
                sum.normal[i] = normal[i] + s * other.normal[i];
                sum.friction[i] = friction[i] + s * other.friction[i];
            }
            sum.rolling = rolling + s * other.rolling;
            sum.spinning = spinning + s * other.spinning;
            return sum;
        }
    };

    // How the sums move on between two sweeps.
    struct Extrapolation {
        float beta = 0;
        float squared = 0;  // of the last sweep, in J
        bool follows_sweep = false;
    };
    // What a row set carries through a substep: the sums, what the last sweep changed of them, and
    // the direction in which they move on between two sweeps.
    struct RowState {
        Impulses sum, change, direction;
        float remembered = 0;              // total normal force when the substep began, N
        std::array<float, 4> excess = {};  // overlap beyond the slop, m, before corrections
    };
    // A body's velocity before the last sweep, and its direction.
    struct Course {
        Vec3 v, w;
        Vec3 direction_v, direction_w;
    };

    void begin_substep(const StepProblem& problem, float h);
    void solve(const StepProblem& problem, float h);
    void move_bodies(const StepProblem& problem, float h);
    Extrapolation choose_extrapolation(const Extrapolation& last) const;
    static float square_in_joules(const ContactRows& row, const Impulses& impulses);
    void extrapolate_body(std::uint32_t body, float beta);

    // Of one row set, k.
    void recall(const StepProblem& problem, std::size_t k, float h);
    void warm_start(const StepProblem& problem, std::size_t k, float h);
    void solve_row(std::size_t k, float h, const Extrapolation& last);
    static void rub_points(const ContactRows& row, Impulses& sum, SweptPair& pair);
    static void rub_turning(const ContactRows& row, Impulses& sum, SweptPair& pair);
    static void solve_normal_rows(const ContactRows& row, float inverse_h, Impulses& sum,
                                  SweptPair& pair);
    void measure_overlap(const StepProblem& problem, std::size_t k);
    bool correct_row(std::size_t k);
    void store_impulses(const StepProblem& problem, std::size_t k, float h);

    RowSweeps sweeps_;
    // One entry a row set, and perhaps some that are of no meaning.
    std::size_t row_count_ = 0;
    LargeArray<ContactRows> rows_;
    LargeArray<RowState> states_;
    LargeArray<FirstGuess::Bearing> bearings_;  // what it is guessed to bear to begin with
    LargeArray<float> squares_;                 // of what the last sweep changed, in J
    // One entry a body, likewise.
    std::vector<Response> responses_;
    LargeArray<SweptBody> bodies_;
    LargeArray<Course> courses_;
    LargeArray<Correction> corrections_;
    FirstGuess first_guess_;
    ImpactSolver impacts_;
};

}  // namespace cairn

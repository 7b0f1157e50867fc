#pragma once
// Soft step: small substeps, in each of which contacts are first springs, then rigid.
//
// One substep of length h, of which there are more where bodies lie high on each other:
//   impacts      bounces, before any force acts (solver/impact.h)
//   velocities   v += h a, w += h I^-1 torque, what a tumbling body's spin makes of w, and the
//                impulses of the last substep once more
// and then, in one or several parts, each with its share of the way (choose_parts):
//   exact loads  for columns, whose loads pass through many contacts (exact_loads.h): before each
//                of the two sweeps, as soft or as rigid as that
//   solve        one sweep over the normals as stiff, heavily damped springs, which also push
//                overlaps out; a spring gives way only to what exceeds the load that its contact
//                remembers, so what rests does not sag
//   poses        x += (its share of h) v, and likewise the turn; bodies that meet nothing go all
//                at once and tumble as they go
//   relax        one sweep with rigid normals and without a push, which takes out the speed that
//                the springs gave; then friction, once a manifold, knowing the final load
//
// New contacts begin with the weight that they will have to bear (solver/first_guess.h), and
// remember it: what is put up does not sink before it is held.
//
// All contacts of a colour are solved side by side, in lanes; the rows are built once a step, and
// once more at a substep's beginning when a body has turned far from how they know it. Since
// arms and normals stay for a step, the impulses of one substep act on a body as one change of its
// velocity, so warm starting the next costs a sum a body and no sweep.
//
// Sources: Macklin et al., "Small Steps in Physics Simulation", SCA 2019; Catto, "Solver2D", 2024,
// whose soft contacts these are. Departures: the remembered load (an augmented Lagrangian's
// multiplier beside the penalty), exact loads, manifolds as rigid frames (soft_row.h), friction
// on a sphere with the twist, restitution apart and first.

#include <deque>
#include <vector>

#include "solver/contact_rows.h"
#include "solver/first_guess.h"
#include "solver/impact.h"
#include "solver/soft_step/build_rows.h"
#include "solver/soft_step/exact_loads.h"

namespace cairn {

class SoftStep {
public:
    static constexpr int default_substeps = 4;
    static constexpr int default_iterations = 1;

    void advance(const StepProblem& problem);

private:
    void read_contacts(const StepProblem& problem);
    void guess_loads(const StepProblem& problem);
    static float resting_speed(const StepProblem& problem);
    static bool meets(const StepProblem& problem, const FirstGuess::Bearing& bearing);
    int find_substeps(const StepProblem& problem);
    void choose_parts(const StepProblem& problem, float h);
    void load_bodies(const StepProblem& problem);
    void choose_bouncing(const StepProblem& problem);
    void take_warm_start(const StepProblem& problem, const SoftKernels& kernels);
    bool has_turned_far() const;
    void anchor(const StepProblem& problem, float h);
    void anchor_anew(const StepProblem& problem, float h);
    void resolve_impacts(const StepProblem& problem, float h);
    void begin_substep(const StepProblem& problem, std::uint32_t body, float h);
    void end_substep(const StepProblem& problem, std::uint32_t body, float h);
    void solve_exactly(const StepProblem& problem, float part, bool pushes);
    Vec3 find_tumble(const StepProblem& problem, std::uint32_t body, Vec3& w, float h) const;
    void store_poses(const StepProblem& problem);
    void add_pass(const SoftKernels::Kernel (&kernels)[row_kind_count], const SoftPass& pass);
    template <class Loop>
    void add_loop(std::size_t count, int block_size, Loop& loop);
    void run(const StepProblem& problem);
    void hold_impulses(std::uint32_t body);
    void store_bodies(const StepProblem& problem);

    // What a body is beside its SoftBody.
    struct Course {
        Vec3 free_v, free_w;  // what the substep would have come to without contacts
        Vec3 held_v, held_w;  // what the last substep's contacts changed
        Vec3 tumble_rest;     // what tumbling adds to w when the substep ends
        // Where it was when its contacts were anchored.
        Quat anchored_rotation;
        Vec3 anchored_displacement;
        bool touched = false;   // in some contact: goes its way in parts
        bool tumbles = false;   // its own spin changes its angular velocity
        bool has_arms = false;  // in a contact that turns with it
    };

    // A pass over a batch of rows.
    struct RowJob {
        SoftKernels::Kernel kernel;
        SoftRows* rows;
        SoftRows::Batch batch;
        SoftBody* bodies;
        SoftPass pass;
        void operator()(int begin, int end, int worker) const;
    };

    int parts_ = 1;  // of a substep
    std::vector<FirstGuess::Bearing> bearings_;
    std::vector<float> loads_before_;
    FirstGuess first_guess_;
    std::vector<SoftBody> bodies_;  // and some more: see SoftRows::spare_bodies
    std::vector<Course> courses_;
    std::vector<std::uint32_t> touched_;  // padded to a multiple of every width
    std::vector<Response> responses_;
    SoftRows rows_;
    ExactLoads exact_;
    std::deque<RowJob> jobs_;                // what is to be done next, in order:
    std::vector<TeamStage> stages_;          // passes over rows and loops over bodies
    std::vector<std::uint32_t> may_bounce_;  // as StepProblem::active
    std::vector<ContactRows> bouncing_;
    std::vector<Response> impact_responses_;
    ImpactSolver impacts_;
};

}  // namespace cairn

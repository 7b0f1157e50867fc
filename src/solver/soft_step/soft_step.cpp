// Soft step; see soft_step.h.

#include "solver/soft_step/soft_step.h"

#include <array>

#include "integrate/integrate.h"

namespace cairn {

namespace {

// How far the smaller of two shapes in touch may sink by its own weight, as a share of its smallest
// half extent. A contact's stiffness grows with the square of the parts of a substep: what is small
// for the step calls for more of them, a stack of unit cubes for one.
constexpr float sinking_share = 6e-4f;
constexpr int most_parts = 12;
// A high wall bends under its own weight, as a column of springs does, and a sweep holds it
// straight no better than a spring: the stiffer, the shorter the substep. Faces that bear more than
// so many times the weight of the heavier of their two bodies call for more substeps, in
// proportion.
constexpr float straight_height = 12.5f;
constexpr int quarters = 4;        // of the substeps that were asked for
constexpr int least_finer = 6;     // quarters: what is too high by little leans on with one more
constexpr int most_finer = 8 * 4;  // quarters, at most
constexpr float least_weight = 1e-30f;  // less, N, is none
// A contact that has just begun has neither friction nor an even load to start from; what bounces
// is in touch for a part at most, and loses less the shorter that is.
constexpr int parts_for_sudden = 3;
// One in so many contacts may call for more than it gets.
constexpr std::size_t most_unserved = 16;
// A contact is at rest that closes or opens no faster than gravity makes it in so many steps.
constexpr float resting_steps = 2;
// Bodies are moved in groups of at most so many.
constexpr std::size_t widest = 16;
// Bodies and contacts are shared out in blocks of so many, about a microsecond's work.
constexpr int bodies_a_block = 64;
constexpr int contacts_a_block = 64;
constexpr int moved_a_block = 16 * int(widest);
// Radians that a body may turn before its contacts are anchored anew: their arms then point that
// much aside, and what they do to its spin is off by as much.
constexpr float farthest_turn = 0.1f;

FirstGuess::Bearing find_bearing(const StepProblem& problem, const Contact& contact) {
    const BodyMotion& a = problem.motions[contact.body_a];
    const BodyMotion& b = problem.motions[contact.body_b];
    const ContactPoint& p = contact.points[0];
    float gap = p.separation, load = 0;
    for (int i = 0; i < contact.point_count; ++i) {
        gap = min(gap, contact.points[std::size_t(i)].separation);
        load += contact.points[std::size_t(i)].normal_force;
    }
    const Vec3 v =
        relative_velocity(a, find_arm(p.arm_a, a.rotation), b, find_arm(p.arm_b, b.rotation));
    return {.body_a = contact.body_a,
            .body_b = contact.body_b,
            .normal = contact.normal,
            .gap = gap,
            .speed = dot(contact.normal, v),
            .size = contact.size,
            .load = load};
}

// Of as many as each asks for, but no fewer than `least`, the number that all but a few of the
// contacts are content with.
template <std::size_t Size>
int find_enough(const std::array<std::size_t, Size>& askers, std::size_t least,
                std::size_t contact_count) {
    std::size_t enough = Size - 1;
    std::size_t unserved = askers[enough];
    while (enough > least && unserved * most_unserved <= contact_count)
        unserved += askers[--enough];
    return int(enough);
}

}  // namespace

void SoftStep::advance(const StepProblem& problem) {
    const SoftKernels& kernels = find_soft_kernels(problem.lanes);
    read_contacts(problem);
    guess_loads(problem);
    exact_.find_candidates(problem, rows_);
    const int substeps = find_substeps(problem);
    const auto h = float(problem.dt / substeps);
    choose_parts(problem, h);
    const float part = h / float(parts_);
    load_bodies(problem);
    anchor(problem, h);
    choose_bouncing(problem);
    take_warm_start(problem, kernels);
    const auto each = [&](int begin, int end, auto&& visit) {
        for (const std::uint32_t i :
             problem.moving.subspan(std::size_t(begin), std::size_t(end - begin)))
            visit(i);
    };
    auto begin_bodies = [&](int begin, int end, int) {
        each(begin, end, [&](std::uint32_t i) { begin_substep(problem, i, h); });
    };
    auto move_bodies = [&](int begin, int end, int) {
        kernels.move_bodies(bodies_.data(), touched_.data() + begin, std::size_t(end - begin),
                            part);
    };
    auto end_bodies = [&](int begin, int end, int) {
        each(begin, end, [&](std::uint32_t i) { end_substep(problem, i, h); });
    };
    for (int substep = 0; substep < substeps; ++substep) {
        if (has_turned_far()) anchor_anew(problem, h);
        resolve_impacts(problem, h);
        add_loop(problem.moving.size(), bodies_a_block, begin_bodies);
        for (int k = 0; k < parts_; ++k) {
            solve_exactly(problem, part, true);
            for (int i = 0; i < problem.iterations; ++i)
                add_pass(kernels.solve, {1.0f / part, false});
            add_loop(touched_.size(), moved_a_block, move_bodies);
            if (!exact_.empty()) {
                add_pass(kernels.measure, {});
                solve_exactly(problem, part, false);
            }
            for (int i = 0; i < problem.iterations; ++i) {
                const bool last = k + 1 == parts_ && i + 1 == problem.iterations;
                add_pass(kernels.relax, {1.0f / part, last});
            }
        }
        add_loop(problem.moving.size(), bodies_a_block, end_bodies);
        run(problem);
    }
    store_poses(problem);
    rows_.store(problem, h, true, kernels);
    store_bodies(problem);
}

// All that is asked of contacts before their rows are filled, at once: they lie far apart.
void SoftStep::read_contacts(const StepProblem& problem) {
    rows_.begin_reading(problem);
    bearings_.resize(problem.active.size());
    problem.for_range(problem.active.size(), contacts_a_block, [&](int begin, int end) {
        visit_contacts(problem.contacts, problem.active, std::size_t(begin), std::size_t(end), 2,
                       [&](const Contact& contact, std::size_t k) {
                           rows_.read(problem, contact, k);
                           bearings_[k] = find_bearing(problem, contact);
                       });
    });
}

void SoftStep::guess_loads(const StepProblem& problem) {
    std::vector<float>& before = loads_before_;
    before.clear();
    for (const FirstGuess::Bearing& bearing : bearings_) before.push_back(bearing.load);
    if (!first_guess_.add_weights(problem, resting_speed(problem), bearings_)) return;
    for (std::size_t k = 0; k < bearings_.size(); ++k) {
        const float added = bearings_[k].load - before[k];
        if (!(added > 0)) continue;
        Contact& contact = problem.contacts[problem.active[k]];
        contact.remembered_load += added;
        for (int i = 0; i < contact.point_count; ++i)
            contact.points[std::size_t(i)].normal_force += added / float(contact.point_count);
    }
}

// Whether two shapes that were apart are in touch, or strike each other within the step or so.
bool SoftStep::meets(const StepProblem& problem, const FirstGuess::Bearing& bearing) {
    const float way = 1.5f * float(problem.dt) * bearing.speed;
    return bearing.gap <= 0 || (bearing.speed < -resting_speed(problem) && bearing.gap + way <= 0);
}

float SoftStep::resting_speed(const StepProblem& problem) {
    return resting_steps * float(problem.dt) * length(problem.gravity);
}

void SoftStep::choose_parts(const StepProblem& problem, float h) {
    // What a spring of one part's frequency sinks by, over the sinking that is allowed: weight over
    // stiffness, g / omega^2.
    const float sinking = length(problem.gravity) * square(h / SoftRows::angular_frequency_share);
    std::array<std::size_t, most_parts + 1> askers = {};
    for (std::size_t k = 0; k < problem.active.size(); ++k) {
        const SoftRows::Link& link = rows_.links()[k];
        const bool is_sudden = link.bounces || (!link.touching && meets(problem, bearings_[k]));
        int parts = is_sudden ? parts_for_sudden : 1;
        const float allowed = sinking_share * bearings_[k].size;
        while (parts < most_parts && sinking > float(parts * parts) * allowed) ++parts;
        ++askers[std::size_t(parts)];
    }
    parts_ = find_enough(askers, 1, problem.active.size());
}

// As many as were asked for, or as many more as hold the heap straight.
int SoftStep::find_substeps(const StepProblem& problem) {
    std::array<std::size_t, most_finer + 1> askers = {};
    for (std::size_t k = 0; k < problem.active.size(); ++k) {
        const FirstGuess::Bearing& bearing = bearings_[k];
        const Colouring::Edge& edge = rows_.edges()[k];
        // What it has long borne: no blow.
        const float borne = rows_.links()[k].remembered_load + (bearing.load - loads_before_[k]);
        const float height =
            borne / max(rows_.links()[k].heavier * length(problem.gravity), least_weight);
        // Columns are held straight exactly, and what touches at a point or an edge not at all.
        const bool is_held = rows_.links()[k].point_count >= 3 &&
                             !exact_.is_candidate(edge.pushes_a ? edge.body_a : edge.body_b);
        int finer = quarters;
        if (is_held && height > straight_height) {
            const float wanted = float(quarters) * height / straight_height;
            finer = least_finer;
            while (finer < most_finer && float(finer) < wanted) ++finer;
        }
        ++askers[std::size_t(finer)];
    }
    const int finer = find_enough(askers, quarters, problem.active.size());
    return (problem.substeps * finer + quarters - 1) / quarters;
}

void SoftStep::solve_exactly(const StepProblem& problem, float part, bool pushes) {
    if (exact_.empty()) return;
    run(problem);
    exact_.solve(part, pushes, responses_, bodies_, rows_);
}

// Contacts as they are at the bodies' present poses, in rows.
void SoftStep::anchor(const StepProblem& problem, float h) {
    find_responses(problem, responses_);
    for (const std::uint32_t i : problem.moving) {
        courses_[i].anchored_rotation = problem.motions[i].rotation;
        courses_[i].anchored_displacement = problem.motions[i].displacement;
        bodies_[i].displacement = {};
        bodies_[i].turn = {};
    }
    rows_.build(problem, responses_, h, h / float(parts_), find_soft_kernels(problem.lanes));
    bodies_.resize(problem.motions.size() + rows_.spare_bodies());
    exact_.prepare(problem, responses_, rows_);
}

void SoftStep::anchor_anew(const StepProblem& problem, float h) {
    store_poses(problem);
    rows_.store(problem, h, false, find_soft_kernels(problem.lanes));
    anchor(problem, h);
}

bool SoftStep::has_turned_far() const {
    for (const std::uint32_t i : touched_) {
        const Quat& q = bodies_[i].turn;
        const float sine = square(q.x) + square(q.y) + square(q.z);
        if (sine > square(0.5f * farthest_turn) && courses_[i].has_arms) return true;
    }
    return false;
}

void SoftStep::take_warm_start(const StepProblem& problem, const SoftKernels& kernels) {
    add_pass(kernels.warm_start, {});
    run(problem);
    for (const std::uint32_t i : problem.moving) {
        hold_impulses(i);
        // The first substep adds them with its forces.
        bodies_[i].v = courses_[i].free_v;
        bodies_[i].w = courses_[i].free_w;
    }
}

void SoftStep::load_bodies(const StepProblem& problem) {
    const std::size_t count = problem.motions.size();
    bodies_.assign(count + 2, {});
    courses_.assign(count + 2, {});
    for (const std::uint32_t i : problem.moving) {
        const BodyMotion& motion = problem.motions[i];
        bodies_[i].v = courses_[i].free_v = motion.linear_velocity;
        bodies_[i].w = courses_[i].free_w = motion.angular_velocity;
    }
    for (std::size_t k = 0; k < problem.active.size(); ++k) {
        Course& a = courses_[rows_.edges()[k].body_a];
        Course& b = courses_[rows_.edges()[k].body_b];
        a.touched = b.touched = true;
        if (rows_.links()[k].turns_with_a) a.has_arms = true;
        if (rows_.links()[k].turns_with_b) b.has_arms = true;
    }
    touched_.clear();
    for (const std::uint32_t i : problem.moving) {
        if (courses_[i].touched) touched_.push_back(i);
        courses_[i].tumbles =
            courses_[i].touched && tumbles(problem.inertias[i], problem.drives[i]);
    }
    const auto nowhere = std::uint32_t(count + 1);
    while (touched_.size() % widest != 0) touched_.push_back(nowhere);
}

void SoftStep::choose_bouncing(const StepProblem& problem) {
    may_bounce_.clear();
    for (std::size_t k = 0; k < problem.active.size(); ++k) {
        if (rows_.links()[k].bounces) may_bounce_.push_back(problem.active[k]);
    }
    bouncing_.resize(may_bounce_.size());
    prepare_rows(problem, may_bounce_, bouncing_);
    impacts_.choose(bouncing_);
}

void SoftStep::resolve_impacts(const StepProblem& problem, float h) {
    if (bouncing_.empty()) return;
    store_bodies(problem);
    store_poses(problem);
    find_responses(problem, impact_responses_);
    refresh_rows(problem, impact_responses_, bouncing_);
    impacts_.resolve(problem, impact_responses_, bouncing_, h);
    for (const std::uint32_t i : problem.moving) {
        bodies_[i].v = problem.motions[i].linear_velocity;
        bodies_[i].w = problem.motions[i].angular_velocity;
    }
}

void SoftStep::begin_substep(const StepProblem& problem, std::uint32_t i, float h) {
    SoftBody& body = bodies_[i];
    Course& course = courses_[i];
    BodyMotion motion = {.linear_velocity = body.v, .angular_velocity = body.w};
    integrate_velocity(motion, problem.inertias[i], problem.drives[i], responses_[i],
                       problem.gravity, h);
    Vec3 w = motion.angular_velocity;
    if (course.tumbles) w = find_tumble(problem, i, motion.angular_velocity, h);
    course.tumble_rest = motion.angular_velocity - w;
    course.free_v = motion.linear_velocity;
    course.free_w = motion.angular_velocity;
    body.v = course.free_v + course.held_v;
    body.w = w + course.held_w;
}

// What free rotation over h makes of w; returns the steady angular velocity that turns the body as
// far.
Vec3 SoftStep::find_tumble(const StepProblem& problem, std::uint32_t body, Vec3& w, float h) const {
    if (w == Vec3{}) return {};
    const Quat before = normalize(bodies_[body].turn * courses_[body].anchored_rotation);
    const BodyInertia& inertia = problem.inertias[body];
    if (h * length(w) < slow_turn)
        return tumble_slowly(before, w, inertia.inertia, inertia.inverse_inertia, h);
    Quat after = before;
    free_rotation(after, w, inertia.inertia, inertia.inverse_inertia, h);
    return (1.0f / h) * logarithm(after * conjugate(before));
}

void SoftStep::end_substep(const StepProblem& problem, std::uint32_t i, float h) {
    if (!courses_[i].touched) {
        BodyMotion& motion = problem.motions[i];
        motion.linear_velocity = bodies_[i].v;
        motion.angular_velocity = bodies_[i].w;
        integrate_pose(motion, problem.inertias[i], problem.drives[i], h);
        bodies_[i].w = courses_[i].free_w = motion.angular_velocity;
    }
    hold_impulses(i);
}

void SoftStep::store_poses(const StepProblem& problem) {
    for (const std::uint32_t i : problem.moving) {
        const Course& course = courses_[i];
        if (!course.touched) continue;
        BodyMotion& motion = problem.motions[i];
        motion.displacement = course.anchored_displacement + bodies_[i].displacement;
        motion.rotation = normalize(bodies_[i].turn * course.anchored_rotation);
    }
}

void SoftStep::RowJob::operator()(int begin, int end, int) const {
    kernel(rows->range(batch, begin, end), bodies, pass);
}

void SoftStep::add_pass(const SoftKernels::Kernel (&kernels)[row_kind_count],
                        const SoftPass& pass) {
    for (const SoftRows::Batch& batch : rows_.batches()) {
        jobs_.push_back({kernels[std::size_t(batch.kind)], &rows_, batch, bodies_.data(), pass});
        add_loop(batch.end - batch.begin,
                 SoftRows::rows_a_block(int(rows_.array(batch.kind).width())), jobs_.back());
    }
}

template <class Loop>
void SoftStep::add_loop(std::size_t count, int block_size, Loop& loop) {
    stages_.push_back(TeamStage(int(count), block_size, loop));
}

// Does what was added, in order.
void SoftStep::run(const StepProblem& problem) {
    if (problem.team) {
        problem.team->run_stages(stages_);
    } else {
        for (const TeamStage& stage : stages_) {
            if (stage.count > 0) stage.kernel(0, stage.count, 0);
        }
    }
    stages_.clear();
    jobs_.clear();
}

void SoftStep::hold_impulses(std::uint32_t i) {
    bodies_[i].w += courses_[i].tumble_rest;
    courses_[i].tumble_rest = {};
    courses_[i].held_v = bodies_[i].v - courses_[i].free_v;
    courses_[i].held_w = bodies_[i].w - courses_[i].free_w;
}

void SoftStep::store_bodies(const StepProblem& problem) {
    for (const std::uint32_t i : problem.moving) {
        problem.motions[i].linear_velocity = bodies_[i].v;
        problem.motions[i].angular_velocity = bodies_[i].w;
    }
}

}  // namespace cairn

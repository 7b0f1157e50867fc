// Sequential impulses; see sequential_impulse.h for the method and its symbols.

#include "solver/sequential_impulse/sequential_impulse.h"

#include <atomic>

#include "integrate/integrate.h"

namespace cairn {

namespace {

// Share of the overlap removed by one pass of positional correction, and how many passes a substep
// makes. More or larger passes part overlapping bodies sooner and let a stack jitter.
constexpr float correction_share = 0.2f;
constexpr int correction_passes = 4;
// Overlap that is left alone, as a share of the smaller shape: contacts at rest stay contacts.
constexpr float slop_share = 0.0005f;
// No pass moves a point by more than this share of the smaller shape.
constexpr float largest_correction_share = 0.1f;

// A contact is at rest that closes or opens no faster than gravity makes it in so many substeps.
constexpr float resting_substeps = 2;

float slop(const ContactRows& row) { return slop_share * row.size; }

}  // namespace

void SequentialImpulse::advance(const StepProblem& problem) {
    const auto h = float(problem.dt / problem.substeps);
    sweeps_.order_rows(problem, RowOrder::Waves);
    row_count_ = sweeps_.contacts().size();
    make_room(rows_, row_count_);
    make_room(states_, row_count_);
    make_room(bearings_, row_count_);
    make_room(squares_, row_count_);
    make_room(bodies_, problem.motions.size());
    make_room(courses_, problem.motions.size());
    make_room(corrections_, problem.motions.size());
    prepare_rows(problem, sweeps_.contacts(), rows_);
    impacts_.choose(std::span(rows_).first(row_count_));
    for (int substep = 0; substep < problem.substeps; ++substep) {
        begin_substep(problem, h);
        first_guess_.add_weights(problem, resting_substeps * h * length(problem.gravity),
                                 std::span(bearings_).first(row_count_));
        if (row_count_ > 0) solve(problem, h);
        move_bodies(problem, h);
    }
}

// From the poses to velocities that know of everything but the contacts, and what these remember.
void SequentialImpulse::begin_substep(const StepProblem& problem, float h) {
    find_responses(problem, responses_);
    auto refresh = [&](std::size_t k) {
        follow_bodies(problem, responses_, rows_[k]);
        find_friction_masses(responses_, rows_[k]);
    };
    sweeps_.add_rows(refresh);
    if (impacts_.any_may_bounce()) {
        sweeps_.run(problem);
        impacts_.resolve(problem, responses_, rows_, h);
    }
    auto accelerate = [&](std::size_t k) {
        const std::uint32_t i = problem.moving[k];
        integrate_velocity(problem.motions[i], problem.inertias[i], problem.drives[i],
                           responses_[i], problem.gravity, h);
    };
    sweeps_.add_bodies(problem.moving.size(), accelerate);
    auto load = [&](std::size_t i) {
        bodies_[i] = make_swept(problem.motions[i], responses_[i]);
        corrections_[i] = {};
    };
    sweeps_.add_bodies(problem.motions.size(), load);
    auto recall_row = [&](std::size_t k) { recall(problem, k, h); };
    sweeps_.add_rows(recall_row);
    sweeps_.run(problem);
}

void SequentialImpulse::solve(const StepProblem& problem, float h) {
    auto start = [&](std::size_t k) { warm_start(problem, k, h); };
    sweeps_.add_sweep(start);
    // Where bodies stand before the first sweep: what a sweep changes is measured from there.
    auto begin = [&](std::size_t k) {
        const SweptBody& body = bodies_[problem.moving[k]];
        courses_[problem.moving[k]] = {body.v, body.w, {}, {}};
    };
    sweeps_.add_bodies(problem.moving.size(), begin);
    Extrapolation extra;
    auto first = [&](std::size_t k) { solve_row(k, h, {}); };
    auto next = [&](std::size_t k) { solve_row(k, h, extra); };
    auto choose = [&](std::size_t) { extra = choose_extrapolation(extra); };
    auto extrapolate = [&](std::size_t k) { extrapolate_body(problem.moving[k], extra.beta); };
    for (int iteration = 0; iteration < problem.iterations; ++iteration) {
        const bool backward = iteration % 2 == 1;
        if (iteration == 0)
            sweeps_.add_sweep(first, backward);
        else
            sweeps_.add_sweep(next, backward);
        if (iteration + 1 == problem.iterations) break;
        sweeps_.add_alone(choose);
        sweeps_.add_bodies(problem.moving.size(), extrapolate);
    }
    sweeps_.run(problem);
}

// How far the sweep went, in J: comparable between light and heavy.
SequentialImpulse::Extrapolation SequentialImpulse::choose_extrapolation(
    const Extrapolation& last) const {
    // Four sums side by side, which do not wait for each other.
    std::array<float, 4> sums = {};
    for (std::size_t k = 0; k < row_count_; ++k) sums[k % 4] += squares_[k];
    Extrapolation next;
    next.squared = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    const float beta = last.squared > 0 ? next.squared / last.squared : 0;
    next.beta = beta <= 1 ? beta : 0;
    next.follows_sweep = true;
    return next;
}

float SequentialImpulse::square_in_joules(const ContactRows& row, const Impulses& impulses) {
    const auto weigh = [](float x, float mass) { return mass > 0 ? x / mass : 0; };
    float squared = 0;
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        squared += square(impulses.normal[i]) * row.coupling[i][i] +
                   weigh(length_squared(impulses.friction[i]), row.points[i].tangent_mass);
    }
    return squared + weigh(length_squared(impulses.rolling), row.rolling_mass) +
           weigh(square(impulses.spinning), row.spinning_mass);
}

// The velocities' part of a step along the conjugate direction: velocities follow impulses, so that
// a body's change is extrapolated as the impulses on it are.
void SequentialImpulse::extrapolate_body(std::uint32_t i, float beta) {
    SweptBody& body = bodies_[i];
    Course& course = courses_[i];
    const Vec3 extra_v = beta * course.direction_v;
    const Vec3 extra_w = beta * course.direction_w;
    course.direction_v = extra_v + (body.v - course.v);
    course.direction_w = extra_w + (body.w - course.w);
    if (body.is_pushed) {
        body.v += extra_v;
        body.w += extra_w;
    }
    course.v = body.v;
    course.w = body.w;
}

// What the contact remembers, and what the guess of new contacts' loads asks of it.
void SequentialImpulse::recall(const StepProblem& problem, std::size_t k, float h) {
    const ContactRows& row = rows_[k];
    const Contact& contact = problem.contacts[row.contact];
    Impulses& sum = states_[k].sum;
    sum = {};
    float load = 0;
    float gap = row.points[0].separation;
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        sum.normal[i] = h * contact.points[i].normal_force;
        load += sum.normal[i];
        gap = min(gap, row.points[i].separation);
    }
    states_[k].remembered = load / h;
    const PointRow& p = row.points[0];
    const Vec3 v =
        relative_velocity(problem.motions[row.body_a], p.r_a, problem.motions[row.body_b], p.r_b);
    bearings_[k] = {.body_a = row.body_a,
                    .body_b = row.body_b,
                    .normal = row.normal,
                    .gap = gap,
                    .speed = dot(row.normal, v),
                    .size = row.size,
                    .load = load / h};
}

// What the contact remembers and what it is guessed to bear, as impulses on its bodies.
void SequentialImpulse::warm_start(const StepProblem& problem, std::size_t k, float h) {
    const ContactRows& row = rows_[k];
    const Contact& contact = problem.contacts[row.contact];
    const auto count = std::size_t(row.point_count);
    Impulses& sum = states_[k].sum;
    const float load = h * bearings_[k].load;
    const float share = h * (bearings_[k].load - states_[k].remembered) / float(row.point_count);
    for (std::size_t i = 0; i < count; ++i) sum.normal[i] += share;
    share_evenly(row, sum.normal);
    SweptPair pair(bodies_, row);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 friction = h * without_normal(contact.points[i].friction_force, row.normal);
        sum.friction[i] = clamp_length(friction, row.friction * sum.normal[i]);
        pair.push(row.points[i], sum.normal[i] * row.normal + sum.friction[i]);
    }
    sum.rolling = clamp_length(h * without_normal(contact.rolling_torque, row.normal),
                               row.rolling_friction * load);
    const float most = row.spinning_friction * load;
    sum.spinning = clamp(h * contact.spinning_torque, -most, most);
    pair.twist(sum.rolling + sum.spinning * row.normal);
    pair.store(bodies_, row);
}

void SequentialImpulse::solve_row(std::size_t k, float h, const Extrapolation& last) {
    const ContactRows& row = rows_[k];
    RowState& state = states_[k];
    Impulses& sum = state.sum;
    if (last.follows_sweep) {
        // The impulses' part of the step along the conjugate direction.
        const Impulses extra = Impulses{}.plus(last.beta, state.direction);
        state.direction = extra.plus(1, state.change);
        sum = sum.plus(1, extra);
    } else {
        state.direction = {};
    }
    const Impulses before = sum;
    SweptPair pair(bodies_, row);
    rub_points(row, sum, pair);
    if (row.rolling_friction > 0 || row.spinning_friction > 0) rub_turning(row, sum, pair);
    solve_normal_rows(row, 1.0f / h, sum, pair);
    pair.store(bodies_, row);
    state.change = sum.plus(-1, before);
    squares_[k] = square_in_joules(row, state.change);
}

void SequentialImpulse::rub_points(const ContactRows& row, Impulses& sum, SweptPair& pair) {
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        const PointRow& p = row.points[i];
        const Vec3 v = pair.velocity_at(p) + row.surface_velocity;
        const Vec3 wanted = sum.friction[i] - p.tangent_mass * without_normal(v, row.normal);
        const Vec3 allowed = clamp_length(wanted, row.friction * sum.normal[i]);
        pair.push(p, allowed - sum.friction[i]);
        sum.friction[i] = allowed;
    }
}

void SequentialImpulse::rub_turning(const ContactRows& row, Impulses& sum, SweptPair& pair) {
    const Vec3 n = row.normal;
    float load = 0;
    for (const float normal : sum.normal) load += normal;
    const Vec3 w = pair.b.w - pair.a.w;
    const Vec3 rolling = clamp_length(sum.rolling - row.rolling_mass * without_normal(w, n),
                                      row.rolling_friction * load);
    const float most = row.spinning_friction * load;
    const float spinning = clamp(sum.spinning - row.spinning_mass * dot(n, w), -most, most);
    pair.twist((rolling - sum.rolling) + (spinning - sum.spinning) * n);
    sum.rolling = rolling;
    sum.spinning = spinning;
}

void SequentialImpulse::solve_normal_rows(const ContactRows& row, float inverse_h, Impulses& sum,
                                          SweptPair& pair) {
    std::array<float, 4> velocities = pair.normal_velocities(row);
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        velocities[i] += max(row.points[i].separation, 0) * inverse_h;
    }
    std::array<float, 4> changes = sum.normal;
    solve_normals(row, 0, velocities, sum.normal);
    for (std::size_t i = 0; i < 4; ++i) changes[i] = sum.normal[i] - changes[i];
    pair.push_apart(row, changes);
}

void SequentialImpulse::move_bodies(const StepProblem& problem, float h) {
    auto move = [&](std::size_t k) {
        const std::uint32_t i = problem.moving[k];
        BodyMotion& motion = problem.motions[i];
        motion.linear_velocity = bodies_[i].v;
        motion.angular_velocity = bodies_[i].w;
        integrate_pose(motion, problem.inertias[i], problem.drives[i], h);
    };
    sweeps_.add_bodies(problem.moving.size(), move);
    auto measure = [&](std::size_t k) {
        store_impulses(problem, k, h);
        measure_overlap(problem, k);
    };
    sweeps_.add_rows(measure);
    // A pass that corrected nothing is the last.
    std::array<std::atomic<bool>, correction_passes + 1> corrected = {true};
    int pass_now = 0;
    auto correct = [&](std::size_t k) {
        if (!corrected[std::size_t(pass_now)].load(std::memory_order_relaxed)) return;
        if (correct_row(k))
            corrected[std::size_t(pass_now) + 1].store(true, std::memory_order_relaxed);
    };
    auto end_pass = [&](std::size_t) { ++pass_now; };
    for (int pass = 0; pass < correction_passes; ++pass) {
        sweeps_.add_sweep(correct, pass % 2 == 1);
        sweeps_.add_alone(end_pass);
    }
    auto apply = [&](std::size_t k) {
        const std::uint32_t i = problem.moving[k];
        const Correction& correction = corrections_[i];
        if (correction.linear == Vec3{} && correction.angular == Vec3{}) return;
        problem.motions[i].displacement += correction.linear;
        problem.motions[i].rotation = turn(problem.motions[i].rotation, correction.angular);
    };
    sweeps_.add_bodies(problem.moving.size(), apply);
    sweeps_.run(problem);
}

void SequentialImpulse::measure_overlap(const StepProblem& problem, std::size_t k) {
    const ContactRows& row = rows_[k];
    const BodyMotion& a = problem.motions[row.body_a];
    const BodyMotion& b = problem.motions[row.body_b];
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        states_[k].excess[i] = -(find_separation(row.starts[i], row.normal, a, b) + slop(row));
    }
}

// One point after another, each knowing what the others have moved. Whether any was corrected.
bool SequentialImpulse::correct_row(std::size_t k) {
    const ContactRows& row = rows_[k];
    const RowState& state = states_[k];
    std::array<float, 4> parted =
        find_corrected(row, corrections_[row.body_a], corrections_[row.body_b]);
    std::array<float, 4> pushes = {};
    bool any = false;
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        const float excess = state.excess[i] - parted[i];
        if (!(excess > 0)) continue;
        any = true;
        const float wanted = min(correction_share * excess, largest_correction_share * row.size);
        pushes[i] = wanted * row.points[i].normal_mass;
        for (std::size_t j = 0; j < 4; ++j) parted[j] += row.coupling[i][j] * pushes[i];
    }
    if (any) correct_apart(row, pushes, bodies_, corrections_);
    return any;
}

void SequentialImpulse::store_impulses(const StepProblem& problem, std::size_t k, float h) {
    const float inverse_h = 1.0f / h;
    const Impulses& sum = states_[k].sum;
    Contact& contact = problem.contacts[rows_[k].contact];
    for (std::size_t i = 0; i < std::size_t(rows_[k].point_count); ++i) {
        ContactPoint& point = contact.points[i];
        point.normal_force = inverse_h * sum.normal[i];
        point.friction_force = inverse_h * sum.friction[i];
        point.normal_impulse += sum.normal[i];
        point.friction_impulse += sum.friction[i];
    }
    contact.rolling_torque = inverse_h * sum.rolling;
    contact.spinning_torque = inverse_h * sum.spinning;
    contact.rolling_impulse += sum.rolling;
    contact.spinning_impulse += sum.spinning;
}

}  // namespace cairn

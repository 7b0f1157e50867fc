// XPBD; see xpbd.h for the method and its symbols.

#include "solver/xpbd/xpbd.h"

#include <atomic>

#include "integrate/integrate.h"

namespace cairn {

namespace {

// An overlap that two shapes met with is removed at this share of the speed sqrt(size g) that
// falling makes of the smaller one's size: similar scenes at two scales do alike.
constexpr float push_speed_share = 0.25f;
// Where there is no gravity to measure by: shares of the size a step.
constexpr float push_share_a_step = 0.004f;
// Overlap that is left alone, as a share of the smaller shape: a few roundings of a separation,
// which would otherwise be pushed out at rounding / h.
constexpr float slop_share = 2.5e-7f;

float find_push_speed(const ContactRows& row, const StepProblem& problem) {
    const float by_gravity = push_speed_share * square_root(row.size * length(problem.gravity));
    return max(by_gravity, push_share_a_step * row.size / float(problem.dt));
}

// More sweeps of the velocity pass, at most. One sweep quietens a contact only until a later one
// moves its bodies; what that leaves, the next substep would take for their own speed, and a light
// body between a heavy one and the floor would throw both up.
constexpr int most_further_sweeps = 8;
// They go on where a contact's speed changed by more than this share of the push speed, a fortieth
// of sqrt(size g): far above what a stack at rest leaves, so that it pays for no sweep.
constexpr float stirring_share = 0.1f;
// Of a body that no sweep has stirred.
constexpr int never = -2;
// Sweeps of friction over the points of one manifold.
constexpr int friction_sweeps = 2;
// Radians that a body may turn before the masses of its contacts' friction are found anew: they
// only say how far a step of friction goes, and a tenth more or less overshoots nothing.
constexpr float farthest_turn = 0.1f;

}  // namespace

void Xpbd::advance(const StepProblem& problem) {
    const auto h = float(problem.dt / problem.substeps);
    begin_step(problem, h);
    for (int substep = 0; substep < problem.substeps; ++substep) {
        predict(problem, h, substep == 0);
        correct_positions(problem, h);
        solve_velocities(problem, h);
    }
    const float share = 1.0f / float(problem.substeps);
    auto end = [&](std::size_t k) {
        hold(k);
        store_impulses(problem, k, h, share);
    };
    sweeps_.add_rows(end);
    auto store = [&](std::size_t k) { store_velocity(problem, problem.moving[k]); };
    sweeps_.add_bodies(problem.moving.size(), store);
    sweeps_.run(problem);
}

void Xpbd::begin_step(const StepProblem& problem, float h) {
    sweeps_.order_rows(problem, RowOrder::Colours);
    const std::size_t row_count = sweeps_.contacts().size();
    make_room(rows_, row_count);
    make_room(multipliers_, row_count);
    make_room(held_, row_count);
    make_room(totals_, row_count);
    make_room(bodies_, problem.motions.size());
    make_room(corrections_, problem.motions.size());
    make_room(stirred_in_, problem.motions.size());
    make_room(courses_, problem.motions.size());
    prepare_rows(problem, sweeps_.contacts(), rows_);
    impacts_.choose(std::span(rows_).first(row_count));
    find_responses(problem, responses_);
    auto load = [&](std::size_t i) {
        courses_[i] = {.known_rotation = problem.motions[i].rotation};
        bodies_[i] = make_swept(problem.motions[i], responses_[i]);
        corrections_[i] = {};
        stirred_in_[i] = never;
    };
    sweeps_.add_bodies(problem.motions.size(), load);
    auto begin = [&](std::size_t k) {
        recall(problem, k, h);
        follow_bodies(problem, responses_, rows_[k]);
        find_friction_masses(responses_, rows_[k]);
    };
    sweeps_.add_rows(begin);
    sweeps_.run(problem);
}

void Xpbd::recall(const StepProblem& problem, std::size_t k, float h) {
    const ContactRows& row = rows_[k];
    Contact& contact = problem.contacts[row.contact];
    Held& held = held_[k];
    held = {};
    totals_[k] = {};
    multipliers_[k] = {};
    held.push_speed = find_push_speed(row, problem);
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        // A corner that swung in while another point was the contact: no motion that the
        // corrections have seen made this overlap, so no more may they undo it at once.
        if (contact.points[i].normal_force == 0)
            contact.first_overlap = max(contact.first_overlap, -contact.points[i].separation);
        held.friction[i] = (h * h) * contact.points[i].friction_force;
        held.load += (h * h) * contact.points[i].normal_force;
    }
    held.load_before = held.load;
    held.first_overlap = contact.first_overlap;
}

// From the last substep's poses to where the bodies come without the normals.
void Xpbd::predict(const StepProblem& problem, float h, bool first) {
    auto store = [&](std::size_t k) { store_velocity(problem, problem.moving[k]); };
    if (!first) sweeps_.add_bodies(problem.moving.size(), store);
    auto begin = [&](std::size_t k) {
        if (!first) hold(k);
        begin_row(problem, k);
    };
    sweeps_.add_rows(begin);
    if (impacts_.any_may_bounce()) {
        sweeps_.run(problem);
        impacts_.resolve(problem, responses_, rows_, h);
    }
    auto approach = [&](std::size_t k) { find_approach(problem, k); };
    if (impacts_.any_may_bounce()) sweeps_.add_rows(approach);
    auto accelerate = [&](std::size_t k) {
        const std::uint32_t i = problem.moving[k];
        integrate_velocity(problem.motions[i], problem.inertias[i], problem.drives[i],
                           responses_[i], problem.gravity, h);
        bodies_[i].v = problem.motions[i].linear_velocity;
        bodies_[i].w = problem.motions[i].angular_velocity;
    };
    sweeps_.add_bodies(problem.moving.size(), accelerate);
    auto warm = [&](std::size_t k) { warm_start(k, h); };
    sweeps_.add_sweep(warm);
    auto move = [&](std::size_t k) { move_body(problem, problem.moving[k], h); };
    sweeps_.add_bodies(problem.moving.size(), move);
    sweeps_.run(problem);
}

// To the predicted pose, and how the body answers there.
void Xpbd::move_body(const StepProblem& problem, std::uint32_t i, float h) {
    store_velocity(problem, i);
    BodyMotion& motion = problem.motions[i];
    integrate_pose(motion, problem.inertias[i], problem.drives[i], h);
    if (problem.inertias[i].inverse_mass > 0)
        responses_[i] = find_response(problem.inertias[i], problem.drives[i], motion.rotation);
    bodies_[i] = make_swept(motion, responses_[i]);
    corrections_[i] = {};
    stirred_in_[i] = never;
    Course& course = courses_[i];
    const Quat turned = motion.rotation * conjugate(course.known_rotation);
    const float sine = square(turned.x) + square(turned.y) + square(turned.z);
    course.turned_far = sine > square(0.5f * farthest_turn);
    if (course.turned_far) course.known_rotation = motion.rotation;
}

void Xpbd::begin_row(const StepProblem& problem, std::size_t k) {
    ContactRows& row = rows_[k];
    const BodyMotion& a = problem.motions[row.body_a];
    const BodyMotion& b = problem.motions[row.body_b];
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        row.points[i].separation = find_separation(row.starts[i], row.normal, a, b);
    }
    multipliers_[k] = {};
    find_approach(problem, k);
}

void Xpbd::find_approach(const StepProblem& problem, std::size_t k) {
    const ContactRows& row = rows_[k];
    const BodyMotion& a = problem.motions[row.body_a];
    const BodyMotion& b = problem.motions[row.body_b];
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        const PointRow& p = row.points[i];
        multipliers_[k].approach[i] = dot(row.normal, relative_velocity(a, p.r_a, b, p.r_b));
    }
}

void Xpbd::warm_start(std::size_t k, float h) {
    const ContactRows& row = rows_[k];
    const Held& held = held_[k];
    // A steady load's friction is the right one; that of a shock, carried on, would feed the
    // normals that answer its torque, and they it, until a heap throws a body out.
    const float larger = max(held.load, held.load_before);
    if (!(larger > 0)) return;
    const float steady = min(held.load, held.load_before) / larger;
    Multipliers& sum = multipliers_[k];
    SweptPair pair(bodies_, row);
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        sum.friction[i] = steady * without_normal(held.friction[i], row.normal);
        pair.push(row.points[i], (1.0f / h) * sum.friction[i]);
    }
    pair.store(bodies_, row);
}

void Xpbd::correct_positions(const StepProblem& problem, float h) {
    // Always in the same direction: one sweep leaves a residue, which is at rest only if it is the
    // same each time.
    const float compliance = problem.contact_compliance / (h * h);
    auto first = [&](std::size_t k) {
        measure(problem, k, h);
        correct_row(k, compliance);
    };
    auto next = [&](std::size_t k) { correct_row(k, compliance); };
    for (int iteration = 0; iteration < problem.iterations; ++iteration) {
        if (iteration == 0)
            sweeps_.add_sweep(first);
        else
            sweeps_.add_sweep(next);
    }
    auto derive = [&](std::size_t k) { derive_velocity(problem, problem.moving[k], h); };
    sweeps_.add_bodies(problem.moving.size(), derive);
    sweeps_.run(problem);
}

// The row at the predicted poses: arms and inertias as they are where the corrections act. Those of
// the substep's beginning would change w by other than what the impulse's torque is worth, and a
// body that spins fast would take energy from it.
void Xpbd::measure(const StepProblem& problem, std::size_t k, float h) {
    ContactRows& row = rows_[k];
    float& first_overlap = held_[k].first_overlap;
    if (first_overlap > 0) first_overlap = max(0, first_overlap - h * held_[k].push_speed);
    const float bearable = max(first_overlap, slop_share * row.size);
    std::array<float, 4> borne = {};
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        borne[i] = clamp(-row.points[i].separation, 0, bearable);
    }
    follow_bodies(problem, responses_, row);
    if (courses_[row.body_a].turned_far || courses_[row.body_b].turned_far)
        find_friction_masses(responses_, row);
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        multipliers_[k].separation[i] = row.points[i].separation + borne[i];
    }
}

void Xpbd::correct_row(std::size_t k, float compliance) {
    const ContactRows& row = rows_[k];
    Multipliers& sum = multipliers_[k];
    // C of all the points together, then the multipliers that bring none below zero.
    std::array<float, 4> c =
        find_corrected(row, corrections_[row.body_a], corrections_[row.body_b]);
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) c[i] += sum.separation[i];
    std::array<float, 4> changes = sum.normal;
    solve_normals(row, compliance, c, sum.normal);
    sum.gap = c;
    for (std::size_t i = 0; i < 4; ++i) changes[i] = sum.normal[i] - changes[i];
    correct_apart(row, changes, bodies_, corrections_);
}

void Xpbd::derive_velocity(const StepProblem& problem, std::uint32_t i, float h) {
    const float inverse_h = 1.0f / h;
    const Correction& correction = corrections_[i];
    if (correction.linear == Vec3{} && correction.angular == Vec3{}) return;
    BodyMotion& motion = problem.motions[i];
    motion.displacement += correction.linear;
    motion.rotation = turn(motion.rotation, correction.angular);
    bodies_[i].v = motion.linear_velocity + inverse_h * correction.linear;
    bodies_[i].w = motion.angular_velocity + inverse_h * correction.angular;
}

void Xpbd::store_velocity(const StepProblem& problem, std::uint32_t i) {
    problem.motions[i].linear_velocity = bodies_[i].v;
    problem.motions[i].angular_velocity = bodies_[i].w;
}

void Xpbd::solve_velocities(const StepProblem& problem, float h) {
    std::atomic<bool> stirs = false;
    int sweep = 0;
    auto solve = [&](std::size_t k) {
        if (sweep > 0) {
            const bool meets_stirred = stirred_in_[rows_[k].body_a] >= sweep - 1 ||
                                       stirred_in_[rows_[k].body_b] >= sweep - 1;
            if (!meets_stirred) return;
        }
        if (solve_velocity(problem, k, h, sweep)) stirs.store(true, std::memory_order_relaxed);
    };
    for (; sweep <= most_further_sweeps; ++sweep) {
        stirs.store(false, std::memory_order_relaxed);
        sweeps_.add_sweep(solve, sweep % 2 == 1);
        sweeps_.run(problem);
        if (!stirs.load(std::memory_order_relaxed)) break;
    }
}

bool Xpbd::solve_velocity(const StepProblem& problem, std::size_t k, float h, int sweep) {
    const ContactRows& row = rows_[k];
    Multipliers& sum = multipliers_[k];
    // Nothing presses and nothing rubbed.
    if (sum.normal == std::array<float, 4>{} && sum.friction == std::array<Vec3, 4>{} &&
        sum.rolling == Vec3{} && sum.spinning == 0)
        return false;
    SweptPair pair(bodies_, row);
    const float change = quiet_normals(row, sum, h, pair);
    rub_points(row, sum, h, pair);
    if (row.rolling_friction > 0 || row.spinning_friction > 0) rub_turning(row, sum, h, pair);
    pair.store(bodies_, row);
    if (!(change > stirring_share * held_[k].push_speed)) return false;
    // What nothing moves passes nothing on.
    for (const std::uint32_t body : {row.body_a, row.body_b}) {
        if (problem.inertias[body].inverse_mass > 0) stirred_in_[body] = sweep;
    }
    return true;
}

float Xpbd::quiet_normals(const ContactRows& row, Multipliers& sum, float h, SweptPair& pair) {
    if (sum.normal == std::array<float, 4>{}) return 0;
    const float inverse_h = 1.0f / h;
    std::array<float, 4> excess = pair.normal_velocities(row);
    std::array<float, 4> impulses = {};
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        const float u = excess[i];
        // No faster apart than before: what is faster, the push has made. A point that was not
        // pushed may close what is open in one substep.
        const bool pushed = sum.normal[i] > 0;
        excess[i] =
            pushed ? u - clamp(u, 0, max(0, sum.approach[i])) : u + max(0, sum.gap[i]) * inverse_h;
        impulses[i] = sum.normal[i] * inverse_h;
    }
    std::array<float, 4> changes = impulses;
    solve_normals(row, 0, excess, impulses);
    float most = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        changes[i] = impulses[i] - changes[i];
        most = max(most, absolute(changes[i]) * row.coupling[i][i]);
    }
    pair.push_apart(row, changes);
    share_evenly(row, impulses);
    for (std::size_t i = 0; i < 4; ++i) sum.normal[i] = h * impulses[i];
    return most;
}

void Xpbd::rub_points(const ContactRows& row, Multipliers& sum, float h, SweptPair& pair) {
    const float inverse_h = 1.0f / h;
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        // The bound may have come down since.
        const Vec3 allowed = clamp_length(sum.friction[i], row.friction * sum.normal[i]);
        if (allowed == sum.friction[i]) continue;
        pair.push(row.points[i], inverse_h * (allowed - sum.friction[i]));
        sum.friction[i] = allowed;
    }
    // One step of a single point's friction is exact where its mass is the same in every direction.
    const bool is_exact = row.point_count == 1 && row.points[0].alike_across;
    for (int sweep = 0; sweep < (is_exact ? 1 : friction_sweeps); ++sweep) {
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            const PointRow& p = row.points[i];
            const Vec3 v = without_normal(pair.velocity_at(p), row.normal) + row.surface_velocity;
            const Vec3 total = clamp_length(sum.friction[i] - (h * p.tangent_mass) * v,
                                            row.friction * sum.normal[i]);
            pair.push(p, inverse_h * (total - sum.friction[i]));
            sum.friction[i] = total;
        }
    }
}

void Xpbd::rub_turning(const ContactRows& row, Multipliers& sum, float h, SweptPair& pair) {
    float load = 0;
    for (const float normal : sum.normal) load += normal;
    const Vec3 n = row.normal;
    const Vec3 w = pair.b.w - pair.a.w;
    const Vec3 rolling = clamp_length(sum.rolling - (h * row.rolling_mass) * without_normal(w, n),
                                      row.rolling_friction * load);
    const float most = row.spinning_friction * load;
    const float spinning = clamp(sum.spinning - h * row.spinning_mass * dot(n, w), -most, most);
    pair.twist((1.0f / h) * ((rolling - sum.rolling) + (spinning - sum.spinning) * n));
    sum.rolling = rolling;
    sum.spinning = spinning;
}

// The end of a row's substep.
void Xpbd::hold(std::size_t k) {
    const Multipliers& sum = multipliers_[k];
    Held& held = held_[k];
    Totals& total = totals_[k];
    held.friction = sum.friction;
    held.load_before = held.load;
    held.load = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        held.load += sum.normal[i];
        total.normal[i] += sum.normal[i];
        total.friction[i] += sum.friction[i];
    }
    total.rolling += sum.rolling;
    total.spinning += sum.spinning;
}

void Xpbd::store_impulses(const StepProblem& problem, std::size_t k, float h, float share) {
    const float inverse_h = 1.0f / h;
    // Mean force of the step: what another method would begin with.
    const float mean = share * inverse_h * inverse_h;
    const Totals& total = totals_[k];
    Contact& contact = problem.contacts[rows_[k].contact];
    for (std::size_t i = 0; i < std::size_t(rows_[k].point_count); ++i) {
        ContactPoint& point = contact.points[i];
        point.normal_impulse += inverse_h * total.normal[i];
        point.friction_impulse += inverse_h * total.friction[i];
        point.normal_force = mean * total.normal[i];
        point.friction_force = mean * total.friction[i];
    }
    contact.rolling_impulse += inverse_h * total.rolling;
    contact.spinning_impulse += inverse_h * total.spinning;
    contact.rolling_torque = mean * total.rolling;
    contact.spinning_torque = mean * total.spinning;
    contact.first_overlap = held_[k].first_overlap;
}

}  // namespace cairn

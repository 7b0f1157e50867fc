// XPBD; see xpbd.h for the method and its symbols.

#include "solver/xpbd/xpbd.h"

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

}  // namespace

void Xpbd::advance(const StepProblem& problem) {
    const auto h = float(problem.dt / problem.substeps);
    prepare_rows(problem, rows_);
    recall(problem, h);
    for (int substep = 0; substep < problem.substeps; ++substep) {
        find_responses(problem, responses_);
        refresh_rows(problem, responses_, rows_);
        impacts_.resolve(problem, responses_, rows_, h);
        multipliers_.assign(rows_.size(), {});
        corrections_.assign(problem.motions.size(), {});
        predict(problem, h);
        measure(problem, h);
        for (int iteration = 0; iteration < problem.iterations; ++iteration) {
            correct_positions(problem, h);
        }
        derive_velocities(problem, h);
        solve_velocities(problem, h);
        store_impulses(problem, h, substep == 0);
    }
}

void Xpbd::recall(const StepProblem& problem, float h) {
    held_.assign(rows_.size(), {});
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        Contact& contact = problem.contacts[rows_[k].contact];
        Held& held = held_[k];
        for (std::size_t i = 0; i < std::size_t(rows_[k].point_count); ++i) {
            // A corner that swung in while another point was the contact: no motion that the
            // corrections have seen made this overlap, so no more may they undo it at once.
            if (contact.points[i].normal_force == 0)
                contact.first_overlap = max(contact.first_overlap, -contact.points[i].separation);
            held.friction[i] = (h * h) * contact.points[i].friction_force;
            held.load += (h * h) * contact.points[i].normal_force;
        }
        held.load_before = held.load;
    }
}

void Xpbd::predict(const StepProblem& problem, float h) {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const ContactRows& row = rows_[k];
        const BodyMotion& a = problem.motions[row.body_a];
        const BodyMotion& b = problem.motions[row.body_b];
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            const PointRow& p = row.points[i];
            multipliers_[k].approach[i] = dot(row.normal, relative_velocity(a, p.r_a, b, p.r_b));
        }
    }
    for (const std::uint32_t i : problem.moving) {
        integrate_velocity(problem.motions[i], problem.inertias[i], problem.drives[i],
                           responses_[i], problem.gravity, h);
    }
    warm_start(problem, h);
    for (const std::uint32_t i : problem.moving) {
        integrate_pose(problem.motions[i], problem.inertias[i], problem.drives[i], h);
    }
}

void Xpbd::warm_start(const StepProblem& problem, float h) {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const ContactRows& row = rows_[k];
        const Held& held = held_[k];
        // A steady load's friction is the right one; that of a shock, carried on, would feed the
        // normals that answer its torque, and they it, until a heap throws a body out.
        const float larger = max(held.load, held.load_before);
        if (!(larger > 0)) continue;
        const float steady = min(held.load, held.load_before) / larger;
        Multipliers& sum = multipliers_[k];
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            const PointRow& p = row.points[i];
            sum.friction[i] = steady * without_normal(held.friction[i], row.normal);
            apply_impulse(problem.motions[row.body_a], responses_[row.body_a], p.r_a,
                          problem.motions[row.body_b], responses_[row.body_b], p.r_b,
                          (1.0f / h) * sum.friction[i]);
        }
    }
}

void Xpbd::measure(const StepProblem& problem, float h) {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const ContactRows& row = rows_[k];
        Contact& contact = problem.contacts[row.contact];
        const BodyMotion& a = problem.motions[row.body_a];
        const BodyMotion& b = problem.motions[row.body_b];
        if (contact.first_overlap > 0) {
            contact.first_overlap =
                max(0, contact.first_overlap - h * find_push_speed(row, problem));
        }
        const float bearable = max(contact.first_overlap, slop_share * row.size);
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            const float s = find_separation(row.points[i], row.normal, a, b);
            const float borne = clamp(-row.points[i].separation, 0, bearable);
            multipliers_[k].separation[i] = s + borne;
        }
    }
}

void Xpbd::correct_positions(const StepProblem& problem, float h) {
    const float compliance = problem.contact_compliance / (h * h);
    // Always in the same direction: one sweep leaves a residue, which is at rest only if it is the
    // same each time.
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const ContactRows& row = rows_[k];
        Multipliers& sum = multipliers_[k];
        Correction& a = corrections_[row.body_a];
        Correction& b = corrections_[row.body_b];
        const Response& response_a = responses_[row.body_a];
        const Response& response_b = responses_[row.body_b];
        const Vec3 n = row.normal;
        // C of all the points together, then the multipliers that bring none below zero.
        std::array<float, 4> c = {};
        const float linear = dot(n, b.linear - a.linear);
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            const PointRow& p = row.points[i];
            c[i] = sum.separation[i] + linear + dot(p.turn_b, b.angular) - dot(p.turn_a, a.angular);
        }
        const std::array<float, 4> before = sum.normal;
        solve_normals(row, compliance, c, sum.normal);
        sum.gap = c;
        float total = 0;
        Vec3 spin_a, spin_b;
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            const PointRow& p = row.points[i];
            const float change = sum.normal[i] - before[i];
            spin_a += change * p.spin_a;
            spin_b += change * p.spin_b;
            total += change;
        }
        if (is_pushed(response_a)) {
            a.linear -= multiply(response_a.inverse_mass, total * n);
            a.angular -= spin_a;
        }
        if (is_pushed(response_b)) {
            b.linear += multiply(response_b.inverse_mass, total * n);
            b.angular += spin_b;
        }
    }
}

void Xpbd::derive_velocities(const StepProblem& problem, float h) {
    const float inverse_h = 1.0f / h;
    for (const std::uint32_t i : problem.moving) {
        const Correction& correction = corrections_[i];
        if (correction.linear == Vec3{} && correction.angular == Vec3{}) continue;
        BodyMotion& motion = problem.motions[i];
        motion.displacement += correction.linear;
        motion.rotation = turn(motion.rotation, correction.angular);
        motion.linear_velocity += inverse_h * correction.linear;
        motion.angular_velocity += inverse_h * correction.angular;
    }
}

void Xpbd::solve_velocities(const StepProblem& problem, float h) {
    stirred_in_.assign(problem.motions.size(), never);
    for (std::size_t k = 0; k < rows_.size(); ++k) solve_velocity(problem, k, h, 0);
    bool stirs = true;
    for (int sweep = 1; sweep <= most_further_sweeps && stirs; ++sweep) {
        stirs = false;
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const std::size_t k = sweep % 2 == 0 ? i : rows_.size() - 1 - i;
            const bool meets_stirred = stirred_in_[rows_[k].body_a] >= sweep - 1 ||
                                       stirred_in_[rows_[k].body_b] >= sweep - 1;
            if (meets_stirred) stirs = solve_velocity(problem, k, h, sweep) || stirs;
        }
    }
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const Multipliers& sum = multipliers_[k];
        float load = 0;
        for (const float normal : sum.normal) load += normal;
        held_[k] = {sum.friction, load, held_[k].load};
    }
}

bool Xpbd::solve_velocity(const StepProblem& problem, std::size_t k, float h, int sweep) {
    const ContactRows& row = rows_[k];
    const float change = quiet_normals(problem, k, h);
    rub_points(problem, k, h);
    if (row.rolling_friction > 0 || row.spinning_friction > 0) rub_turning(problem, k, h);
    if (!(change > stirring_share * find_push_speed(row, problem))) return false;
    // What nothing moves passes nothing on.
    for (const std::uint32_t body : {row.body_a, row.body_b}) {
        if (problem.inertias[body].inverse_mass > 0) stirred_in_[body] = sweep;
    }
    return true;
}

float Xpbd::quiet_normals(const StepProblem& problem, std::size_t k, float h) {
    const ContactRows& row = rows_[k];
    Multipliers& sum = multipliers_[k];
    BodyMotion& a = problem.motions[row.body_a];
    BodyMotion& b = problem.motions[row.body_b];
    if (sum.normal == std::array<float, 4>{}) return 0;
    std::array<float, 4> excess = {};
    std::array<float, 4> impulses = {};
    const float linear = dot(row.normal, b.linear_velocity - a.linear_velocity);
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        const PointRow& p = row.points[i];
        const float u =
            linear + dot(p.turn_b, b.angular_velocity) - dot(p.turn_a, a.angular_velocity);
        // No faster apart than before: what is faster, the push has made. A point that was not
        // pushed may close what is open in one substep.
        const bool pushed = sum.normal[i] > 0;
        excess[i] = pushed ? u - clamp(u, 0, max(0, sum.approach[i])) : u + max(0, sum.gap[i]) / h;
        impulses[i] = sum.normal[i] / h;
    }
    std::array<float, 4> changes = impulses;
    solve_normals(row, 0, excess, impulses);
    float most = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        changes[i] = impulses[i] - changes[i];
        most = max(most, absolute(changes[i]) * row.coupling[i][i]);
    }
    push_apart(row, changes, a, b, responses_[row.body_a], responses_[row.body_b]);
    share_evenly(row, impulses);
    for (std::size_t i = 0; i < 4; ++i) sum.normal[i] = h * impulses[i];
    return most;
}

void Xpbd::rub_points(const StepProblem& problem, std::size_t k, float h) {
    const ContactRows& row = rows_[k];
    Multipliers& sum = multipliers_[k];
    BodyMotion& a = problem.motions[row.body_a];
    BodyMotion& b = problem.motions[row.body_b];
    const Response& response_a = responses_[row.body_a];
    const Response& response_b = responses_[row.body_b];
    const Vec3 n = row.normal;
    const float inverse_h = 1.0f / h;
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        // The bound may have come down since.
        const PointRow& p = row.points[i];
        const Vec3 allowed = clamp_length(sum.friction[i], row.friction * sum.normal[i]);
        if (allowed == sum.friction[i]) continue;
        apply_impulse(a, response_a, p.r_a, b, response_b, p.r_b,
                      inverse_h * (allowed - sum.friction[i]));
        sum.friction[i] = allowed;
    }
    for (int sweep = 0; sweep < friction_sweeps; ++sweep) {
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            const PointRow& p = row.points[i];
            const Vec3 v =
                without_normal(relative_velocity(a, p.r_a, b, p.r_b), n) + row.surface_velocity;
            const Vec3 total = clamp_length(sum.friction[i] - (h * p.tangent_mass) * v,
                                            row.friction * sum.normal[i]);
            apply_impulse(a, response_a, p.r_a, b, response_b, p.r_b,
                          inverse_h * (total - sum.friction[i]));
            sum.friction[i] = total;
        }
    }
}

void Xpbd::rub_turning(const StepProblem& problem, std::size_t k, float h) {
    const ContactRows& row = rows_[k];
    Multipliers& sum = multipliers_[k];
    BodyMotion& a = problem.motions[row.body_a];
    BodyMotion& b = problem.motions[row.body_b];
    float load = 0;
    for (const float normal : sum.normal) load += normal;
    const Vec3 n = row.normal;
    const Vec3 w = b.angular_velocity - a.angular_velocity;
    const Vec3 rolling = clamp_length(sum.rolling - (h * row.rolling_mass) * without_normal(w, n),
                                      row.rolling_friction * load);
    const float most = row.spinning_friction * load;
    const float spinning = clamp(sum.spinning - h * row.spinning_mass * dot(n, w), -most, most);
    const Vec3 twist = (1.0f / h) * ((rolling - sum.rolling) + (spinning - sum.spinning) * n);
    sum.rolling = rolling;
    sum.spinning = spinning;
    apply_twist(a, responses_[row.body_a], b, responses_[row.body_b], twist);
}

void Xpbd::store_impulses(const StepProblem& problem, float h, bool first) {
    const float inverse_h = 1.0f / h;
    const float share = 1.0f / float(problem.substeps);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const Multipliers& sum = multipliers_[k];
        Contact& contact = problem.contacts[rows_[k].contact];
        if (first) {
            contact.rolling_torque = {};
            contact.spinning_torque = 0;
        }
        for (std::size_t i = 0; i < std::size_t(rows_[k].point_count); ++i) {
            ContactPoint& point = contact.points[i];
            if (first) {
                point.normal_force = 0;
                point.friction_force = {};
            }
            const float normal = inverse_h * sum.normal[i];
            const Vec3 friction = inverse_h * sum.friction[i];
            point.normal_impulse += normal;
            point.friction_impulse += friction;
            // Mean force of the step: what another method would begin with.
            point.normal_force += share * inverse_h * normal;
            point.friction_force += (share * inverse_h) * friction;
        }
        contact.rolling_impulse += inverse_h * sum.rolling;
        contact.spinning_impulse += inverse_h * sum.spinning;
        contact.rolling_torque += (share * inverse_h * inverse_h) * sum.rolling;
        contact.spinning_torque += share * inverse_h * inverse_h * sum.spinning;
    }
}

}  // namespace cairn

// XPBD; see xpbd.h for the method and its symbols.

#include "solver/xpbd/xpbd.h"

#include "integrate/integrate.h"

namespace cairn {

namespace {

// An overlap that was there before the substep is removed at this many of the smaller shape's sizes
// a second of its own falling time sqrt(size/g): similar scenes at two scales do alike.
constexpr float push_speed_share = 0.5f;
// Where there is no gravity to measure by: shares of the size a step.
constexpr float push_share_a_step = 0.02f;

float find_push_speed(const ContactRows& row, const StepProblem& problem) {
    const float by_gravity = push_speed_share * square_root(row.size * length(problem.gravity));
    return max(by_gravity, push_share_a_step * row.size / float(problem.dt));
}

}  // namespace

void Xpbd::advance(const StepProblem& problem) {
    const auto h = float(problem.dt / problem.substeps);
    prepare_rows(problem, rows_);
    for (int substep = 0; substep < problem.substeps; ++substep) {
        find_responses(problem, responses_);
        refresh_rows(problem, responses_, rows_);
        impacts_.resolve(problem, responses_, rows_, h);
        multipliers_.assign(rows_.size(), {});
        corrections_.assign(problem.motions.size(), {});
        predict(problem, h);
        measure(problem, h);
        for (int iteration = 0; iteration < problem.iterations; ++iteration) {
            correct_positions(problem, h, (substep + iteration) % 2 == 1);
        }
        derive_velocities(problem, h);
        solve_velocities(problem, h);
        store_impulses(problem, h, substep == 0);
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
    // Slips are those of the predicted velocities, seen along the arms of the substep's start.
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const ContactRows& row = rows_[k];
        const BodyMotion& a = problem.motions[row.body_a];
        const BodyMotion& b = problem.motions[row.body_b];
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            const PointRow& p = row.points[i];
            const Vec3 v = relative_velocity(a, p.r_a, b, p.r_b) + row.surface_velocity;
            multipliers_[k].slip[i] = h * without_normal(v, row.normal);
        }
    }
    for (const std::uint32_t i : problem.moving) {
        integrate_pose(problem.motions[i], problem.inertias[i], problem.drives[i], h);
    }
}

void Xpbd::measure(const StepProblem& problem, float h) {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const ContactRows& row = rows_[k];
        const BodyMotion& a = problem.motions[row.body_a];
        const BodyMotion& b = problem.motions[row.body_b];
        const float most = h * find_push_speed(row, problem);
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            const PointRow& p = row.points[i];
            const float s = find_separation(p, row.normal, a, b);
            // Of an old overlap only `most` is to be seen.
            const float old_overlap = max(0, -p.separation - most);
            multipliers_[k].separation[i] = s + old_overlap;
        }
    }
}

void Xpbd::correct_positions(const StepProblem& problem, float h, bool backward) {
    const float compliance = problem.contact_compliance / (h * h);
    for (std::size_t index = 0; index < rows_.size(); ++index) {
        const std::size_t k = backward ? rows_.size() - 1 - index : index;
        const ContactRows& row = rows_[k];
        Multipliers& sum = multipliers_[k];
        Correction& a = corrections_[row.body_a];
        Correction& b = corrections_[row.body_b];
        const Response& response_a = responses_[row.body_a];
        const Response& response_b = responses_[row.body_b];
        const Vec3 n = row.normal;
        const auto moved = [&](const PointRow& p) {
            return (b.linear + cross(b.angular, p.r_b)) - (a.linear + cross(a.angular, p.r_a));
        };
        const auto push = [&](const PointRow& p, Vec3 impulse) {
            a.linear -= multiply(response_a.inverse_mass, impulse);
            a.angular -= response_a.inverse_inertia * cross(p.r_a, impulse);
            b.linear += multiply(response_b.inverse_mass, impulse);
            b.angular += response_b.inverse_inertia * cross(p.r_b, impulse);
        };

        float load = 0;
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            const PointRow& p = row.points[i];
            const float c = sum.separation[i] + dot(n, moved(p));
            // (-c - a l) / (K + a), written with m = 1/K.
            const float change = p.normal_mass * (-c - compliance * sum.normal[i]) /
                                 (1.0f + compliance * p.normal_mass);
            const float total = max(0, sum.normal[i] + change);
            push(p, (total - sum.normal[i]) * n);
            sum.normal[i] = total;
            load += total;
        }
        if (!(load > 0)) continue;
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            const PointRow& p = row.points[i];
            const Vec3 slip = sum.slip[i] + without_normal(moved(p), n);
            const Vec3 total =
                clamp_length(sum.friction[i] - p.tangent_mass * slip, row.friction * sum.normal[i]);
            push(p, total - sum.friction[i]);
            sum.friction[i] = total;
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
    const float inverse_h = 1.0f / h;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const ContactRows& row = rows_[k];
        Multipliers& sum = multipliers_[k];
        BodyMotion& a = problem.motions[row.body_a];
        BodyMotion& b = problem.motions[row.body_b];
        const Response& response_a = responses_[row.body_a];
        const Response& response_b = responses_[row.body_b];
        const Vec3 n = row.normal;
        float load = 0;
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            if (!(sum.normal[i] > 0)) continue;
            const PointRow& p = row.points[i];
            load += sum.normal[i];
            // No faster apart than before: what is faster, the push has made. No impulse in all
            // below zero.
            const float u = dot(n, relative_velocity(a, p.r_a, b, p.r_b));
            const float allowed = max(0, sum.approach[i]);
            const float change =
                max(p.normal_mass * (min(u, allowed) - u), -inverse_h * sum.normal[i]);
            apply_impulse(a, response_a, p.r_a, b, response_b, p.r_b, change * n);
            sum.normal[i] = max(0, sum.normal[i] + h * change);

            const Vec3 v =
                without_normal(relative_velocity(a, p.r_a, b, p.r_b), n) + row.surface_velocity;
            const Vec3 total = clamp_length(sum.friction[i] - (h * p.tangent_mass) * v,
                                            row.friction * max(sum.normal[i], 0));
            apply_impulse(a, response_a, p.r_a, b, response_b, p.r_b,
                          inverse_h * (total - sum.friction[i]));
            sum.friction[i] = total;
        }
        if (load > 0 && (row.rolling_friction > 0 || row.spinning_friction > 0)) {
            const Vec3 w = b.angular_velocity - a.angular_velocity;
            sum.rolling = clamp_length((-h * row.rolling_mass) * without_normal(w, n),
                                       row.rolling_friction * load);
            const float most = row.spinning_friction * load;
            sum.spinning = clamp(-h * row.spinning_mass * dot(n, w), -most, most);
            const Vec3 twist = inverse_h * (sum.rolling + sum.spinning * n);
            a.angular_velocity -= response_a.inverse_inertia * twist;
            b.angular_velocity += response_b.inverse_inertia * twist;
        }
    }
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

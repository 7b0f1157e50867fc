// Sequential impulses; see sequential_impulse.h for the method and its symbols.

#include "solver/sequential_impulse/sequential_impulse.h"

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

// A push on positions; see push_body.
void move_body(BodyMotion& body, const Response& response, float sign, Vec3 push, Vec3 r) {
    if (!is_pushed(response)) return;
    body.displacement += sign * multiply(response.inverse_mass, push);
    body.rotation = turn(body.rotation, sign * (response.inverse_inertia * cross(r, push)));
}

}  // namespace

void SequentialImpulse::advance(const StepProblem& problem) {
    const auto h = float(problem.dt / problem.substeps);
    prepare_rows(problem, rows_);
    for (int substep = 0; substep < problem.substeps; ++substep) {
        find_responses(problem, responses_);
        refresh_rows(problem, responses_, rows_);
        impacts_.resolve(problem, responses_, rows_, h);
        for (const std::uint32_t i : problem.moving) {
            integrate_velocity(problem.motions[i], problem.inertias[i], problem.drives[i],
                               responses_[i], problem.gravity, h);
        }
        load_impulses(problem, h);
        warm_start(problem);
        solve(problem, h);
        for (const std::uint32_t i : problem.moving) {
            integrate_pose(problem.motions[i], problem.inertias[i], problem.drives[i], h);
        }
        correct_positions(problem);
        store_impulses(problem, h);
    }
}

void SequentialImpulse::solve(const StepProblem& problem, float h) {
    directions_.assign(rows_.size(), {});
    float last_squared = 0;
    for (int iteration = 0; iteration < problem.iterations; ++iteration) {
        changes_ = accumulated_;
        solve_velocities(problem, h, iteration % 2 == 1);
        if (iteration + 1 == problem.iterations) return;
        // How far the sweep went, in J: comparable between light and heavy.
        float squared = 0;
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            changes_[k] = accumulated_[k].plus(-1, changes_[k]);
            squared += square_in_joules(rows_[k], changes_[k]);
        }
        const float beta = last_squared > 0 ? squared / last_squared : 0;
        last_squared = squared;
        accelerate(problem, beta <= 1 ? beta : 0);
    }
}

float SequentialImpulse::square_in_joules(const ContactRows& row, const Impulses& impulses) {
    const auto weigh = [](float x, float mass) { return mass > 0 ? x / mass : 0; };
    float squared = 0;
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        squared += weigh(square(impulses.normal[i]), row.points[i].normal_mass) +
                   weigh(length_squared(impulses.friction[i]), row.points[i].tangent_mass);
    }
    return squared + weigh(length_squared(impulses.rolling), row.rolling_mass) +
           weigh(square(impulses.spinning), row.spinning_mass);
}

void SequentialImpulse::accelerate(const StepProblem& problem, float beta) {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const Impulses extra = Impulses{}.plus(beta, directions_[k]);
        directions_[k] = extra.plus(1, changes_[k]);
        if (beta == 0) continue;
        accumulated_[k] = accumulated_[k].plus(1, extra);
        apply(problem, rows_[k], extra);
    }
}

void SequentialImpulse::load_impulses(const StepProblem& problem, float h) {
    accumulated_.assign(rows_.size(), {});
    bearings_.clear();
    loads_.assign(rows_.size(), 0);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const ContactRows& row = rows_[k];
        const Contact& contact = problem.contacts[row.contact];
        const PointRow& p = row.points[0];
        float gap = p.separation;
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            accumulated_[k].normal[i] = h * contact.points[i].normal_force;
            loads_[k] += accumulated_[k].normal[i];
            gap = min(gap, row.points[i].separation);
        }
        const Vec3 v = relative_velocity(problem.motions[row.body_a], p.r_a,
                                         problem.motions[row.body_b], p.r_b);
        bearings_.push_back({.body_a = row.body_a,
                             .body_b = row.body_b,
                             .normal = row.normal,
                             .gap = gap,
                             .speed = dot(row.normal, v),
                             .size = row.size,
                             .load = loads_[k] / h});
    }
    const float slow = resting_substeps * h * length(problem.gravity);
    remembered_ = loads_;
    if (first_guess_.add_weights(problem, slow, bearings_)) {
        for (std::size_t k = 0; k < rows_.size(); ++k) loads_[k] = h * bearings_[k].load;
    }
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const ContactRows& row = rows_[k];
        const Contact& contact = problem.contacts[row.contact];
        Impulses& sum = accumulated_[k];
        const float share = (loads_[k] - remembered_[k]) / float(row.point_count);
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) sum.normal[i] += share;
        share_evenly(row, sum.normal);
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            const Vec3 friction = h * without_normal(contact.points[i].friction_force, row.normal);
            sum.friction[i] = clamp_length(friction, row.friction * sum.normal[i]);
        }
        sum.rolling = clamp_length(h * without_normal(contact.rolling_torque, row.normal),
                                   row.rolling_friction * loads_[k]);
        const float most = row.spinning_friction * loads_[k];
        sum.spinning = clamp(h * contact.spinning_torque, -most, most);
    }
}

void SequentialImpulse::apply(const StepProblem& problem, const ContactRows& row,
                              const Impulses& impulses) {
    BodyMotion& a = problem.motions[row.body_a];
    BodyMotion& b = problem.motions[row.body_b];
    const Response& response_a = responses_[row.body_a];
    const Response& response_b = responses_[row.body_b];
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        apply_impulse(a, response_a, row.points[i].r_a, b, response_b, row.points[i].r_b,
                      impulses.normal[i] * row.normal + impulses.friction[i]);
    }
    const Vec3 twist = impulses.rolling + impulses.spinning * row.normal;
    apply_twist(a, response_a, b, response_b, twist);
}

void SequentialImpulse::warm_start(const StepProblem& problem) {
    for (std::size_t k = 0; k < rows_.size(); ++k) apply(problem, rows_[k], accumulated_[k]);
}

void SequentialImpulse::solve_velocities(const StepProblem& problem, float h, bool backward) {
    const float inverse_h = 1.0f / h;
    for (std::size_t index = 0; index < rows_.size(); ++index) {
        const std::size_t k = backward ? rows_.size() - 1 - index : index;
        const ContactRows& row = rows_[k];
        Impulses& sum = accumulated_[k];
        BodyMotion& a = problem.motions[row.body_a];
        BodyMotion& b = problem.motions[row.body_b];
        const Response& response_a = responses_[row.body_a];
        const Response& response_b = responses_[row.body_b];
        const Vec3 n = row.normal;

        float load = 0;
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            const PointRow& p = row.points[i];
            const Vec3 v = relative_velocity(a, p.r_a, b, p.r_b) + row.surface_velocity;
            const Vec3 wanted = sum.friction[i] - p.tangent_mass * without_normal(v, n);
            const Vec3 allowed = clamp_length(wanted, row.friction * sum.normal[i]);
            apply_impulse(a, response_a, p.r_a, b, response_b, p.r_b, allowed - sum.friction[i]);
            sum.friction[i] = allowed;
            load += sum.normal[i];
        }
        if (row.rolling_friction > 0 || row.spinning_friction > 0) {
            const Vec3 w = b.angular_velocity - a.angular_velocity;
            const Vec3 rolling = clamp_length(sum.rolling - row.rolling_mass * without_normal(w, n),
                                              row.rolling_friction * load);
            const float most = row.spinning_friction * load;
            const float spinning = clamp(sum.spinning - row.spinning_mass * dot(n, w), -most, most);
            const Vec3 twist = (rolling - sum.rolling) + (spinning - sum.spinning) * n;
            apply_twist(a, response_a, b, response_b, twist);
            sum.rolling = rolling;
            sum.spinning = spinning;
        }
        solve_normal_rows(row, inverse_h, sum, a, b, response_a, response_b);
    }
}

void SequentialImpulse::solve_normal_rows(const ContactRows& row, float inverse_h, Impulses& sum,
                                          BodyMotion& a, BodyMotion& b, const Response& response_a,
                                          const Response& response_b) {
    std::array<float, 4> velocities = {};
    const float linear = dot(row.normal, b.linear_velocity - a.linear_velocity);
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        const PointRow& p = row.points[i];
        velocities[i] = linear + dot(p.turn_b, b.angular_velocity) -
                        dot(p.turn_a, a.angular_velocity) + max(p.separation, 0) * inverse_h;
    }
    std::array<float, 4> changes = sum.normal;
    solve_normals(row, 0, velocities, sum.normal);
    for (std::size_t i = 0; i < 4; ++i) changes[i] = sum.normal[i] - changes[i];
    push_apart(row, changes, a, b, response_a, response_b);
}

void SequentialImpulse::correct_positions(const StepProblem& problem) {
    for (int pass = 0; pass < correction_passes; ++pass) {
        bool corrected = false;
        for (std::size_t index = 0; index < rows_.size(); ++index) {
            const ContactRows& row = rows_[pass % 2 == 1 ? rows_.size() - 1 - index : index];
            BodyMotion& a = problem.motions[row.body_a];
            BodyMotion& b = problem.motions[row.body_b];
            const Response& response_a = responses_[row.body_a];
            const Response& response_b = responses_[row.body_b];
            for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
                const PointRow& p = row.points[i];
                const float s = find_separation(p, row.normal, a, b);
                const float excess = -(s + slop(row));
                if (!(excess > 0)) continue;
                corrected = true;
                const float wanted =
                    min(correction_share * excess, largest_correction_share * row.size);
                const Vec3 push = (wanted * p.normal_mass) * row.normal;
                move_body(a, response_a, -1, push, p.r_a);
                move_body(b, response_b, 1, push, p.r_b);
            }
        }
        if (!corrected) return;
    }
}

void SequentialImpulse::store_impulses(const StepProblem& problem, float h) {
    const float inverse_h = 1.0f / h;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        const Impulses& sum = accumulated_[k];
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
}

}  // namespace cairn

// Restitution; see impact.h.

#include "solver/impact.h"

namespace cairn {

namespace {

// Rounds of impacts in one substep: enough for a rack of balls to pass a shock through.
constexpr int most_rounds = 64;
// Sweeps over the strikes of a round, and the change of speed, as a share of the fastest target,
// that ends them.
constexpr int most_sweeps = 50;
constexpr float settled_share = 1e-5f;
// Work below this share of what was spent is rounding.
constexpr float rounding_share = 1e-4f;

Vec3 free_acceleration(const StepProblem& problem, std::uint32_t body) {
    const BodyInertia& inertia = problem.inertias[body];
    if (inertia.inverse_mass == 0) return {};
    const BodyDrive& drive = problem.drives[body];
    const Vec3 a = drive.gravity_scale * problem.gravity + inertia.inverse_mass * drive.force;
    return {drive.lock.x ? 0 : a.x, drive.lock.y ? 0 : a.y, drive.lock.z ? 0 : a.z};
}

}  // namespace

float rebound_speed(float u, float s, float a, float h, float e) {
    const float q = 0.5f * u * u - a * s + 0.5f * h * a * u;
    // u'^2/2 + h a u'/2 - a s = e^2 q, solved for its larger root; none where the bounce cannot
    // climb to s.
    const float under_root = h * h * a * a + 8.0f * (e * e * q + a * s);
    if (!(under_root > 0)) return 0;
    return max(0, 0.5f * (square_root(under_root) - h * a));
}

void ImpactSolver::choose(std::span<const ContactRows> rows) {
    bouncing_.clear();
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (rows[k].restitution > 0) bouncing_.push_back(std::uint32_t(k));
    }
}

bool ImpactSolver::collect(const StepProblem& problem, std::span<const ContactRows> rows, float h) {
    strikes_.clear();
    for (const std::uint32_t k : bouncing_) {
        const ContactRows& row = rows[k];
        const BodyMotion& a = problem.motions[row.body_a];
        const BodyMotion& b = problem.motions[row.body_b];
        Strike strike;
        bool any = false;
        for (int i = 0; i < row.point_count; ++i) {
            const PointRow& p = row.points[std::size_t(i)];
            const Vec3 v = relative_velocity(a, p.r_a, b, p.r_b);
            const float u = dot(row.normal, v);
            if (!(u < -problem.restitution_threshold)) continue;
            const float acceleration = dot(row.normal, free_acceleration(problem, row.body_b) -
                                                           free_acceleration(problem, row.body_a));
            if (!(p.separation + h * (u + h * acceleration) < 0)) continue;
            strike.strikes[std::size_t(i)] = true;
            strike.before[std::size_t(i)] = v + row.surface_velocity;
            strike.target[std::size_t(i)] =
                rebound_speed(u, p.separation, acceleration, h, row.restitution);
            any = true;
        }
        if (!any) continue;
        strike.row = k;
        strikes_.push_back(strike);
    }
    return !strikes_.empty();
}

float ImpactSolver::solve_round(const StepProblem& problem, std::span<const Response> responses,
                                std::span<const ContactRows> rows, bool backward) {
    float largest_change = 0;
    for (std::size_t k = 0; k < strikes_.size(); ++k) {
        Strike& strike = strikes_[backward ? strikes_.size() - 1 - k : k];
        const ContactRows& row = rows[strike.row];
        BodyMotion& a = problem.motions[row.body_a];
        BodyMotion& b = problem.motions[row.body_b];
        const Response& response_a = responses[row.body_a];
        const Response& response_b = responses[row.body_b];
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            if (!strike.strikes[i]) continue;
            const PointRow& p = row.points[i];
            if (row.friction > 0) {
                const Vec3 v = relative_velocity(a, p.r_a, b, p.r_b) + row.surface_velocity;
                const Vec3 wanted =
                    strike.friction_impulse[i] - p.tangent_mass * without_normal(v, row.normal);
                const Vec3 allowed = clamp_length(wanted, row.friction * strike.normal_impulse[i]);
                apply_impulse(a, response_a, p.r_a, b, response_b, p.r_b,
                              allowed - strike.friction_impulse[i]);
                strike.friction_impulse[i] = allowed;
            }
            const float u = dot(row.normal, relative_velocity(a, p.r_a, b, p.r_b));
            const float sum =
                max(0, strike.normal_impulse[i] + p.normal_mass * (strike.target[i] - u));
            const float change = sum - strike.normal_impulse[i];
            strike.normal_impulse[i] = sum;
            apply_impulse(a, response_a, p.r_a, b, response_b, p.r_b, change * row.normal);
            if (p.normal_mass > 0)
                largest_change = max(largest_change, absolute(change) / p.normal_mass);
        }
    }
    return largest_change;
}

void ImpactSolver::group(const StepProblem& problem, std::span<const ContactRows> rows) {
    works_.resize(problem.motions.size());
    for (const Strike& strike : strikes_) {
        for (const std::uint32_t body : {rows[strike.row].body_a, rows[strike.row].body_b}) {
            works_[body] = {.group = body};
        }
    }
    for (const Strike& strike : strikes_) {
        const ContactRows& row = rows[strike.row];
        // Impulses do not pass through what nothing moves.
        if (problem.inertias[row.body_a].inverse_mass == 0) continue;
        if (problem.inertias[row.body_b].inverse_mass == 0) continue;
        works_[find_group(row.body_b)].group = find_group(row.body_a);
    }
}

std::uint32_t ImpactSolver::find_group(std::uint32_t body) {
    while (works_[body].group != body) {
        works_[body].group = works_[works_[body].group].group;
        body = works_[body].group;
    }
    return body;
}

ImpactSolver::Work& ImpactSolver::find_work(const StepProblem& problem, const ContactRows& row) {
    const bool moves_a = problem.inertias[row.body_a].inverse_mass > 0;
    return works_[find_group(moves_a ? row.body_a : row.body_b)];
}

void ImpactSolver::forbid_gain(const StepProblem& problem, std::span<const Response> responses,
                               std::span<const ContactRows> rows) {
    group(problem, rows);
    for (const Strike& strike : strikes_) {
        const ContactRows& row = rows[strike.row];
        const BodyMotion& a = problem.motions[row.body_a];
        const BodyMotion& b = problem.motions[row.body_b];
        Work& work = find_work(problem, row);
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            if (!strike.strikes[i]) continue;
            const PointRow& p = row.points[i];
            const Vec3 impulse = strike.normal_impulse[i] * row.normal + strike.friction_impulse[i];
            const Vec3 after = relative_velocity(a, p.r_a, b, p.r_b) + row.surface_velocity;
            work.spent += dot(impulse, strike.before[i]);
            work.made += dot(impulse, after - strike.before[i]);
            const float closing = dot(row.normal, strike.before[i]);
            work.due += 0.5f * strike.normal_impulse[i] * max(0, strike.target[i] + closing);
        }
    }
    for (Strike& strike : strikes_) {
        const ContactRows& row = rows[strike.row];
        const Work& work = find_work(problem, row);
        const float allowed = work.due + rounding_share * absolute(work.spent);
        if (work.spent + 0.5f * work.made <= allowed) continue;
        const float kept = work.made > 0 ? clamp(-2.0f * work.spent / work.made, 0, 1) : 0;
        for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
            const PointRow& p = row.points[i];
            const Vec3 impulse = strike.normal_impulse[i] * row.normal + strike.friction_impulse[i];
            apply_impulse(problem.motions[row.body_a], responses[row.body_a], p.r_a,
                          problem.motions[row.body_b], responses[row.body_b], p.r_b,
                          (kept - 1.0f) * impulse);
            strike.normal_impulse[i] = kept * strike.normal_impulse[i];
            strike.friction_impulse[i] = kept * strike.friction_impulse[i];
        }
    }
}

void ImpactSolver::report(const StepProblem& problem, std::span<const ContactRows> rows) const {
    for (const Strike& strike : strikes_) {
        Contact& contact = problem.contacts[rows[strike.row].contact];
        for (std::size_t i = 0; i < std::size_t(contact.point_count); ++i) {
            contact.points[i].normal_impulse += strike.normal_impulse[i];
            contact.points[i].friction_impulse += strike.friction_impulse[i];
        }
    }
}

void ImpactSolver::resolve(const StepProblem& problem, std::span<const Response> responses,
                           std::span<const ContactRows> rows, float h) {
    for (int round = 0; round < most_rounds; ++round) {
        if (!collect(problem, rows, h)) return;
        float fastest = problem.restitution_threshold;
        for (const Strike& strike : strikes_) {
            for (const float target : strike.target) fastest = max(fastest, target);
        }
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            const float change = solve_round(problem, responses, rows, sweep % 2 == 1);
            if (change <= settled_share * fastest) break;
        }
        forbid_gain(problem, responses, rows);
        report(problem, rows);
    }
}

}  // namespace cairn

// Preparing and renewing contact rows; see contact_rows.h.

#include "solver/contact_rows.h"

namespace cairn {

namespace {

// Sweeps over the points of one manifold: four points of a face are then level to within a few
// percent.
constexpr int normal_sweeps = 6;
// The change of a load, as a share of the largest, that ends them.
constexpr float settled_share = 1e-5f;

// 1 / the largest eigenvalue of the 2x2 form q across n; 0 where nothing gives.
template <class Form>
float softest_across(Vec3 n, Form&& q) {
    const Vec3 t = any_perpendicular(n);
    const Vec3 u = cross(n, t);
    const float tt = q(t, t);
    const float uu = q(u, u);
    const float tu = q(t, u);
    const float half_difference = 0.5f * (tt - uu);
    const float largest =
        0.5f * (tt + uu) + square_root(half_difference * half_difference + tu * tu);
    return largest > 0 ? 1.0f / largest : 0;
}

void refresh_point(PointRow& p, const ContactRows& row, const BodyMotion& a, const BodyMotion& b,
                   const Response& response_a, const Response& response_b) {
    const Vec3 n = row.normal;
    const Vec3 arm_a = find_arm(p.arm_a, a.rotation);
    const Vec3 arm_b = find_arm(p.arm_b, b.rotation);
    // The two points were one place when the step began. The common point is halfway along the
    // normal now, and across it where the one is that the contact stays with.
    const Vec3 apart =
        (b.displacement + (arm_b - p.start_b)) - (a.displacement + (arm_a - p.start_a));
    const float open = dot(n, apart);
    const Vec3 slid = apart - open * n;
    const Vec3 halfway = (0.5f * open) * n;
    p.r_a = arm_a + halfway + (row.stays_with_a ? Vec3{} : slid);
    p.r_b = arm_b - halfway - (row.stays_with_a ? slid : Vec3{});
    p.separation = p.start_separation + open;

    p.turn_a = cross(p.r_a, n);
    p.turn_b = cross(p.r_b, n);
    p.spin_a = response_a.inverse_inertia * p.turn_a;
    p.spin_b = response_b.inverse_inertia * p.turn_b;
    const Vec3 inverse_mass = response_a.inverse_mass + response_b.inverse_mass;
    p.tangent_mass = softest_across(n, [&](Vec3 d, Vec3 e) {
        return dot(d, multiply(inverse_mass, e)) +
               dot(cross(p.r_a, d), response_a.inverse_inertia * cross(p.r_a, e)) +
               dot(cross(p.r_b, d), response_b.inverse_inertia * cross(p.r_b, e));
    });
}

void couple_points(ContactRows& row, const Response& response_a, const Response& response_b) {
    const Vec3 n = row.normal;
    const float linear = dot(n, multiply(response_a.inverse_mass + response_b.inverse_mass, n));
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        PointRow& p = row.points[i];
        for (std::size_t j = 0; j <= i; ++j) {
            const PointRow& q = row.points[j];
            const float k = linear + dot(p.turn_a, q.spin_a) + dot(p.turn_b, q.spin_b);
            row.coupling[i][j] = row.coupling[j][i] = k;
        }
        p.normal_mass = row.coupling[i][i] > 0 ? 1.0f / row.coupling[i][i] : 0;
    }
}

}  // namespace

void prepare_rows(const StepProblem& problem, std::vector<ContactRows>& rows) {
    rows.clear();
    for (const std::uint32_t index : problem.active) {
        const Contact& contact = problem.contacts[index];
        const BodyMotion& a = problem.motions[contact.body_a];
        const BodyMotion& b = problem.motions[contact.body_b];
        ContactRows& row = rows.emplace_back();
        row.contact = index;
        row.body_a = contact.body_a;
        row.body_b = contact.body_b;
        row.normal = contact.normal;
        row.surface_velocity = without_normal(contact.surface_velocity, contact.normal);
        row.friction = contact.friction;
        row.restitution = contact.restitution;
        row.rolling_friction = contact.rolling_friction;
        row.spinning_friction = contact.spinning_friction;
        row.size = contact.size;
        row.stays_with_a = contact.stays_with_a;
        row.point_count = contact.point_count;
        for (int i = 0; i < contact.point_count; ++i) {
            const ContactPoint& from = contact.points[std::size_t(i)];
            PointRow& to = row.points[std::size_t(i)];
            to.arm_a = from.arm_a;
            to.arm_b = from.arm_b;
            to.start_a = find_arm(from.arm_a, a.rotation);
            to.start_b = find_arm(from.arm_b, b.rotation);
            to.start_separation = from.separation;
        }
    }
}

void find_responses(const StepProblem& problem, std::vector<Response>& responses) {
    responses.resize(problem.motions.size());
    problem.for_range(responses.size(), 64, [&](int begin, int end) {
        for (auto i = std::size_t(begin); i < std::size_t(end); ++i) {
            responses[i] = problem.inertias[i].inverse_mass == 0
                               ? Response{}
                               : find_response(problem.inertias[i], problem.drives[i],
                                               problem.motions[i].rotation);
        }
    });
}

void refresh_rows(const StepProblem& problem, std::span<const Response> responses,
                  std::span<ContactRows> rows) {
    for (ContactRows& row : rows) {
        const BodyMotion& a = problem.motions[row.body_a];
        const BodyMotion& b = problem.motions[row.body_b];
        const Response& response_a = responses[row.body_a];
        const Response& response_b = responses[row.body_b];
        for (int i = 0; i < row.point_count; ++i) {
            refresh_point(row.points[std::size_t(i)], row, a, b, response_a, response_b);
        }
        couple_points(row, response_a, response_b);
        if (row.rolling_friction > 0 || row.spinning_friction > 0) {
            const SymmetricMat3 turning = response_a.inverse_inertia + response_b.inverse_inertia;
            row.rolling_mass =
                softest_across(row.normal, [&](Vec3 d, Vec3 e) { return dot(d, turning * e); });
            const float about = dot(row.normal, turning * row.normal);
            row.spinning_mass = about > 0 ? 1.0f / about : 0;
        }
    }
}

void solve_normals(const ContactRows& rows, float softness, std::array<float, 4>& velocities,
                   std::array<float, 4>& loads) {
    const auto count = std::size_t(rows.point_count);
    std::array<float, 4> mass = {};
    for (std::size_t i = 0; i < count; ++i) {
        const float m = rows.points[i].normal_mass;
        mass[i] = softness == 0 ? m : m / (1.0f + softness * m);
    }
    float largest_change = 0;
    const auto solve_point = [&](std::size_t i) {
        const float load = max(0, loads[i] - mass[i] * (velocities[i] + softness * loads[i]));
        const float change = load - loads[i];
        loads[i] = load;
        largest_change = max(largest_change, absolute(change));
        // All four, so that it is one vector operation: what is not there couples to nothing.
        for (std::size_t j = 0; j < 4; ++j) velocities[j] += rows.coupling[i][j] * change;
    };
    // Projected Gauss-Seidel to and fro, on these few numbers alone.
    for (int sweep = 0; sweep < normal_sweeps; ++sweep) {
        largest_change = 0;
        if (sweep % 2 == 0) {
            for (std::size_t i = 0; i < count; ++i) solve_point(i);
        } else {
            for (std::size_t i = count; i-- > 0;) solve_point(i);
        }
        if (count == 1) return;
        const float largest_load = max(max(loads[0], loads[1]), max(loads[2], loads[3]));
        if (largest_change <= settled_share * largest_load) return;
    }
}

void push_apart(const ContactRows& row, const std::array<float, 4>& impulses, BodyMotion& a,
                BodyMotion& b, const Response& response_a, const Response& response_b) {
    float sum = 0;
    Vec3 spin_a, spin_b;
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        sum += impulses[i];
        spin_a += impulses[i] * row.points[i].spin_a;
        spin_b += impulses[i] * row.points[i].spin_b;
    }
    push_body(a, response_a, -1, sum * row.normal, spin_a);
    push_body(b, response_b, 1, sum * row.normal, spin_b);
}

void share_evenly(const ContactRows& rows, std::array<float, 4>& loads) {
    if (rows.point_count != 4) return;
    const Vec3 n = rows.normal;
    const Vec3 p0 = rows.points[0].r_b, p1 = rows.points[1].r_b;
    const Vec3 p2 = rows.points[2].r_b, p3 = rows.points[3].r_b;
    // Twice the signed areas of the triangles that leave one point out: weights w with sum w = 0
    // and sum w p = 0 across the normal, so loads along w neither push nor turn.
    const auto area = [n](Vec3 a, Vec3 b, Vec3 c) { return dot(n, cross(b - a, c - a)); };
    const std::array<float, 4> w = {area(p1, p2, p3), -area(p0, p2, p3), area(p0, p1, p3),
                                    -area(p0, p1, p2)};
    const float squared = w[0] * w[0] + w[1] * w[1] + w[2] * w[2] + w[3] * w[3];
    if (!(squared > 0)) return;
    float amount =
        (w[0] * loads[0] + w[1] * loads[1] + w[2] * loads[2] + w[3] * loads[3]) / squared;
    // No further than the first load that would become negative.
    for (std::size_t i = 0; i < 4; ++i) {
        if (amount * w[i] > loads[i]) amount = loads[i] / w[i];
    }
    for (std::size_t i = 0; i < 4; ++i) loads[i] = max(0, loads[i] - amount * w[i]);
}

}  // namespace cairn

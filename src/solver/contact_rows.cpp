// Preparing and renewing contact rows; see contact_rows.h.

#include "solver/contact_rows.h"

namespace cairn {

namespace {

// Sweeps over the points of one manifold: four points of a face are then level to within a few
// percent.
constexpr int normal_sweeps = 6;
// The change of a load, as a share of the largest, that ends them.
constexpr float settled_share = 1e-5f;

// Eigenvalues across n that differ by less than this share of the larger are one.
constexpr float alike_share = 1e-5f;

struct Across {
    float softest = 0;  // 1 / the largest eigenvalue; 0 where nothing gives
    bool alike = false;
};

// Of the 2x2 form q across n, by its values along two directions across it.
Across find_across(float tt, float uu, float tu) {
    const float half_difference = 0.5f * (tt - uu);
    const float half_spread = square_root(half_difference * half_difference + tu * tu);
    const float largest = 0.5f * (tt + uu) + half_spread;
    if (!(largest > 0)) return {};
    return {1.0f / largest, half_spread <= alike_share * largest};
}

void follow_point(PointRow& p, const PointStart& start, const ContactRows& row, const BodyMotion& a,
                  const BodyMotion& b, const Response& response_a, const Response& response_b) {
    const Vec3 n = row.normal;
    const Vec3 arm_a = find_arm(start.arm_a, a.rotation);
    const Vec3 arm_b = find_arm(start.arm_b, b.rotation);
    // The two points were one place when the step began. The common point is halfway along the
    // normal now, and across it where the one is that the contact stays with.
    const Vec3 apart =
        (b.displacement + (arm_b - start.start_b)) - (a.displacement + (arm_a - start.start_a));
    const float open = dot(n, apart);
    const Vec3 slid = apart - open * n;
    const Vec3 halfway = (0.5f * open) * n;
    p.r_a = arm_a + halfway + (row.stays_with_a ? Vec3{} : slid);
    p.r_b = arm_b - halfway - (row.stays_with_a ? slid : Vec3{});
    p.separation = start.start_separation + open;

    p.turn_a = cross(p.r_a, n);
    p.turn_b = cross(p.r_b, n);
    p.spin_a = response_a.inverse_inertia * p.turn_a;
    p.spin_b = response_b.inverse_inertia * p.turn_b;
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

void prepare_row(const StepProblem& problem, const Contact& contact, std::uint32_t index,
                 ContactRows& row) {
    const BodyMotion& a = problem.motions[contact.body_a];
    const BodyMotion& b = problem.motions[contact.body_b];
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
    row.rolling_mass = row.spinning_mass = 0;
    row.point_count = contact.point_count;
    // Points that are not there couple to nothing and weigh nothing.
    row.coupling = {};
    for (std::size_t i = 0; i < 4; ++i) row.points[i].normal_mass = 0;
    for (std::size_t i = 0; i < std::size_t(contact.point_count); ++i) {
        const ContactPoint& from = contact.points[i];
        row.starts[i] = {.arm_a = from.arm_a,
                         .arm_b = from.arm_b,
                         .start_a = find_arm(from.arm_a, a.rotation),
                         .start_b = find_arm(from.arm_b, b.rotation),
                         .start_separation = from.separation};
    }
}

}  // namespace

void prepare_rows(const StepProblem& problem, std::span<const std::uint32_t> contacts,
                  std::span<ContactRows> rows) {
    problem.for_range(contacts.size(), 32, [&](int begin, int end) {
        for (auto k = std::size_t(begin); k < std::size_t(end); ++k) {
            const std::uint32_t index = contacts[k];
            prepare_row(problem, problem.contacts[index], index, rows[k]);
        }
    });
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

void follow_bodies(const StepProblem& problem, std::span<const Response> responses,
                   ContactRows& row) {
    const BodyMotion& a = problem.motions[row.body_a];
    const BodyMotion& b = problem.motions[row.body_b];
    const Response& response_a = responses[row.body_a];
    const Response& response_b = responses[row.body_b];
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        follow_point(row.points[i], row.starts[i], row, a, b, response_a, response_b);
    }
    couple_points(row, response_a, response_b);
}

void find_friction_masses(std::span<const Response> responses, ContactRows& row) {
    const Response& a = responses[row.body_a];
    const Response& b = responses[row.body_b];
    const Vec3 t = any_perpendicular(row.normal);
    const Vec3 u = cross(row.normal, t);
    const Vec3 inverse_mass = a.inverse_mass + b.inverse_mass;
    const float linear_tt = dot(t, multiply(inverse_mass, t));
    const float linear_uu = dot(u, multiply(inverse_mass, u));
    const float linear_tu = dot(t, multiply(inverse_mass, u));
    for (std::size_t i = 0; i < std::size_t(row.point_count); ++i) {
        PointRow& p = row.points[i];
        const Vec3 t_a = cross(p.r_a, t), u_a = cross(p.r_a, u);
        const Vec3 t_b = cross(p.r_b, t), u_b = cross(p.r_b, u);
        const Vec3 spin_u_a = a.inverse_inertia * u_a, spin_u_b = b.inverse_inertia * u_b;
        const Across across = find_across(
            linear_tt + dot(t_a, a.inverse_inertia * t_a) + dot(t_b, b.inverse_inertia * t_b),
            linear_uu + dot(u_a, spin_u_a) + dot(u_b, spin_u_b),
            linear_tu + dot(t_a, spin_u_a) + dot(t_b, spin_u_b));
        p.tangent_mass = across.softest;
        p.alike_across = across.alike;
    }
    if (row.rolling_friction > 0 || row.spinning_friction > 0) {
        const SymmetricMat3 turning = a.inverse_inertia + b.inverse_inertia;
        const Vec3 turning_t = turning * t;
        row.rolling_mass =
            find_across(dot(t, turning_t), dot(u, turning * u), dot(u, turning_t)).softest;
        const float about = dot(row.normal, turning * row.normal);
        row.spinning_mass = about > 0 ? 1.0f / about : 0;
    }
}

void refresh_rows(const StepProblem& problem, std::span<const Response> responses,
                  std::span<ContactRows> rows) {
    for (ContactRows& row : rows) {
        follow_bodies(problem, responses, row);
        find_friction_masses(responses, row);
    }
}

namespace {

// `soft` where softness is not zero.
template <bool soft>
void sweep_points(const ContactRows& rows, float softness, std::array<float, 4>& velocities,
                  std::array<float, 4>& loads) {
    std::array<float, 4> mass, pull = {};
    for (std::size_t i = 0; i < 4; ++i) {
        const float m = rows.points[i].normal_mass;
        mass[i] = soft ? m / (1.0f + softness * m) : m;
        pull[i] = soft ? mass[i] * softness : 0;
    }
    std::array<float, 4> u = velocities;
    std::array<float, 4> l = loads;
    float largest_change = 0;
    const auto solve_point = [&](std::size_t i) {
        // No further than to a load of zero. From one point's speed to the next point's are four
        // operations, which is what these sweeps take.
        float change = -(mass[i] * u[i]);
        if (soft) change = change - pull[i] * l[i];
        change = max(-l[i], change);
        l[i] += change;
        largest_change = max(largest_change, absolute(change));
        for (std::size_t j = 0; j < 4; ++j) u[j] += rows.coupling[i][j] * change;
    };
    // Projected Gauss-Seidel to and fro, on these few numbers alone.
    for (int sweep = 0; sweep < normal_sweeps; ++sweep) {
        largest_change = 0;
        if (sweep % 2 == 0) {
            for (std::size_t i = 0; i < 4; ++i) solve_point(i);
        } else {
            for (std::size_t i = 4; i-- > 0;) solve_point(i);
        }
        const float largest_load = max(max(l[0], l[1]), max(l[2], l[3]));
        if (largest_change <= settled_share * largest_load) break;
    }
    velocities = u;
    loads = l;
}

}  // namespace

void solve_normals(const ContactRows& rows, float softness, std::array<float, 4>& velocities,
                   std::array<float, 4>& loads) {
    if (rows.point_count == 1) {
        // At once: no point leans on another.
        const float m = rows.points[0].normal_mass;
        const float softened = softness == 0 ? m : m / (1.0f + softness * m);
        const float change = max(-loads[0], -(softened * (velocities[0] + softness * loads[0])));
        loads[0] += change;
        velocities[0] += rows.coupling[0][0] * change;
        return;
    }
    if (softness == 0)
        sweep_points<false>(rows, softness, velocities, loads);
    else
        sweep_points<true>(rows, softness, velocities, loads);
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

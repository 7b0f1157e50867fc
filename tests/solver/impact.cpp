// The speed of a rebound, what a blow may do to energy, and what is shared between solvers.

#include "solver/impact.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

using namespace cairn;

namespace {

// A light cube in a corner of floor and wall, struck from above by a heavy, spinning one at two
// places with two normals: the blows answer each other, and friction takes part.
class Corner {
public:
    explicit Corner(std::uint32_t seed) : state_(seed) {
        inertias_[1] = make_inertia({.mass = 50, .inertia = {4, 4, 6, 0, 0, 0}});
        inertias_[2] = make_inertia({.mass = 800, .inertia = {56, 73, 50, 0, 0, 0}});
        motions_[2].linear_velocity = {roll(6), -8, roll(6)};
        motions_[2].angular_velocity = {roll(12), roll(12), roll(12)};
        add_row(0, 1, {0, 1, 0}, {{roll(0.4f), -0.2f, 0.3f}, {roll(0.4f), -0.2f, -0.3f}}, {});
        add_row(0, 1, {0, 0, -1}, {{roll(0.4f), roll(0.2f), 0.3f}}, {});
        for (int i = 0; i < 2; ++i) {
            const Vec3 toward_light = normalize_or({roll(0.3f), -1, roll(0.6f)}, {0, -1, 0});
            add_row(2, 1, toward_light, {{roll(0.4f), 0.2f, roll(0.3f)}},
                    {roll(0.5f), -0.4f, roll(0.5f)});
        }
    }

    void strike() {
        StepProblem problem;
        problem.motions = motions_;
        problem.inertias = inertias_;
        problem.drives = drives_;
        problem.contacts = contacts_;
        problem.dt = 1.0 / 60;
        std::vector<Response> responses;
        find_responses(problem, responses);
        refresh_rows(problem, responses, rows_);
        ImpactSolver impacts;
        impacts.choose(rows_);
        impacts.resolve(problem, responses, rows_, 1.0f / 60);
    }

    double kinetic_energy() const {
        double sum = 0;
        for (std::size_t i = 1; i < motions_.size(); ++i) {
            const Vec3 v = motions_[i].linear_velocity;
            const Vec3 w = motions_[i].angular_velocity;
            sum += 0.5 * double(inertias_[i].mass) * double(dot(v, v));
            sum += 0.5 * double(dot(w, inertias_[i].inertia * w));
        }
        return sum;
    }

private:
    float roll(float range) {
        state_ = state_ * 1664525u + 1013904223u;
        return range * (float(state_ >> 8u) / 8388608.0f - 1);
    }

    void add_row(std::uint32_t a, std::uint32_t b, Vec3 normal, const std::vector<Vec3>& arms_b,
                 Vec3 arm_a) {
        ContactRows& row = rows_.emplace_back();
        row.contact = std::uint32_t(contacts_.size());
        row.body_a = a;
        row.body_b = b;
        row.normal = normal;
        row.friction = 0.7f;
        row.restitution = 0.6f;
        row.point_count = int(arms_b.size());
        for (std::size_t i = 0; i < arms_b.size(); ++i) {
            row.starts[i].arm_a.offset = row.starts[i].start_a = arm_a;
            row.starts[i].arm_b.offset = row.starts[i].start_b = arms_b[i];
        }
        contacts_.emplace_back();
    }

    std::uint32_t state_;
    std::vector<BodyMotion> motions_ = std::vector<BodyMotion>(3);
    std::vector<BodyInertia> inertias_ = std::vector<BodyInertia>(3);
    std::vector<BodyDrive> drives_ = std::vector<BodyDrive>(3);
    std::vector<Contact> contacts_;
    std::vector<ContactRows> rows_;
};

}  // namespace

TEST_CASE("a light body struck into a corner by a heavy one takes no energy from nowhere") {
    double worst = 0;
    for (std::uint32_t seed = 0; seed < 1000; ++seed) {
        Corner corner(seed);
        const double before = corner.kinetic_energy();
        corner.strike();
        worst = std::max(worst, corner.kinetic_energy() / before);
    }
    // Each of the rounds may add a ten thousandth by rounding.
    CHECK(worst < 1.005);
}

TEST_CASE("without acceleration a body rebounds with e times its speed") {
    CHECK(double(rebound_speed(-2, 0.01f, 0, 1.0f / 60, 0.5f)) == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE(
    "in discrete free fall a bounce climbs to e^2 of its height, wherever in the step it strikes") {
    // A point falls from 1 m under g with v += g h, x += h v; e = 0.8 must bring it to 0.64 m.
    for (const double offset : {0.0, 0.01, 0.02, 0.03, 0.04, 0.05}) {
        const double h = 1.0 / 60, g = 9.81;
        double x = 1 + offset, v = 0, top = 0;
        bool bounced = false;
        for (int i = 0; i < 120; ++i) {
            if (!bounced && x + h * (v - g * h) < 0) {
                v = double(rebound_speed(float(v), float(x), float(-g), float(h), 0.8f));
                bounced = true;
            }
            v -= g * h;
            x += h * v;
            if (bounced) top = std::max(top, x);
            if (bounced && v < 0) break;
        }
        // At the highest sample 0 <= v <= g h, so that x = Q/g - v (v - g h) / (2 g) lies above the
        // parabola's top Q/g, by at most g h^2 / 8.
        CHECK(top >= 0.64 * (1 + offset) - 1e-5);
        CHECK(top <= 0.64 * (1 + offset) + g * h * h / 8 + 1e-5);
    }
}

TEST_CASE("four corners of a level box share its weight evenly, however the load was found") {
    ContactRows row;
    row.normal = {0, 1, 0};
    row.point_count = 4;
    row.points[0].r_b = {-0.5f, -0.5f, -0.5f};
    row.points[1].r_b = {0.5f, -0.5f, -0.5f};
    row.points[2].r_b = {0.5f, -0.5f, 0.5f};
    row.points[3].r_b = {-0.5f, -0.5f, 0.5f};
    std::array<float, 4> loads = {4, 0, 4, 0};
    share_evenly(row, loads);
    for (const float load : loads) CHECK(double(load) == doctest::Approx(2).epsilon(1e-6));

    // What presses on one side alone stays there: nothing in it is undetermined.
    loads = {3, 3, 0, 0};
    share_evenly(row, loads);
    CHECK(loads == std::array<float, 4>{3, 3, 0, 0});
}

TEST_CASE("friction's bound is a circle") {
    const Vec3 v = clamp_length({3, 0, 4}, 1);
    CHECK(double(v.x) == doctest::Approx(0.6).epsilon(1e-6));
    CHECK(double(v.z) == doctest::Approx(0.8).epsilon(1e-6));
    CHECK(clamp_length({3, 0, 4}, 6) == Vec3{3, 0, 4});
}

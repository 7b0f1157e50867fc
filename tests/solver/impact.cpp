// The speed of a rebound, and what is shared between solvers.

#include "solver/impact.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace cairn;

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

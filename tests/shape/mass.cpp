// Mass properties against their closed forms, and against sums over small cells.

#include <doctest/doctest.h>

#include <numbers>

#include "../narrow/judge.h"
#include "shape/mass.h"

using namespace cairn;
using namespace cairn::judge;
using doctest::Approx;

namespace {

MassProperties mass_of(std::initializer_list<ShapeDef> shapes) {
    return combined_mass_properties({shapes.begin(), shapes.size()});
}

}  // namespace

TEST_CASE("B01: a box weighs rho a b c and turns with m/12 (b^2 + c^2)") {
    const MassProperties m = mass_of({{.geometry = Box{{0.5f, 1, 1.5f}}, .density = 2000}});
    CHECK(double(m.mass) == Approx(2000.0 * 1 * 2 * 3).epsilon(1e-6));
    CHECK(double(m.inertia.xx) == Approx(12000.0 / 12 * (4 + 9)).epsilon(1e-6));
    CHECK(double(m.inertia.yy) == Approx(12000.0 / 12 * (1 + 9)).epsilon(1e-6));
    CHECK(double(m.inertia.zz) == Approx(12000.0 / 12 * (1 + 4)).epsilon(1e-6));
    CHECK(m.inertia.xy == 0);
    CHECK(m.center_of_mass == Vec3{});
}

TEST_CASE("B01: a ball weighs 4/3 pi r^3 rho and turns with 2/5 m r^2") {
    const MassProperties m = mass_of({{.geometry = Sphere{0.3f}, .density = 500}});
    const double r = double(0.3f), mass = 500 * 4.0 / 3 * std::numbers::pi * r * r * r;
    CHECK(double(m.mass) == Approx(mass).epsilon(1e-6));
    CHECK(double(m.inertia.zz) == Approx(0.4 * mass * r * r).epsilon(1e-6));
}

TEST_CASE("B07: a dumbbell of two balls r 0.1, 1 kg at +-0.5 m: Iyy 0.508, Ixx 0.008") {
    const float density = float(1 / (4.0 / 3 * std::numbers::pi * 0.001));
    const auto ball = [&](float x) {
        return ShapeDef{
            .geometry = Sphere{0.1f}, .local_pose = {{x, 0, 0}, {}}, .density = density};
    };
    const MassProperties m = mass_of({ball(-0.5f), ball(0.5f)});
    CHECK(double(m.mass) == Approx(2).epsilon(1e-6));
    CHECK(double(m.inertia.xx) == Approx(0.008).epsilon(1e-6));
    CHECK(double(m.inertia.yy) == Approx(0.508).epsilon(1e-6));
    CHECK(double(m.inertia.zz) == Approx(0.508).epsilon(1e-6));

    // A kilometre from the body's origin, nothing cancels.
    const auto far = [&](float x) {
        return ShapeDef{
            .geometry = Sphere{0.1f}, .local_pose = {{1000 + x, 0, 0}, {}}, .density = density};
    };
    const MassProperties away = mass_of({far(-0.5f), far(0.5f)});
    CHECK(away.center_of_mass == Vec3{1000, 0, 0});
    CHECK(double(away.inertia.xx) == Approx(0.008).epsilon(1e-6));
    CHECK(double(away.inertia.yy) == Approx(0.508).epsilon(1e-6));
}

TEST_CASE("a box turned by any rotation has the tensor R I R^T") {
    Random random(6);
    for (int i = 0; i < 200; ++i) {
        const Quat q = random.rotation();
        const Box box{{0.2f, 0.5f, 1}};
        const MassProperties flat = mass_of({{.geometry = box}});
        const MassProperties turned = mass_of({{.geometry = box, .local_pose = {{1, 2, 3}, q}}});
        const SymmetricMat3 expected = rotate(to_matrix(q), flat.inertia);
        const float scale = flat.inertia.xx;
        CHECK(absolute(turned.inertia.xx - expected.xx) < 2e-6f * scale);
        CHECK(absolute(turned.inertia.yy - expected.yy) < 2e-6f * scale);
        CHECK(absolute(turned.inertia.xy - expected.xy) < 2e-6f * scale);
        CHECK(absolute(turned.inertia.xz - expected.xz) < 2e-6f * scale);
        CHECK(absolute(turned.inertia.yz - expected.yz) < 2e-6f * scale);
        CHECK(turned.center_of_mass == Vec3{1, 2, 3});
    }
}

TEST_CASE("two half boxes, unequal and apart, weigh what their cells weigh") {
    // An L of a 2 x 1 x 1 beam and a 1 x 1 x 1 block on its end, of other density; cells of 0.1.
    const ShapeDef beam{.geometry = Box{{1, 0.5f, 0.5f}}, .density = 1000};
    const ShapeDef block{.geometry = Box{{0.5f, 0.5f, 0.5f}},
                         .local_pose = {{0.5f, 1, 0}, turn({0, 0, 1}, 0)},
                         .density = 3000};
    const MassProperties m = mass_of({beam, block});
    double mass = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    const double h = 0.1, cell_moment = h * h / 6;  // of a cell about its own middle, per mass
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j)
            for (int k = 0; k < 10; ++k) {
                const double px = -1 + h * (i + 0.5), py = -0.5 + h * (j + 0.5),
                             pz = -0.5 + h * (k + 0.5);
                if (py > 0.5 && px < 0) continue;
                const double cell = (py > 0.5 ? 3000 : 1000) * h * h * h;
                mass += cell, x += cell * px, y += cell * py;
                xx += cell * (py * py + pz * pz + cell_moment);
                yy += cell * (px * px + pz * pz + cell_moment);
                xy -= cell * px * py;
            }
    x /= mass, y /= mass;
    CHECK(double(m.mass) == Approx(mass).epsilon(1e-6));
    CHECK(double(m.center_of_mass.x) == Approx(x).epsilon(1e-6));
    CHECK(double(m.center_of_mass.y) == Approx(y).epsilon(1e-6));
    CHECK(double(m.inertia.xx) == Approx(xx - mass * y * y).epsilon(1e-6));
    CHECK(double(m.inertia.yy) == Approx(yy - mass * x * x).epsilon(1e-6));
    CHECK(double(m.inertia.xy) == Approx(xy + mass * x * y).epsilon(1e-6));
}

TEST_CASE("a plane weighs nothing, alone or among others") {
    CHECK(mass_of({{.geometry = Plane{}}}) == MassProperties{});
    CHECK(mass_of({}) == MassProperties{});
    const ShapeDef ball{.geometry = Sphere{1}};
    CHECK(mass_of({{.geometry = Plane{}, .local_pose = {{5, 5, 5}, {}}}, ball}) == mass_of({ball}));
}

TEST_CASE(
    "B02: a capsule r 0.5, h 2 of density 1 weighs 2.0943951, Ixx 0.665625 m, Iyy 0.11875 m") {
    const MassProperties m = mass_of({{.geometry = Capsule{0.5f, 2}, .density = 1}});
    const double mass = 2.0943951;
    CHECK(double(m.mass) == Approx(mass).epsilon(1e-6));
    CHECK(double(m.inertia.xx) == Approx(0.665625 * mass).epsilon(1e-6));
    CHECK(double(m.inertia.yy) == Approx(0.11875 * mass).epsilon(1e-6));
    CHECK(m.inertia.zz == m.inertia.xx);
    CHECK(m.center_of_mass == Vec3{});
}

TEST_CASE("B02: a capsule without a cylinder is the ball, and a long one nearly the rod") {
    const MassProperties ball = mass_of({{.geometry = Sphere{0.3f}, .density = 500}});
    const MassProperties short_one = mass_of({{.geometry = Capsule{0.3f, 0}, .density = 500}});
    CHECK(double(short_one.mass) == Approx(double(ball.mass)).epsilon(1e-6));
    CHECK(double(short_one.inertia.xx) == Approx(double(ball.inertia.xx)).epsilon(1e-6));
    CHECK(double(short_one.inertia.yy) == Approx(double(ball.inertia.yy)).epsilon(1e-6));
    const MassProperties rod = mass_of({{.geometry = Capsule{0.001f, 10}}});
    CHECK(double(rod.inertia.xx) == Approx(double(rod.mass) * 100 / 12).epsilon(1e-3));
}

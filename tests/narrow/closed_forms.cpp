// Pairs with a closed form, against the closed form.

#include <doctest/doctest.h>

#include "judge.h"

using namespace cairn;
using namespace cairn::judge;
using doctest::Approx;

namespace {

// What a ball and a box at the origin make, worked in binary64.
double separation_of_ball(V h, V c, double r) {
    const V q = {std::abs(c.x) - h.x, std::abs(c.y) - h.y, std::abs(c.z) - h.z};
    if (q.x <= 0 && q.y <= 0 && q.z <= 0) return std::max({q.x, q.y, q.z}) - r;
    return length(V{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)}) - r;
}

}  // namespace

TEST_CASE("C02: two balls are as far apart as their centres less their radii") {
    for (NarrowPhase method : methods) {
        const Axis apart = axis_of(Sphere{1}, Sphere{0.5f}, {{2.5f, 0, 0}, {}}, method);
        CHECK(apart.separation == Approx(1.0).epsilon(1e-6));
        CHECK(apart.normal == Vec3{1, 0, 0});

        const Axis peer = axis_of(Sphere{1}, Sphere{1}, {{3, 0, 0}, {}}, method);
        CHECK(peer.separation == Approx(1).epsilon(1e-6));
        CHECK(peer.point_a == Vec3{1, 0, 0});
        CHECK(peer.point_b == Vec3{-1, 0, 0});
        CHECK(axis_of(Sphere{3}, Sphere{3}, {{4, 0, 0}, {}}, method).separation ==
              Approx(-2).epsilon(1e-6));
    }
}

TEST_CASE("C02: concentric balls part along some unit normal, by both radii") {
    const Axis axis = axis_of(Sphere{1}, Sphere{0.5f}, {}, NarrowPhase::Sat);
    CHECK(axis.separation == -1.5f);
    CHECK(length(axis.normal) == 1.0f);
    CHECK(is_finite(axis.point_a));
    // Centres so near that their squared distance underflows still give a unit normal.
    const Axis near = axis_of(Sphere{1}, Sphere{1}, {{1e-30f, -1e-30f, 0}, {}}, NarrowPhase::Sat);
    CHECK(length(near.normal) == Approx(1).epsilon(1e-6));
    CHECK(near.normal.x > 0.7f);
}

TEST_CASE("C03: a ball leaves a box by the nearest face, edge or corner, to 1e-5, in 10^4 places") {
    Random random(3);
    const Box box{{1, 2, 3}};
    const Sphere ball{0.5f};
    double worst = 0, worst_witness = 0;
    int inside = 0, corner = 0;
    for (int i = 0; i < 10000; ++i) {
        const Vec3 c = {random.real(-2, 2), random.real(-3, 3), random.real(-4, 4)};
        const Axis axis = axis_of(box, ball, {c, random.rotation()}, NarrowPhase::Sat);
        const double expected = separation_of_ball({1, 2, 3}, wide(c), 0.5);
        worst = std::max(worst, std::abs(double(axis.separation) - expected));
        // The witnesses lie on the surfaces, across from each other.
        const V gap = wide(c) + wide(axis.point_b) - wide(axis.point_a);
        worst_witness =
            std::max(worst_witness, length(gap - double(axis.separation) * wide(axis.normal)));
        worst_witness = std::max(worst_witness, std::abs(double(length(axis.normal)) - 1));
        inside += expected < -0.5;
        corner += std::abs(c.x) > 1 && std::abs(c.y) > 2 && std::abs(c.z) > 3;
    }
    CHECK(worst < 1e-5);
    CHECK(worst_witness < 1e-5);
    CHECK(inside > 500);
    CHECK(corner > 100);
}

TEST_CASE("C03: a ball whose centre is inside leaves by the face it is nearest to") {
    const Axis axis =
        axis_of(Box{{1, 2, 3}}, Sphere{0.5f}, {{0.2f, -1.9f, 1}, {}}, NarrowPhase::Sat);
    CHECK(axis.normal == Vec3{0, -1, 0});
    CHECK(axis.separation == Approx(-0.6));
    // On the surface to rounding, the face decides and not the rounding.
    const Axis on = axis_of(Box{{1, 2, 3}}, Sphere{0.5f},
                            {{std::nextafter(1.0f, 2.0f), 0.3f, 0.7f}, {}}, NarrowPhase::Sat);
    CHECK(on.normal == Vec3{1, 0, 0});
    CHECK(on.separation == Approx(-0.5));
    const Axis on_edge = axis_of(
        Box{{1, 2, 3}}, Sphere{0.5f},
        {{std::nextafter(1.0f, 2.0f), std::nextafter(2.0f, 3.0f), 0.7f}, {}}, NarrowPhase::Sat);
    CHECK((on_edge.normal == Vec3{1, 0, 0} || on_edge.normal == Vec3{0, 1, 0}));
}

TEST_CASE("a plane and a ball: height of the centre less the radius, either way round") {
    const Plane plane{{0, 0.6f, 0.8f}, 2};
    const Pose ball = {{5, 4, 3}, {}};
    // 0.6 * 4 + 0.8 * 3 - 2 = 2.8
    const Axis axis = axis_of(plane, Sphere{1}, ball, NarrowPhase::Sat);
    CHECK(axis.separation == Approx(1.8));
    CHECK(axis.normal == plane.normal);
    CHECK(dot(axis.point_a, plane.normal) == Approx(2));
    const Axis back = axis_of(Sphere{1}, plane, inverse(ball), NarrowPhase::Sat);
    CHECK(back.separation == axis.separation);
    CHECK(back.normal == -plane.normal);
    CHECK(back.point_a == axis.point_b);
}

TEST_CASE("a plane and a box: the lowest vertex, in 2000 poses") {
    Random random(5);
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
        const Box box{{random.real(0.1, 2), random.real(0.1, 2), random.real(0.1, 2)}};
        const Plane plane{random.direction(), random.real(-1, 1)};
        const Pose pose = {random.vector(3), random.rotation()};
        const WideBox wide_box(box, pose);
        double lowest = 1e300;
        for (const V& v : wide_box.vertices()) {
            lowest = std::min(lowest, dot(v, wide(plane.normal)) - double(plane.offset));
        }
        const Axis axis = axis_of(plane, box, pose, NarrowPhase::Sat);
        worst = std::max(worst, std::abs(double(axis.separation) - lowest));
        const Axis back = axis_of(box, plane, inverse(pose), NarrowPhase::Sat);
        worst = std::max(worst, std::abs(double(back.separation) - lowest));
    }
    CHECK(worst < 5e-6);
}

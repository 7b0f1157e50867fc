// C13: touching, coplanar, identical, needle, plate, tiny, huge, and very unequal shapes: every
// answer is finite, found in fewer than 64 rounds, and right to 1e-4 of the shapes' size.

#include <doctest/doctest.h>

#include "judge.h"
#include "narrow/epa.h"
#include "narrow/gjk.h"

using namespace cairn;
using namespace cairn::judge;
using doctest::Approx;

namespace {

constexpr double scales[] = {1e-2, 0.1, 1, 10, 1e3};

Box scaled(double s, double x, double y, double z) {
    return Box{{float(s * x), float(s * y), float(s * z)}};
}

void check_sane(const Axis& axis) {
    CHECK(is_finite(axis.normal));
    CHECK(is_finite(axis.separation));
    CHECK(is_finite(axis.point_a));
    CHECK(is_finite(axis.point_b));
    CHECK(double(length(axis.normal)) == Approx(1).epsilon(1e-5));
}

int rounds_of(const Box& a, const Box& b, const Pose& pose) {
    const MinkowskiDifference difference(convex_shape(a), convex_shape(b), pose);
    const GjkResult gjk =
        find_closest_points(difference, widen(pose.position + Vec3{0, 1e-30f, 0}));
    return std::max(gjk.rounds, gjk.overlap ? find_penetration(difference, gjk.simplex).rounds : 0);
}

}  // namespace

TEST_CASE("C13: touching, coplanar and identical cubes at every scale") {
    struct Case {
        double x, y, z, separation;
    };
    // In units of the cube's edge.
    constexpr Case cases[] = {{1, 0, 0, 0},         {1, 0.5, 0.25, 0},   {1, 1, 0, 0},
                              {1, 1, 1, 0},         {1 + 1e-6, 0, 0, 0}, {0.3, 0, 0, -0.7},
                              {0, 0, 0, -1},        {0, 1e-7, 0, -1},    {0, 0, 2, 1},
                              {0.5, 0.5, 0.5, -0.5}};
    for (double s : scales)
        for (const Case& c : cases)
            for (NarrowPhase method : methods) {
                CAPTURE(s);
                CAPTURE(c.x);
                CAPTURE(c.z);
                CAPTURE(int(method));
                const Box box = scaled(s, 0.5, 0.5, 0.5);
                const Pose pose = {{float(s * c.x), float(s * c.y), float(s * c.z)}, {}};
                const Axis axis = axis_of(box, box, pose, method);
                check_sane(axis);
                CHECK(std::abs(double(axis.separation) / s - c.separation) < 3e-6);
                CHECK(rounds_of(box, box, pose) < 64);
            }
}

TEST_CASE(
    "C13: needles and plates, in random poses at every scale, against the hull of differences") {
    Random random(31);
    const double shapes[][3] = {{0.5, 5e-4, 5e-4}, {5, 5, 5e-4}, {0.5, 0.5, 0.5}};
    for (double s : scales) {
        double worst[2] = {};
        int rounds = 0, overlapping = 0;
        for (int i = 0; i < 60; ++i) {
            const auto& pa = shapes[i % 3];
            const auto& pb = shapes[i / 3 % 3];
            const Box a = scaled(s, pa[0], pa[1], pa[2]), b = scaled(s, pb[0], pb[1], pb[2]);
            const Pose pose = {float(s) * random.vector(i % 2 ? 0.3 : 1e-3), random.rotation()};
            const WideBox wide_a(a, {}), wide_b(b, pose);
            double truth = separation_by_hull(wide_a, wide_b);
            if (truth > 0) truth = distance_by_features(wide_a, wide_b);
            overlapping += truth < 0;
            for (NarrowPhase method : methods) {
                const Axis axis = axis_of(a, b, pose, method);
                check_sane(axis);
                double& error = worst[method == NarrowPhase::GjkEpa];
                error = std::max(error, std::abs(double(axis.separation) - truth) / s);
            }
            rounds = std::max(rounds, rounds_of(a, b, pose));
        }
        CAPTURE(s);
        CHECK(worst[0] < 1e-5);
        CHECK(worst[1] < 1e-5);
        CHECK(rounds < 64);
        CHECK(overlapping > 15);
    }
}

TEST_CASE("C13: nearly parallel needles and plates keep their edge axes") {
    Random random(32);
    double worst[2] = {};
    for (int i = 0; i < 60; ++i) {
        const Box a = scaled(1, 0.5, 5e-4, 5e-4), b = i % 2 ? a : scaled(1, 5, 5, 5e-4);
        const Pose pose = {random.vector(4e-4), turn(random.direction(), random.uniform(0, 5e-3))};
        double truth = separation_by_hull(WideBox(a, {}), WideBox(b, pose));
        if (truth > 0) truth = distance_by_features(WideBox(a, {}), WideBox(b, pose));
        for (NarrowPhase method : methods) {
            double& error = worst[method == NarrowPhase::GjkEpa];
            error =
                std::max(error, std::abs(double(axis_of(a, b, pose, method).separation) - truth));
        }
    }
    CHECK(worst[0] < 1e-4);
    CHECK(worst[1] < 1e-4);
}

TEST_CASE(
    "C13: a small box on a ground a thousand times its size is seen to a millionth of its own") {
    for (NarrowPhase method : methods)
        for (double tilt : {0.0, 1e-7, 1e-4}) {
            const Quat q = turn({0, 1, 0}, 0.3) * turn({1, 0, 0}, tilt);
            const Pose pose = {{300.3f, 1.499f, -200.7f}, q};
            const Box ground{{400, 1, 400}}, box{{0.5f, 0.5f, 0.5f}};
            const Axis axis = axis_of(ground, box, pose, method);
            CHECK(axis.normal == Vec3{0, 1, 0});
            const double truth =
                separation_along(WideBox(ground, {}), WideBox(box, pose), {0, 1, 0});
            CHECK(std::abs(double(axis.separation) - truth) < 1e-6);
        }
}

TEST_CASE("C13: a vertex exactly on the other's vertex, edge and face, in every direction") {
    for (NarrowPhase method : methods)
        for (int sx : {-1, 0, 1})
            for (int sy : {-1, 0, 1})
                for (int sz : {-1, 0, 1}) {
                    if (sx == 0 && sy == 0 && sz == 0) continue;
                    const Box box{{0.5f, 0.5f, 0.5f}};
                    const Axis axis =
                        axis_of(box, box, {{float(sx), float(sy), float(sz)}, {}}, method);
                    check_sane(axis);
                    CHECK(axis.separation == Approx(0).epsilon(1e-6));
                    CHECK(dot(axis.normal, Vec3{float(sx), float(sy), float(sz)}) > 0.5f);
                }
}

TEST_CASE("C13: any finite pair of boxes gives a finite answer") {
    Random random(33);
    for (int i = 0; i < 20000; ++i) {
        const auto size = [&] { return float(std::pow(10.0, random.uniform(-6, 6))); };
        const Box a{{size(), size(), size()}}, b{{size(), size(), size()}};
        const Vec3 reach = a.half_extents + b.half_extents;
        const Pose pose = {multiply(random.vector(1.5), reach), random.rotation()};
        for (NarrowPhase method : methods) {
            const Axis axis = axis_of(a, b, pose, method);
            REQUIRE(is_finite(axis.separation));
            REQUIRE(std::abs(double(length(axis.normal)) - 1) < 1e-4);
            REQUIRE(is_finite(axis.point_a));
            REQUIRE(is_finite(axis.point_b));
        }
    }
}

// Contact points: where they are, how many, what they are called, and that they stay so.

#include <doctest/doctest.h>

#include <set>

#include "../narrow/judge.h"
#include "contact/build_manifold.h"
#include "narrow/box_pair.h"

using namespace cairn;
using namespace cairn::judge;
using doctest::Approx;

namespace {

constexpr double pi = 3.14159265358979323846;
const Box cube{{0.5f, 0.5f, 0.5f}};

Manifold manifold_of(const Geometry& a, const Geometry& b, const Pose& pose, NarrowPhase method,
                     float max_separation) {
    return build_manifold(a, b, pose, axis_of(a, b, pose, method), max_separation);
}

std::set<std::uint32_t> names_of(const Manifold& m) {
    std::set<std::uint32_t> names;
    for (int i = 0; i < m.point_count; ++i) names.insert(m.points[std::size_t(i)].feature);
    return names;
}

float deepest_of(const Manifold& m) {
    float deepest = 1e30f;
    for (int i = 0; i < m.point_count; ++i) {
        deepest = min(deepest, m.points[std::size_t(i)].separation);
    }
    return deepest;
}

// The area of the convex polygon of the points, in whatever order they come, across the normal.
double area_of(const Manifold& m) {
    double best = 0;
    std::array<int, 4> order = {0, 1, 2, 3};
    if (m.point_count == 3) order = {0, 1, 2, 2};
    do {
        V sum;
        for (std::size_t i = 0; i < 4; ++i) {
            const V p = wide(m.points[std::size_t(order[i])].from_a);
            const V q = wide(m.points[std::size_t(order[(i + 1) % 4])].from_a);
            sum = sum + judge::cross(p, q);
        }
        best = std::max(best, 0.5 * std::abs(judge::dot(sum, wide(m.normal))));
    } while (std::next_permutation(order.begin(), order.end()));
    return m.point_count < 3 ? 0 : best;
}

bool has_point(const Manifold& m, Vec3 from_a, float tolerance) {
    for (int i = 0; i < m.point_count; ++i)
        if (length(m.points[std::size_t(i)].from_a - from_a) < tolerance) return true;
    return false;
}

}  // namespace

TEST_CASE("C05, C06: a vertex in a face and two crossed edges touch in one point each") {
    for (NarrowPhase method : methods) {
        CAPTURE(int(method));
        const Quat upright = turn({1, -1, 0}, std::acos(1 / std::sqrt(3.0)));
        const Manifold vertex =
            manifold_of(cube, cube, {{0.1f, -0.07f, 1.3f}, upright}, method, 0.01f);
        REQUIRE(vertex.point_count == 1);
        // Halfway between the face at 0.5 and the vertex 0.0660254 below it.
        CHECK(has_point(vertex, {0.1f, -0.07f, 0.5f - 0.0330127f}, 1e-5f));

        const Pose a = {{}, turn({1, 0, 0}, pi / 4)}, b = {{0, 0, 1.4f}, turn({0, 1, 0}, pi / 4)};
        const Manifold crossed = manifold_of(cube, cube, inverse(a) * b, method, 0.01f);
        REQUIRE(crossed.point_count == 1);
        CHECK(crossed.points[0].separation == Approx(-0.0142136).epsilon(1e-4));
        const Vec3 point = rotate(a.rotation, crossed.points[0].from_a);
        CHECK(length(point - Vec3{0, 0, 0.7f}) < 1e-4f);
    }
}

TEST_CASE("C07: an edge in a face touches at its ends, cut off at the face's border") {
    for (NarrowPhase method : methods) {
        const Manifold m =
            manifold_of(cube, cube, {{0.2f, 0.1f, 1.15f}, turn({1, 0, 0}, pi / 4)}, method, 0.01f);
        REQUIRE(m.point_count == 2);
        const float z = 0.5f - 0.5f * 0.0571068f;
        CHECK(has_point(m, {-0.3f, 0.1f, z}, 1e-5f));
        CHECK(has_point(m, {0.5f, 0.1f, z}, 1e-5f));
        CHECK(m.points[0].separation == Approx(-0.0571068).epsilon(1e-5));
    }
}

TEST_CASE("C08: faces that overlap by 0.8 x 0.9 touch in four points around 0.72 m^2") {
    for (NarrowPhase method : methods) {
        const Manifold m = manifold_of(cube, cube, {{0.9f, 0.2f, 0.1f}, {}}, method, 0.01f);
        CHECK(m.normal == Vec3{1, 0, 0});
        REQUIRE(m.point_count == 4);
        CHECK(area_of(m) == Approx(0.72).epsilon(1e-5));
        for (const ManifoldPoint& point : m.points) {
            CHECK(point.separation == Approx(-0.1).epsilon(1e-5));
            CHECK(point.from_a.x == Approx(0.45));
            CHECK(point.from_b.x == Approx(-0.45));
        }
    }
}

TEST_CASE("C15: of the octagon between yawed cubes four points keep 1/sqrt(2) of the area") {
    for (NarrowPhase method : methods) {
        const Pose pose = {{0, 0, 0.99f}, turn({0, 0, 1}, pi / 4)};
        const Manifold m = manifold_of(cube, cube, pose, method, 0.01f);
        REQUIRE(m.point_count == 4);
        CHECK(area_of(m) >= 0.95 * 0.5857864);
        CHECK(area_of(m) == Approx(0.5857864).epsilon(1e-5));
        // The centre is held up: the points' mean lies over it for any symmetric choice.
        Vec3 mean;
        for (const ManifoldPoint& point : m.points) mean += 0.25f * point.from_a;
        CHECK(std::abs(mean.x) < 0.05f);
        CHECK(std::abs(mean.y) < 0.05f);
    }
}

TEST_CASE("C15: every reduced manifold keeps the deepest point, as deep as the axis says") {
    Random random(51);
    int reduced = 0;
    double worst = 0;
    for (int i = 0; i < 5000; ++i) {
        const Quat q = turn(random.direction(), random.uniform(0, 0.02)) *
                       turn({0, 0, 1}, random.uniform(-pi, pi));
        const Box b{{random.real(0.3, 1), random.real(0.3, 1), 0.5f}};
        const Pose pose = {{random.real(-0.3, 0.3), random.real(-0.3, 0.3), 0.97f}, q};
        const Axis axis = axis_of(cube, b, pose, NarrowPhase::Sat);
        if (axis.separation > -1e-4f || absolute(axis.normal.z) < 0.9f) continue;
        const Manifold m = build_manifold(cube, b, pose, axis, 0.2f);
        reduced += m.point_count == 4;
        // The deepest vertex is among the corners where it lies over the other's face.
        worst = std::max(worst, double(deepest_of(m) - axis.separation));
        CHECK(deepest_of(m) > axis.separation - 2e-6f);
    }
    CHECK(reduced > 3000);
    CHECK(worst < 0.025);
}

TEST_CASE("every point lies halfway between the two surfaces, its gap along the normal") {
    Random random(52);
    double worst = 0;
    int points = 0;
    for (int i = 0; i < 20000; ++i) {
        const Box a{{random.real(0.2, 1), random.real(0.2, 1), random.real(0.2, 1)}};
        const Box b{{random.real(0.2, 1), random.real(0.2, 1), random.real(0.2, 1)}};
        const Pose pose = {random.vector(1.3), random.rotation()};
        for (NarrowPhase method : methods) {
            const Axis axis = axis_of(a, b, pose, method);
            if (axis.separation > 0.05f || axis.separation < -0.1f) continue;
            const Manifold m = build_manifold(a, b, pose, axis, 0.05f);
            REQUIRE(m.point_count > 0);
            CHECK(m.point_count <= 4);
            CHECK(names_of(m).size() == std::size_t(m.point_count));
            const WideBox wide_a(a, {}), wide_b(b, pose);
            for (int k = 0; k < m.point_count; ++k) {
                const ManifoldPoint& point = m.points[std::size_t(k)];
                const V middle = wide(point.from_a),
                        half = 0.5 * double(point.separation) * wide(m.normal);
                const V same = wide(pose.position) + wide(point.from_b);
                worst = std::max(worst, judge::length(middle - same));
                // A's surface point is on A, B's on B; a vertex may have been moved by a trifle.
                worst = std::max({worst, wide_a.distance_to(middle - half) - 5e-3,
                                  wide_b.distance_to(middle + half) - 5e-3});
                CHECK(point.separation <= 0.05f);
                CHECK(point.separation >= axis.separation - 2e-5f);
                ++points;
            }
        }
    }
    CHECK(worst < 1e-5);
    CHECK(points > 5000);
}

TEST_CASE("a cube flat on a cube has four steady points, exact, tilted by 1e-7, and rocking") {
    // Flush, shifted and yawed, with the trembling of a stack at rest.
    Random random(53);
    for (NarrowPhase method : methods)
        for (double yaw : {0.0, 0.001, 0.2})
            for (float shift : {0.0f, 0.2f}) {
                CAPTURE(int(method));
                CAPTURE(yaw);
                CAPTURE(shift);
                AxisHint hint;
                std::set<std::uint32_t> first;
                for (int step = 0; step < 200; ++step) {
                    const double tremble = step < 50 ? 0 : step < 100 ? 1e-7 : 1e-5;
                    const Quat q = turn(random.direction(), tremble) * turn({0, 1, 0}, yaw);
                    const Vec3 jitter = float(tremble) * random.direction();
                    const Pose pose = {Vec3{shift, 0.9995f, shift} + jitter, q};
                    const Axis axis = find_axis(cube, cube, pose, method, hint);
                    const Manifold m = build_manifold(cube, cube, pose, axis, 0.005f);
                    REQUIRE(m.point_count == 4);
                    CHECK(m.normal.y > 0.9999f);
                    if (step == 0) first = names_of(m);
                    REQUIRE(names_of(m) == first);
                    CHECK(area_of(m) > 0.5 * (1 - double(shift)) * (1 - double(shift)));
                }
            }
}

TEST_CASE("points keep their names while a cube slides over a ground, and their arms are exact") {
    const Box ground{{400, 1, 400}};
    for (NarrowPhase method : methods) {
        AxisHint hint;
        std::set<std::uint32_t> first;
        for (int step = 0; step < 300; ++step) {
            const Quat q = turn({0, 1, 0}, 0.01 * step) * turn({1, 0, 0}, 1e-6 * (step % 3 - 1));
            const Pose pose = {{300.0f - float(step), 1.4995f, -200.3f + 0.7f * float(step)}, q};
            const Manifold m = build_manifold(ground, cube, pose,
                                              find_axis(ground, cube, pose, method, hint), 0.005f);
            REQUIRE(m.point_count == 4);
            if (step == 0) first = names_of(m);
            REQUIRE(names_of(m) == first);
            CHECK(m.normal == Vec3{0, 1, 0});
            for (const ManifoldPoint& point : m.points) {
                const double truth = [&] {
                    double nearest = 1e300;
                    for (const V& v : WideBox(cube, {{}, q}).vertices()) {
                        const V raised = v - 0.5 * double(point.separation) * V{0, 1, 0};
                        nearest = std::min(nearest, judge::length(raised - wide(point.from_b)));
                    }
                    return nearest;
                }();
                CHECK(truth < 3e-7);
                CHECK(double(point.separation) == Approx(-0.0005).epsilon(5e-3));
            }
        }
    }
}

TEST_CASE("the ground may come second: a small cube's arms are as exact") {
    const Box ground{{400, 1, 400}};
    const Pose cube_pose = {{10, 1.4995f, -20}, {}};
    const Manifold m = manifold_of(cube, ground, inverse(cube_pose), NarrowPhase::Sat, 0.005f);
    REQUIRE(m.point_count == 4);
    CHECK(m.normal == Vec3{0, -1, 0});
    for (const ManifoldPoint& point : m.points) {
        CHECK(absolute(point.from_a.x) == 0.5f);
        CHECK(absolute(point.from_a.z) == 0.5f);
        CHECK(point.from_a.y == Approx(-0.49975));
    }
}

TEST_CASE("a cube on a plane stands on its four lowest vertices, tilted on one or two") {
    for (bool plane_first : {true, false}) {
        CAPTURE(plane_first);
        const auto stand = [&](const Pose& pose) {
            const Manifold m =
                plane_first ? manifold_of(Plane{}, cube, pose, NarrowPhase::Sat, 0.002f)
                            : manifold_of(cube, Plane{}, inverse(pose), NarrowPhase::Sat, 0.002f);
            return m;
        };
        const Manifold flat = stand({{3, 0.499f, 2}, turn({0, 1, 0}, 0.3)});
        CHECK(flat.point_count == 4);
        CHECK(area_of(flat) == Approx(1).epsilon(1e-5));
        CHECK(names_of(flat).size() == 4);
        for (const ManifoldPoint& point : flat.points) {
            CHECK(point.separation == Approx(-0.001).epsilon(1e-3));
        }
        CHECK(stand({{0, 0.706f, 0}, turn({1, 0, 0}, pi / 4)}).point_count == 2);
        const Quat upright = turn({1, 0, -1}, std::acos(1 / std::sqrt(3.0)));
        CHECK(stand({{0, 0.866f, 0}, upright}).point_count == 1);
        CHECK(stand({{0, 0.6f, 0}, {}}).point_count == 0);
    }
}

TEST_CASE("round shapes touch in one point halfway between the surfaces") {
    const Manifold balls =
        manifold_of(Sphere{1}, Sphere{0.5f}, {{0, 1.4f, 0}, {}}, NarrowPhase::Sat, 0);
    REQUIRE(balls.point_count == 1);
    CHECK(balls.points[0].from_a.y == Approx(0.95));
    CHECK(balls.points[0].from_b.y == Approx(-0.45));
    const Manifold on_box =
        manifold_of(cube, Sphere{0.5f}, {{0.2f, 0.9f, 0}, {}}, NarrowPhase::Sat, 0);
    REQUIRE(on_box.point_count == 1);
    CHECK(length(on_box.points[0].from_a - Vec3{0.2f, 0.45f, 0}) < 1e-6f);
    const Manifold apart =
        manifold_of(Sphere{1}, Sphere{1}, {{0, 2.1f, 0}, {}}, NarrowPhase::Sat, 0);
    CHECK(apart.point_count == 0);
    CHECK(
        manifold_of(Sphere{1}, Sphere{1}, {{0, 2.1f, 0}, {}}, NarrowPhase::Sat, 0.2f).point_count ==
        1);
}

TEST_CASE("edges that lie along each other touch at both ends of what they share") {
    for (NarrowPhase method : methods) {
        // Diagonally apart: the nearest features are two parallel edges, sharing x from -0.2 to
        // 0.5.
        const Manifold m = manifold_of(cube, cube, {{0.3f, 1.2f, 1.3f}, {}}, method, 0.5f);
        REQUIRE(m.point_count == 2);
        CHECK(has_point(m, {-0.2f, 0.6f, 0.65f}, 1e-5f));
        CHECK(has_point(m, {0.5f, 0.6f, 0.65f}, 1e-5f));
        CHECK(names_of(m).size() == 2);
        CHECK(m.points[0].separation == Approx(std::sqrt(0.13)).epsilon(1e-5));
    }
}

TEST_CASE("crossed edges of faces that nearly face each other still give the whole polygon") {
    Random random(54);
    int crossed = 0;
    for (int i = 0; i < 2000; ++i) {
        const Quat q = turn(random.direction(), random.uniform(0, 0.02)) *
                       turn({0, 1, 0}, random.uniform(0.2, 1.3));
        const Pose pose = {{random.real(-0.6, 0.6), 0.995f, random.real(-0.6, 0.6)}, q};
        AxisHint hint;
        const Axis axis = find_axis(cube, cube, pose, NarrowPhase::Sat, hint);
        if (hint.kind != std::uint8_t(BoxAxisKind::EdgePair) || axis.normal.y < 0.9995f) continue;
        ++crossed;
        CHECK(build_manifold(cube, cube, pose, axis, 0.1f).point_count >= 3);
    }
    CHECK(crossed > 30);
}

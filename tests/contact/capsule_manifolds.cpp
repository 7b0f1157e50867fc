// The contact points of capsules: how many, where, what they are called, and that they stay so.

#include <doctest/doctest.h>

#include <set>

#include "../narrow/judge.h"
#include "contact/build_manifold.h"
#include "contact/feature.h"

using namespace cairn;
using namespace cairn::judge;
using doctest::Approx;

namespace {

constexpr double pi = 3.14159265358979323846;
const Capsule rod{0.25f, 2};
const Quat level = turn({0, 0, 1}, pi / 2);  // its +y end at -x

Manifold manifold_of(const Geometry& a, const Geometry& b, const Pose& pose, float max_separation) {
    return build_manifold(a, b, pose, axis_of(a, b, pose, NarrowPhase::Sat), max_separation);
}

std::set<std::uint32_t> names_of(const Manifold& m) {
    std::set<std::uint32_t> names;
    for (int i = 0; i < m.point_count; ++i) names.insert(m.points[std::size_t(i)].feature);
    return names;
}

// The point that is nearest to where one is expected.
const ManifoldPoint& point_near(const Manifold& m, Vec3 from_a) {
    int best = 0;
    for (int i = 1; i < m.point_count; ++i) {
        if (length(m.points[std::size_t(i)].from_a - from_a) <
            length(m.points[std::size_t(best)].from_a - from_a))
            best = i;
    }
    return m.points[std::size_t(best)];
}

void check_point(const Manifold& m, Vec3 from_a, float separation) {
    const ManifoldPoint& point = point_near(m, from_a);
    CHECK(length(point.from_a - from_a) < 1e-5f);
    CHECK(double(point.separation) == Approx(double(separation)).epsilon(1e-4));
}

// A capsule's end, and the face of a box in a direction, as B's features.
std::uint32_t end_of_b(float sign) { return face_bit(FaceOwner::B, 1, sign); }
std::uint32_t face_of_a(int axis, float sign) { return face_bit(FaceOwner::A, axis, sign); }

}  // namespace

TEST_CASE("a capsule on a plane touches with both ends, upright with one, in either order") {
    const Plane floor{{0, 1, 0}, 0};
    const Manifold lying = manifold_of(floor, rod, {{3, 0.24f, 0}, level}, 0.1f);
    REQUIRE(lying.point_count == 2);
    check_point(lying, {2, -0.005f, 0}, -0.01f);
    check_point(lying, {4, -0.005f, 0}, -0.01f);
    CHECK(names_of(lying) == std::set{end_of_b(-1), end_of_b(1)});
    CHECK(point_near(lying, {2, 0, 0}).feature == end_of_b(1));

    const Manifold upright = manifold_of(floor, rod, {{3, 1.26f, 0}, {}}, 0.1f);
    REQUIRE(upright.point_count == 1);
    check_point(upright, {3, 0.005f, 0}, 0.01f);
    CHECK(upright.points[0].feature == end_of_b(-1));

    const Pose pose = {{3, 0.24f, 0}, level};
    const Manifold back = manifold_of(rod, floor, inverse(pose), 0.1f);
    REQUIRE(back.point_count == 2);
    for (int i = 0; i < 2; ++i) {
        const ManifoldPoint& point = back.points[std::size_t(i)];
        CHECK(length(point.from_a - Vec3{-0.245f, point.from_a.y, 0}) < 1e-5f);
        CHECK(absolute(point.from_a.y) == Approx(1));
        CHECK(length(rotate(level, point.from_b) -
                     Vec3{point.from_a.y < 0 ? 4.0f : 2.0f, -0.005f, 0}) < 1e-5f);
    }
}

TEST_CASE("a leaning capsule's higher end is a point of its own distance, while it is in reach") {
    const Plane floor{{0, 1, 0}, 0};
    const double lean = 0.02;
    const Pose pose = {{0, float(0.25 + std::sin(lean)), 0}, turn({0, 0, 1}, pi / 2 + lean)};
    const Manifold both = manifold_of(floor, rod, pose, 0.1f);
    REQUIRE(both.point_count == 2);
    CHECK(double(point_near(both, {-1, 0, 0}).separation) == Approx(0).epsilon(1e-5));
    CHECK(double(point_near(both, {1, 0, 0}).separation) ==
          Approx(2 * std::sin(lean)).epsilon(1e-4));
    CHECK(manifold_of(floor, rod, pose, 0.01f).point_count == 1);
}

TEST_CASE(
    "C04: parallel capsules touch at both ends of what they share, named after what ends it") {
    const Capsule other{0.5f, 3};
    const Manifold m = manifold_of(rod, other, {{0.74f, 1, 0}, {}}, 0.1f);
    REQUIRE(m.point_count == 2);
    // The first spans -1 to 1 along y, the second -0.5 to 2.5.
    check_point(m, {0.245f, -0.5f, 0}, -0.01f);
    check_point(m, {0.245f, 1, 0}, -0.01f);
    CHECK(point_near(m, {0.2f, -0.5f, 0}).feature == end_of_b(-1));
    CHECK(point_near(m, {0.2f, 1, 0}).feature == face_of_a(1, 1));
    // Turned head over heels the second's other end is there.
    const Manifold turned = manifold_of(rod, other, {{0.74f, 1, 0}, turn({1, 0, 0}, pi)}, 0.1f);
    REQUIRE(turned.point_count == 2);
    CHECK(point_near(turned, {0.2f, -0.5f, 0}).feature == end_of_b(1));
}

TEST_CASE("C04: crossing, end to end and without length, capsules touch in one point") {
    CHECK(manifold_of(rod, rod, {{0.49f, 0, 0}, turn({1, 0, 0}, 1)}, 0.1f).point_count == 1);
    CHECK(manifold_of(rod, rod, {{0, 2.49f, 0}, {}}, 0.1f).point_count == 1);
    CHECK(manifold_of(Capsule{0.25f, 0}, rod, {{0.49f, 0, 0}, {}}, 0.1f).point_count == 1);
    CHECK(
        manifold_of(Capsule{0.25f, 0}, Capsule{0.25f, 0}, {{0.49f, 0, 0}, {}}, 0.1f).point_count ==
        1);
    CHECK(manifold_of(rod, Sphere{0.25f}, {{0.49f, 0, 0}, {}}, 0.1f).point_count == 1);
}

TEST_CASE("nearly parallel capsules keep the crossing, which is deepest, beside their ends") {
    // They cross 0.3 from the middle, where they are 0.01 deep.
    const Pose pose = {{0.49f, 0.3f, 0}, turn({1, 0, 0}, 0.04)};
    const Axis axis = axis_of(rod, rod, pose, NarrowPhase::Sat);
    const Manifold m = build_manifold(rod, rod, pose, axis, 0.1f);
    REQUIRE(m.point_count == 3);
    check_point(m, {0.245f, 0.3f, 0}, -0.01f);
    for (int i = 0; i < 3; ++i) {
        CHECK(m.points[std::size_t(i)].separation >= axis.separation);
        CHECK(m.points[std::size_t(i)].separation < 0.02f);
    }
}

TEST_CASE("a capsule over a box's face touches where it is over it, cut at the face's sides") {
    const Box table{{1, 0.5f, 1}};
    // Level along x, from -0.3 to 1.7: its +y end over the table, the other beyond it.
    const Manifold m = manifold_of(table, rod, {{0.7f, 0.74f, 0.2f}, level}, 0.1f);
    REQUIRE(m.point_count == 2);
    CHECK(length(m.normal - Vec3{0, 1, 0}) < 1e-6f);
    check_point(m, {-0.3f, 0.495f, 0.2f}, -0.01f);
    check_point(m, {1, 0.495f, 0.2f}, -0.01f);
    CHECK(point_near(m, {-0.3f, 0.5f, 0.2f}).feature == (face_of_a(1, 1) | end_of_b(1)));
    CHECK(point_near(m, {1, 0.5f, 0.2f}).feature == (face_of_a(1, 1) | face_of_a(0, 1)));
    // From the capsule's origin, along the box's axes.
    CHECK(length(point_near(m, {1, 0.5f, 0.2f}).from_b - Vec3{0.3f, -0.245f, 0}) < 1e-5f);

    const Pose pose = {{0.7f, 0.74f, 0.2f}, level};
    const Manifold back = manifold_of(rod, table, inverse(pose), 0.1f);
    REQUIRE(back.point_count == 2);
    for (int i = 0; i < 2; ++i) {
        const Vec3 on_table = rotate(level, back.points[std::size_t(i)].from_b);
        CHECK(length(on_table - point_near(m, on_table).from_a) < 1e-5f);
        CHECK(back.points[std::size_t(i)].separation == Approx(-0.01).epsilon(1e-4));
    }
}

TEST_CASE("a capsule as long as the table keeps its ends' names, whatever rounding says") {
    const Box table{{1, 0.5f, 1}};
    for (const float shift : {-1e-6f, 0.0f, 1e-6f}) {
        const Manifold m = manifold_of(table, rod, {{shift, 0.75f, 0}, level}, 0.1f);
        CHECK(names_of(m) ==
              std::set{face_of_a(1, 1) | end_of_b(1), face_of_a(1, 1) | end_of_b(-1)});
    }
}

TEST_CASE(
    "a capsule stands on a box with one end, beside an edge with two, off a corner with one") {
    const Box table{{1, 0.5f, 1}};
    CHECK(manifold_of(table, rod, {{0.5f, 1.74f, 0}, {}}, 0.1f).point_count == 1);
    // Along z beside the edge at x = 1, y = 0.5, from z = -0.8 to 1.2.
    const float reach = 0.24f * std::sqrt(0.5f);
    const Pose beside = {{1 + reach, 0.5f + reach, 0.2f}, turn({1, 0, 0}, pi / 2)};
    const Manifold edge = manifold_of(table, rod, beside, 0.1f);
    REQUIRE(edge.point_count == 2);
    const std::uint32_t both = face_of_a(0, 1) | face_of_a(1, 1);
    CHECK(names_of(edge) == std::set{both | end_of_b(-1), both | face_of_a(2, 1)});
    CHECK(edge.points[0].separation == Approx(-0.01).epsilon(1e-3));
    // Across that edge, one.
    const Pose across = {{1 + reach, 0.5f + reach, 0.2f}, turn({0, 0, 1}, pi / 4)};
    CHECK(manifold_of(table, rod, across, 0.1f).point_count == 1);
    const float off = 0.24f / std::sqrt(3.0f);
    CHECK(manifold_of(table, rod, {{1 + off, 1.5f + off, 1 + off}, {}}, 0.1f).point_count == 1);
}

TEST_CASE("a capsule that leans over a table's edge touches at the edge, under its old name") {
    const Box table{{1, 0.5f, 1}};
    // The middle 0.3 outside, and turned a little so that the outer end hangs.
    const double lean = 0.03;
    const Pose pose = {{1.3f, float(0.5 + 0.25 - 0.3 * lean), 0}, turn({0, 0, 1}, pi / 2 - lean)};
    const Axis axis = axis_of(table, rod, pose, NarrowPhase::Sat);
    CHECK(axis.normal.x > 0.02f);
    const Manifold m = build_manifold(table, rod, pose, axis, 0.1f);
    REQUIRE(m.point_count == 2);
    const ManifoldPoint& at_edge = point_near(m, {1, 0.5f, 0});
    CHECK(at_edge.separation == axis.separation);
    CHECK(at_edge.feature == (face_of_a(1, 1) | face_of_a(0, 1)));
    CHECK(point_near(m, {0.3f, 0.5f, 0}).separation > axis.separation + 0.01f);
}

TEST_CASE("of a capsule through a box the points are the deep ones, on the side it leaves by") {
    const Box table{{1, 0.5f, 1}};
    const Manifold m = manifold_of(table, rod, {{0.2f, 0.3f, 0}, level}, 0);
    REQUIRE(m.point_count == 2);
    CHECK(m.normal == Vec3{0, 1, 0});
    check_point(m, {-0.8f, 0.275f, 0}, -0.45f);
    check_point(m, {1, 0.275f, 0}, -0.45f);
}

TEST_CASE("whatever meets a capsule, its points lie halfway between both surfaces, to 1e-5") {
    Random random(31);
    double worst = 0, worst_depth = 0;
    int points = 0;
    for (int i = 0; i < 20000; ++i) {
        const Capsule b{random.real(0.1, 0.6), random.real(0, 1.5)};
        const double kind = random.uniform(0, 1);
        const Geometry a =
            kind < 0.4
                ? Geometry(Box{{random.real(0.2, 1), random.real(0.2, 1), random.real(0.2, 1)}})
            : kind < 0.8 ? Geometry(Capsule{random.real(0.1, 0.6), random.real(0, 1.5)})
                         : Geometry(Plane{random.direction(), random.real(-1, 1)});
        Pose pose = {random.vector(1.5), random.rotation()};
        if (i % 3 == 0) pose.rotation = turn(random.direction(), random.uniform(0, 0.05));
        const Axis axis = axis_of(a, b, pose, NarrowPhase::Sat);
        const Manifold m = build_manifold(a, b, pose, axis, 0.02f);
        if (axis.separation <= 0.02f) {
            REQUIRE(m.point_count > 0);
            float deepest = 1;
            for (int k = 0; k < m.point_count; ++k)
                deepest = min(deepest, m.points[std::size_t(k)].separation);
            worst_depth = std::max(worst_depth, double(absolute(deepest - axis.separation)));
        }
        for (int k = 0; k < m.point_count; ++k) {
            const ManifoldPoint& point = m.points[std::size_t(k)];
            const V apart = wide(point.from_a) - wide(pose.position) - wide(point.from_b);
            worst = std::max(worst, judge::length(apart));
            ++points;
        }
    }
    CHECK(worst < 1e-5);
    CHECK(worst_depth < 2e-5);
    CHECK(points > 5000);
}

// Capsules against spheres, planes, boxes and each other: closed forms and a brute force.

#include <doctest/doctest.h>

#include "judge.h"
#include "narrow/gjk_epa.h"
#include "narrow/segment.h"

using namespace cairn;
using namespace cairn::judge;
using doctest::Approx;

namespace {

constexpr double pi = 3.14159265358979323846;

Capsule random_capsule(Random& random) { return {random.real(0.1, 1), random.real(0, 2)}; }
Box random_box(Random& random) {
    return {{random.real(0.1, 1.5), random.real(0.1, 1.5), random.real(0.1, 1.5)}};
}
Pose random_pose(Random& random, double reach) { return {random.vector(reach), random.rotation()}; }

// The worst that an axis is off by, of what must hold for every one: unit, and from witness to
// witness.
double flaw_of(const Axis& axis, const Pose& b_in_a) {
    const V gap = wide(b_in_a.position) + wide(axis.point_b) - wide(axis.point_a);
    return std::max(length(gap - double(axis.separation) * wide(axis.normal)),
                    std::abs(double(length(axis.normal)) - 1));
}

double distance_of_cores(const WideCore& a, const WideCore& b) {
    return segment_distance(a.ends[0], a.ends[1], b.ends[0], b.ends[1]);
}

// Along y as a capsule is, from the direction that a case speaks of.
Quat along(Vec3 direction) {
    const Vec3 axis = cross(Vec3{0, 1, 0}, direction);
    const double cosine = double(direction.y / length(direction));
    return length(axis) > 0 ? turn(axis, std::acos(cosine)) : Quat{};
}

}  // namespace

TEST_CASE("C04: skew capsules are as far apart as their cores less both radii") {
    const Capsule a{0.2f, 2}, b{0.3f, 2};
    const Pose first = {{}, along({1, 0, 0})},
               second = {{0.2f, 0.3f, 1.5f}, along({0.6f, 0.8f, 0})};
    const Axis axis = axis_between(a, first, b, second, NarrowPhase::Sat);
    CHECK(axis.separation == Approx(1.5 - 0.5).epsilon(1e-6));
    const Vec3 normal = rotate(first.rotation, axis.normal);
    CHECK(length(normal - Vec3{0, 0, 1}) < 1e-6f);
    const Vec3 foot = rotate(first.rotation, axis.point_a);
    CHECK(length(foot - Vec3{-0.025f, 0, 0.2f}) < 1e-5f);
}

TEST_CASE("C04: end to end, and with cores of no length, capsules are balls") {
    const Axis ends =
        axis_of(Capsule{0.25f, 1}, Capsule{0.5f, 2}, {{0, 3, 0}, {}}, NarrowPhase::Sat);
    CHECK(ends.separation == Approx(3 - 1.5 - 0.75));
    CHECK(ends.normal == Vec3{0, 1, 0});
    const Axis balls =
        axis_of(Capsule{0.25f, 0}, Capsule{0.5f, 0}, {{3, 0, 4}, {}}, NarrowPhase::Sat);
    CHECK(balls.separation == Approx(5 - 0.75));
    CHECK(length(balls.normal - Vec3{0.6f, 0, 0.8f}) < 1e-6f);
    const Axis same = axis_of(Capsule{1, 0}, Capsule{1, 2}, {}, NarrowPhase::Sat);
    CHECK(same.separation == -2);
    CHECK(length(same.normal) == Approx(1));
    CHECK(same.normal.y == 0);
}

TEST_CASE("C04: crossing cores part across both, by both radii") {
    const Axis axis = axis_of(Capsule{0.5f, 2}, Capsule{0.25f, 2},
                              {{0, 0.5f, 0}, turn({1, 0, 0}, pi / 2)}, NarrowPhase::Sat);
    CHECK(axis.separation == Approx(-0.75));
    CHECK(absolute(axis.normal.x) == Approx(1));
}

TEST_CASE("C04: 10^4 pairs of capsules agree with the distance of every two features, to 1e-5") {
    Random random(4);
    double worst = 0, worst_flaw = 0, worst_swap = 0;
    int overlapping = 0;
    for (int i = 0; i < 10000; ++i) {
        const Capsule a = random_capsule(random), b = random_capsule(random);
        // Every fourth pair is parallel to within a rounding or a few degrees.
        Pose pose = random_pose(random, 2);
        if (i % 4 == 0) pose.rotation = turn(random.direction(), random.uniform(0, 0.1));
        if (i % 8 == 0) pose.rotation = turn({0, 1, 0}, random.uniform(0, 6));
        const Axis axis = axis_of(a, b, pose, NarrowPhase::Sat);
        const double distance = distance_of_cores({a, {}}, {b, pose});
        worst = std::max(worst, std::abs(double(axis.separation) -
                                         (distance - double(a.radius) - double(b.radius))));
        worst_flaw = std::max(worst_flaw, flaw_of(axis, pose));
        const Axis back = axis_of(b, a, inverse(pose), NarrowPhase::Sat);
        worst_swap = std::max(worst_swap, double(absolute(axis.separation - back.separation)));
        overlapping += axis.separation < 0;
    }
    CHECK(worst < 1e-5);
    CHECK(worst_flaw < 1e-5);
    CHECK(worst_swap < 1e-5);
    CHECK(overlapping > 2000);
    CHECK(overlapping < 8000);
}

TEST_CASE("a capsule and a ball: the distance to the core less both radii, in 10^4 places") {
    Random random(5);
    double worst = 0, worst_flaw = 0;
    for (int i = 0; i < 10000; ++i) {
        const Capsule capsule = random_capsule(random);
        const Sphere ball{random.real(0.1, 1)};
        const Pose pose = random_pose(random, 2);
        const double expected = distance_to_core(wide(pose.position), {capsule, {}}) -
                                double(capsule.radius) - double(ball.radius);
        const Axis axis = axis_of(capsule, ball, pose, NarrowPhase::Sat);
        const Axis back = axis_of(ball, capsule, inverse(pose), NarrowPhase::Sat);
        worst = std::max({worst, std::abs(double(axis.separation) - expected),
                          std::abs(double(back.separation) - expected)});
        worst_flaw = std::max({worst_flaw, flaw_of(axis, pose), flaw_of(back, inverse(pose))});
    }
    CHECK(worst < 1e-5);
    CHECK(worst_flaw < 1e-5);
    // A centre on the core leaves across it.
    const Axis within = axis_of(Capsule{1, 2}, Sphere{0.5f}, {{0, 0.5f, 0}, {}}, NarrowPhase::Sat);
    CHECK(within.separation == -1.5f);
    CHECK(within.normal.y == 0);
}

TEST_CASE("a plane and a capsule: the lower end of the core less the radius, in 2000 poses") {
    Random random(6);
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
        const Capsule capsule = random_capsule(random);
        const Plane plane{random.direction(), random.real(-1, 1)};
        const Pose pose = random_pose(random, 3);
        const WideCore core(capsule, pose);
        const double expected = std::min(judge::dot(core.ends[0], wide(plane.normal)),
                                         judge::dot(core.ends[1], wide(plane.normal))) -
                                double(plane.offset) - core.radius;
        const Axis axis = axis_of(plane, capsule, pose, NarrowPhase::Sat);
        const Axis back = axis_of(capsule, plane, inverse(pose), NarrowPhase::Sat);
        worst = std::max({worst, std::abs(double(axis.separation) - expected),
                          std::abs(double(back.separation) - expected), flaw_of(axis, pose)});
    }
    CHECK(worst < 1e-5);
}

TEST_CASE("a box and a capsule are as far apart, or as deep, as every feature says, 10^4 times") {
    Random random(7);
    double worst = 0, worst_flaw = 0, worst_swap = 0;
    int through = 0, overlapping = 0;
    for (int i = 0; i < 10000; ++i) {
        const Box box = random_box(random);
        const Capsule capsule = random_capsule(random);
        Pose pose = random_pose(random, 2);
        // Some lie along an axis of the box, exactly or nearly.
        if (i % 4 == 0) pose.rotation = turn({0, 0, 1}, i % 8 == 0 ? 0 : pi / 2);
        if (i % 12 == 0) pose.rotation = pose.rotation * turn(random.direction(), 1e-4);
        const double core = core_separation(WideBox(box, {}), {capsule, pose});
        const Axis axis = axis_of(box, capsule, pose, NarrowPhase::Sat);
        worst =
            std::max(worst, std::abs(double(axis.separation) - (core - double(capsule.radius))));
        worst_flaw = std::max(worst_flaw, flaw_of(axis, pose));
        const Axis back = axis_of(capsule, box, inverse(pose), NarrowPhase::Sat);
        worst_swap = std::max(worst_swap, double(absolute(axis.separation - back.separation)));
        through += core < 0;
        overlapping += axis.separation < 0;
    }
    CHECK(worst < 1e-5);
    CHECK(worst_flaw < 1e-5);
    CHECK(worst_swap < 1e-5);
    CHECK(through > 1000);
    CHECK(overlapping > 2000);
    CHECK(overlapping < 9000);
}

TEST_CASE("a capsule leaves a box by its face, its edge or its corner, whichever is nearest") {
    const Box box{{1, 1, 1}};
    const Capsule capsule{0.5f, 2};
    const auto axis_at = [&](Vec3 position, Quat rotation) {
        return axis_of(box, capsule, {position, rotation}, NarrowPhase::Sat);
    };
    // Upright over the top face, and lying on it.
    CHECK(axis_at({0.2f, 3, 0}, {}).normal == Vec3{0, 1, 0});
    CHECK(axis_at({0.2f, 3, 0}, {}).separation == Approx(0.5));
    const Axis level = axis_at({0.3f, 1.4f, 0}, turn({0, 0, 1}, pi / 2));
    CHECK(length(level.normal - Vec3{0, 1, 0}) < 1e-6f);
    CHECK(level.separation == Approx(-0.1));
    // Beside an edge, along it.
    const Axis edge = axis_at({1.3f, 0, 1.4f}, {});
    CHECK(length(edge.normal - Vec3{0.6f, 0, 0.8f}) < 1e-6f);
    CHECK(edge.separation == Approx(0));
    // Off a corner, its end towards it.
    const Axis corner = axis_at({2, 3, 2}, {});
    const float third = 1 / std::sqrt(3.0f);
    CHECK(length(corner.normal - Vec3{third, third, third}) < 1e-6f);
    CHECK(corner.separation == Approx(std::sqrt(3.0) - 0.5));
    // The core passes through, nearest to the side at x = 1.
    const Axis through = axis_at({0.8f, 0, 0.1f}, {});
    CHECK(through.normal == Vec3{1, 0, 0});
    CHECK(through.separation == Approx(-0.7));
    // It cuts across an edge from within: out along the edge's diagonal, core and edge on it.
    const Axis across = axis_at({0.8f, 0.8f, 0}, turn({0, 0, 1}, pi / 4));
    const float half = std::sqrt(0.5f);
    CHECK(length(across.normal - Vec3{half, half, 0}) < 1e-5f);
    CHECK(across.separation == Approx(-0.2 * std::sqrt(2.0) - 0.5));
}

TEST_CASE("GJK and EPA on the cores agree with the closed forms of capsules, to 2e-5") {
    Random random(8);
    double worst = 0;
    for (int i = 0; i < 4000; ++i) {
        const Capsule a = random_capsule(random), b = random_capsule(random);
        const Box box = random_box(random);
        const Pose pose = random_pose(random, 1.5);
        const auto by_cores = [&](const ConvexShape& first, const ConvexShape& second) {
            return double(find_axis_convex({first, second, pose}, {0, 1, 0}).separation);
        };
        const auto by_table = [&](const Geometry& first, const Geometry& second) {
            return double(axis_of(first, second, pose, NarrowPhase::GjkEpa).separation);
        };
        worst =
            std::max({worst, std::abs(by_cores(convex_shape(a), convex_shape(b)) - by_table(a, b)),
                      std::abs(by_cores(convex_shape(box), convex_shape(b)) - by_table(box, b))});
    }
    CHECK(worst < 2e-5);
}

TEST_CASE(
    "a capsule keeps its digits on a ground a thousand times its size, and far from its middle") {
    const Box ground{{500, 1, 500}};
    const Capsule capsule{0.05f, 0.2f};
    const Axis axis =
        axis_of(ground, capsule, {{400, 1.0501f, -300}, turn({0, 0, 1}, pi / 2)}, NarrowPhase::Sat);
    CHECK(axis.normal == Vec3{0, 1, 0});
    CHECK(axis.separation == Approx(1e-4).epsilon(5e-3));
    CHECK(axis.point_b.y == Approx(-0.05));
}

TEST_CASE("two segments come closest in the middle of what parallel ones share") {
    const Segment a = {{}, {0, 1, 0}, 1}, b = {{1, 0.5f, 0}, {0, -1, 0}, 1};
    const SegmentPlaces places = find_closest_places(a, b);
    CHECK(places.on_a == Approx(0.25));
    CHECK(places.on_b == Approx(0.25));
    const SegmentPlaces apart = find_closest_places(a, {{1, 5, 0}, {0, 1, 0}, 1});
    CHECK(apart.on_a == 1);
    CHECK(apart.on_b == -1);
}

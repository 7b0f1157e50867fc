// C12: the answer does not depend on which shape comes first, nor on where the pair stands.

#include <doctest/doctest.h>

#include "contact/build_manifold.h"
#include "judge.h"

using namespace cairn;
using namespace cairn::judge;

namespace {

Geometry random_shape(Random& random) {
    const double kind = random.uniform(0, 1);
    if (kind < 0.3) return Sphere{random.real(0.2, 1)};
    if (kind < 0.6) return Capsule{random.real(0.2, 0.8), random.real(0, 1)};
    return Box{{random.real(0.2, 1.2), random.real(0.2, 1.2), random.real(0.2, 1.2)}};
}

}  // namespace

TEST_CASE("C12: swapping the shapes turns the normal round and leaves the separation, to 1e-5") {
    Random random(21);
    for (NarrowPhase method : methods) {
        double worst_separation = 0, worst_normal = 0;
        for (int i = 0; i < 10000; ++i) {
            const Geometry a = random_shape(random), b = random_shape(random);
            const Pose pose = {random.vector(2), random.rotation()};
            const Axis axis = axis_of(a, b, pose, method);
            const Axis back = axis_of(b, a, inverse(pose), method);
            worst_separation =
                std::max(worst_separation, double(absolute(axis.separation - back.separation)));
            // Where two axes are as good as each other to rounding, either is right.
            const Vec3 turned = rotate(pose.rotation, back.normal);
            if (length(axis.normal + turned) > 1e-3f && std::holds_alternative<Box>(a) &&
                std::holds_alternative<Box>(b)) {
                const WideBox wide_a(std::get<Box>(a), {}), wide_b(std::get<Box>(b), pose);
                const double other = separation_along(wide_a, wide_b, -1.0 * wide(turned));
                worst_separation =
                    std::max(worst_separation, std::abs(other - double(axis.separation)));
                continue;
            }
            worst_normal = std::max(worst_normal, double(length(axis.normal + turned)));
        }
        CAPTURE(int(method));
        CHECK(worst_separation < 1e-5);
        CHECK(worst_normal < 1e-4);
    }
}

TEST_CASE("C12: poses whose inverse is exact swap to the bit") {
    const Quat quarter = {0, 0, 1, 0};  // half a turn about z: exact both ways
    const Pose pose = {{0.75f, 0.5f, 0.25f}, quarter};
    const Geometry shapes[] = {Sphere{0.5f}, Box{{0.5f, 0.25f, 1}}, Box{{1, 0.75f, 0.5f}},
                               Capsule{0.5f, 1}};
    for (NarrowPhase method : methods)
        for (const Geometry& a : shapes)
            for (const Geometry& b : shapes) {
                const Axis axis = axis_of(a, b, pose, method);
                const Axis back = axis_of(b, a, inverse(pose), method);
                CHECK(axis.separation == back.separation);
                CHECK(axis.normal == -rotate(quarter, back.normal));
            }
}

TEST_CASE("C12: a rigid motion of the pair within 10 m changes the separation by less than 1e-5") {
    Random random(22);
    for (NarrowPhase method : methods) {
        double worst = 0;
        for (int i = 0; i < 10000; ++i) {
            const Geometry a = random_shape(random), b = random_shape(random);
            const Pose b_in_a = {random.vector(2), random.rotation()};
            const Pose motion = {random.vector(10), random.rotation()};
            const Axis here = axis_of(a, b, b_in_a, method);
            const Axis moved = axis_between(a, motion, b, motion * b_in_a, method);
            worst = std::max(worst, double(absolute(here.separation - moved.separation)));
        }
        CAPTURE(int(method));
        CHECK(worst < 1e-5);
    }
}

TEST_CASE("C12: both orders give contact points at the same places") {
    Random random(23);
    for (NarrowPhase method : methods) {
        double worst = 0;
        int compared = 0;
        for (int i = 0; i < 3000; ++i) {
            const Geometry a = random_shape(random), b = random_shape(random);
            const Pose pose = {random.vector(1.2), random.rotation()};
            const Axis axis = axis_of(a, b, pose, method);
            const Axis back = axis_of(b, a, inverse(pose), method);
            if (axis.separation > 0 ||
                length(axis.normal + rotate(pose.rotation, back.normal)) > 1e-4f)
                continue;
            const Manifold there = build_manifold(a, b, pose, axis, 0);
            const Manifold here = build_manifold(b, a, inverse(pose), back, 0);
            REQUIRE(there.point_count > 0);
            // The deepest points, where one is clearly deepest.
            const auto depth = [](const Manifold& m) {
                float deepest = 1e30f;
                for (int k = 0; k < m.point_count; ++k) {
                    deepest = min(deepest, m.points[std::size_t(k)].separation);
                }
                return deepest;
            };
            worst = std::max(worst, double(absolute(depth(there) - depth(here))));
            ++compared;
        }
        CAPTURE(int(method));
        CHECK(compared > 500);
        CHECK(worst < 2e-5);
    }
}

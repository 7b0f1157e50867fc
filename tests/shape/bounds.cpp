// Bounding boxes, radii and thicknesses of shapes.

#include <doctest/doctest.h>

#include "../narrow/judge.h"
#include "shape/bounds.h"
#include "shape/support.h"

using namespace cairn;
using namespace cairn::judge;
using doctest::Approx;

TEST_CASE(
    "C01: a turned box's bounds hold all corners and exceed them by rounding only, 1000 times") {
    Random random(1);
    double worst_inside = 0, worst_excess = 0;
    for (int i = 0; i < 1000; ++i) {
        const Box box{{random.real(0.1, 3), random.real(0.1, 3), random.real(0.1, 3)}};
        const Pose pose = {{}, random.rotation()};
        const Vec3 half = bounds_half_extents(box, to_matrix(pose.rotation));
        V reach;
        for (const V& v : WideBox(box, pose).vertices()) {
            reach = {std::max(reach.x, v.x), std::max(reach.y, v.y), std::max(reach.z, v.z)};
        }
        const V excess = wide(half) - reach;
        worst_inside = std::min({worst_inside, excess.x, excess.y, excess.z});
        worst_excess = std::max({worst_excess, excess.x, excess.y, excess.z});
    }
    CHECK(worst_inside > -1e-15);
    CHECK(worst_excess < 1e-6);
}

TEST_CASE("a ball's bounds are its radius, a plane's reach everywhere") {
    const Mat3 turned = to_matrix(turn({1, 2, 3}, 1));
    CHECK(bounds_half_extents(Sphere{0.3f}, turned) == Vec3{0.3f, 0.3f, 0.3f});
    CHECK(bounding_radius(Sphere{0.3f}) == 0.3f);
    CHECK(smallest_half_extent(Sphere{0.3f}) == 0.3f);
    CHECK(std::isinf(bounds_half_extents(Plane{}, turned).y));
    CHECK(std::isinf(bounding_radius(Plane{})));
    CHECK(std::isinf(smallest_half_extent(Plane{})));
}

TEST_CASE("a box's radius reaches its corners, its thickness is its thinnest") {
    const Box box{{2, 3, 6}};
    CHECK(bounding_radius(box) == 7);
    CHECK(smallest_half_extent(box) == 2);
    CHECK(bounding_radius(Box{{1e30f, 1e30f, 1e30f}}) == Approx(std::sqrt(3.0) * 1e30));
}

TEST_CASE("a turned capsule's bounds are its core's, grown by the radius, 1000 times") {
    Random random(3);
    double worst_inside = 0, worst_excess = 0;
    for (int i = 0; i < 1000; ++i) {
        const Capsule capsule{random.real(0.1, 3), random.real(0, 3)};
        const Mat3 axes = to_matrix(random.rotation());
        const V half = wide(bounds_half_extents(capsule, axes));
        const V end = 0.5 * double(capsule.height) * wide(axes.y);
        const double r = double(capsule.radius);
        for (const double excess : {half.x - std::abs(end.x) - r, half.y - std::abs(end.y) - r,
                                    half.z - std::abs(end.z) - r}) {
            worst_inside = std::min(worst_inside, excess);
            worst_excess = std::max(worst_excess, excess);
        }
    }
    CHECK(worst_inside >= 0);
    CHECK(worst_excess < 1e-6);
    CHECK(bounding_radius(Capsule{0.5f, 3}) == 2);
    CHECK(smallest_half_extent(Capsule{0.5f, 3}) == 0.5f);
    CHECK(smallest_half_extent(Capsule{0.5f, 0.1f}) == 0.5f);
}

TEST_CASE("a capsule's core is farthest along a direction at one of its ends") {
    const Capsule capsule{0.5f, 3};
    const ConvexShape shape = convex_shape(capsule);
    CHECK(shape.radius == 0.5f);
    CHECK(shape.support(shape.core, {1, 0.1f, 0}) == Vec3{0, 1.5f, 0});
    CHECK(shape.support(shape.core, {1, -0.1f, 0}) == Vec3{0, -1.5f, 0});
}

TEST_CASE("no corner of a box lies farther along a direction than its support point") {
    Random random(2);
    const Box box{{0.5f, 1, 2}};
    const ConvexShape shape = convex_shape(box);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 d = random.direction();
        const Vec3 support = shape.support(shape.core, d);
        CHECK(absolute(support) == box.half_extents);
        for (const V& v : WideBox(box, {}).vertices()) {
            CHECK(judge::dot(v, wide(d)) <= judge::dot(wide(support), wide(d)) + 1e-12);
        }
    }
}

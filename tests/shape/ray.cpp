// Rays and distances against what geometry says of them, by hand.

#include "shape/ray.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <optional>

using namespace cairn;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

std::optional<ShapeHit> cast(const Geometry& geometry, Vec3d origin, Vec3d direction,
                             double length = infinite) {
    ShapeHit hit;
    const Vec3d unit = (1 / cairn::length(direction)) * direction;
    if (!cast_ray(geometry, {origin, unit, length}, hit)) return std::nullopt;
    CHECK(cairn::length(hit.normal) == doctest::Approx(1).epsilon(1e-14));
    return hit;
}

void check_hit(const std::optional<ShapeHit>& hit, double distance, Vec3d normal) {
    REQUIRE(hit);
    CHECK_FALSE(hit->inside);
    CHECK(hit->distance == doctest::Approx(distance).epsilon(1e-14));
    CHECK(hit->normal.x == doctest::Approx(normal.x).epsilon(1e-14));
    CHECK(hit->normal.y == doctest::Approx(normal.y).epsilon(1e-14));
    CHECK(hit->normal.z == doctest::Approx(normal.z).epsilon(1e-14));
}

void check_inside(const std::optional<ShapeHit>& hit, Vec3d direction) {
    REQUIRE(hit);
    CHECK(hit->inside);
    CHECK(hit->distance == 0);
    CHECK(hit->normal.x == -direction.x);
    CHECK(hit->normal.y == -direction.y);
    CHECK(hit->normal.z == -direction.z);
}

const Sphere ball{2};
const Box block{{1, 2, 3}};
const Plane floor_plane{{0, 1, 0}, 0.5f};

}  // namespace

TEST_CASE("a ray meets a ball of radius 2 where the quadratic says, with the radius as normal") {
    check_hit(cast(ball, {5, 0, 0}, {-1, 0, 0}), 3, {1, 0, 0});
    // Offset by 1.2 = 2 * 0.6, half the chord is 2 * 0.8.
    check_hit(cast(ball, {1.2, 10, 0}, {0, -1, 0}), 10 - 1.6, {0.6, 0.8, 0});
    CHECK_FALSE(cast(ball, {5, 0, 0}, {1, 0, 0}));
    CHECK_FALSE(cast(ball, {5, 0, 0}, {-1, 0, 0}, 2.999));
    CHECK(cast(ball, {5, 0, 0}, {-1, 0, 0}, 3));
}

TEST_CASE("a ray that grazes a ball touches it, and one a millionth farther out does not") {
    check_hit(cast(ball, {2, 0, -7}, {0, 0, 1}), 7, {1, 0, 0});
    CHECK_FALSE(cast(ball, {2.000001, 0, -7}, {0, 0, 1}));
}

TEST_CASE("a ray meets a box by the face that it comes to last") {
    check_hit(cast(block, {-4, 0, 0}, {1, 0, 0}), 3, {-1, 0, 0});
    check_hit(cast(block, {0, 9, 1}, {0, -1, 0}), 7, {0, 1, 0});
    // From (4, 4, 0) down the diagonal: x = 1 after 3 each way, y = 2 after 2, when x is 2.
    check_hit(cast(block, {4, 4, 0}, {-1, -1, 0}), 3 * std::sqrt(2.0), {1, 0, 0});
    CHECK_FALSE(cast(block, {4, 7.1, 0}, {-1, -1, 0}));
    CHECK_FALSE(cast(block, {-4, 0, 0}, {-1, 0, 0}));
    CHECK_FALSE(cast(block, {-4, 0, 0}, {1, 0, 0}, 2.9));
}

TEST_CASE("a ray along a face, through an edge or into a corner touches the box") {
    check_hit(cast(block, {-4, 2, 0}, {1, 0, 0}), 3, {-1, 0, 0});
    CHECK_FALSE(cast(block, {-4, 2.000001, 0}, {1, 0, 0}));
    CHECK(cast(block, {2, 1, 0}, {-1, 1, 0}));
    CHECK(cast(block, {2, 3, 4}, {-1, -1, -1}));
}

TEST_CASE("a ray meets a half-space from above alone") {
    check_hit(cast(floor_plane, {3, 4.5, 1}, {0, -1, 0}), 4, {0, 1, 0});
    check_hit(cast(floor_plane, {0, 3.5, 0}, {4, -3, 0}), 5, {0, 1, 0});
    CHECK_FALSE(cast(floor_plane, {3, 4.5, 1}, {1, 0, 0}));
    CHECK_FALSE(cast(floor_plane, {3, 4.5, 1}, {0, 1, 0}));
}

TEST_CASE("a ray that begins inside meets the shape at once, against its direction") {
    check_inside(cast(ball, {1, 1, 0}, {0, 0, 1}), {0, 0, 1});
    check_inside(cast(block, {0.9, -1.9, 2}, {1, 0, 0}), {1, 0, 0});
    check_inside(cast(floor_plane, {8, 0.4, 8}, {0, 1, 0}), {0, 1, 0});
    check_inside(cast(ball, {0, 0, 0}, {0, 1, 0}, 0), {0, 1, 0});
}

TEST_CASE("a ray that begins on a surface meets it if it goes in, not if it slides or leaves") {
    check_hit(cast(ball, {2, 0, 0}, {-1, 0, 0}), 0, {1, 0, 0});
    CHECK_FALSE(cast(ball, {2, 0, 0}, {0, 1, 0}));
    CHECK_FALSE(cast(ball, {2, 0, 0}, {1, 0, 0}));
    check_hit(cast(block, {0, 2, 0}, {1, -1, 0}), 0, {0, 1, 0});
    CHECK_FALSE(cast(block, {0, 2, 0}, {1, 0, 0}));
    CHECK_FALSE(cast(block, {0, 2, 0}, {1, 1, 0}));
    // On an edge, into one face and out of the other.
    CHECK_FALSE(cast(block, {1, 2, 0}, {1, -1, 0}));
    check_hit(cast(floor_plane, {0, 0.5, 0}, {1, -1, 0}), 0, {0, 1, 0});
    CHECK_FALSE(cast(floor_plane, {0, 0.5, 0}, {1, 0, 0}));
    // Nothing is met of length 0 from outside.
    CHECK_FALSE(cast(ball, {2.5, 0, 0}, {-1, 0, 0}, 0));
    CHECK_FALSE(cast(block, {1.5, 0, 0}, {-1, 0, 0}, 0));
}

TEST_CASE("a marble is met from a thousand kilometres away to a nanometre") {
    const Sphere marble{0.005f};
    const double r = double(marble.radius);
    check_hit(cast(marble, {1e6, 0.6 * r, 0}, {-1, 0, 0}), 1e6 - 0.8 * r, {0.8, 0.6, 0});
    CHECK(std::abs(cast(marble, {1e6, 0.6 * r, 0}, {-1, 0, 0})->distance - (1e6 - 0.8 * r)) < 1e-9);
    CHECK_FALSE(cast(marble, {1e6, 1.0001 * r, 0}, {-1, 0, 0}));
    const Box chip{{0.005f, 0.005f, 0.001f}};
    CHECK(std::abs(cast(chip, {1e6, 0, 0}, {-1, 0, 0})->distance - (1e6 - r)) < 1e-9);
    CHECK(cast(ball, {1e15, 0, 0}, {-1, 0, 0}));
}

TEST_CASE("the signed distance of a point is to the nearest surface, negative inside") {
    const auto check = [](const Geometry& geometry, Vec3d point, double distance, Vec3d normal) {
        const NearestPoint found = find_nearest_point(geometry, point);
        CHECK(found.distance == doctest::Approx(distance).epsilon(1e-14));
        CHECK(found.normal.x == doctest::Approx(normal.x).epsilon(1e-14));
        CHECK(found.normal.y == doctest::Approx(normal.y).epsilon(1e-14));
        CHECK(found.normal.z == doctest::Approx(normal.z).epsilon(1e-14));
    };
    check(ball, {0, 3, 4}, 3, {0, 0.6, 0.8});
    check(ball, {0, 0, 0.5}, -1.5, {0, 0, 1});
    check(ball, {0, 0, 0}, -2, {0, 1, 0});
    check(block, {3, 0, 0}, 2, {1, 0, 0});
    check(block, {4, 6, 0}, 5, {0.6, 0.8, 0});
    check(block, {-0.25, 0, 0}, -0.75, {-1, 0, 0});
    check(block, {0, 1.75, 0}, -0.25, {0, 1, 0});
    check(block, {1, 0, 0}, 0, {1, 0, 0});
    check(floor_plane, {7, -1, 7}, -1.5, {0, 1, 0});
}

TEST_CASE("a ray meets a capsule by its side, by an end, or passes by") {
    // Along y from -3 to 3, the cylinder from -2 to 2.
    const Capsule capsule{1, 4};
    check_hit(cast(capsule, {5, 1.5, 0}, {-1, 0, 0}), 4, {1, 0, 0});
    // 0.6 beside the axis it meets the side 0.8 before the middle.
    check_hit(cast(capsule, {0.6, -2, 9}, {0, 0, -1}), 9 - 0.8, {0.6, 0, 0.8});
    // The same beyond the cylinder: the end's ball, 0.6 above its centre.
    check_hit(cast(capsule, {9, 2.6, 0}, {-1, 0, 0}), 9 - 0.8, {0.8, 0.6, 0});
    check_hit(cast(capsule, {0, 9, 0}, {0, -1, 0}), 6, {0, 1, 0});
    check_hit(cast(capsule, {0.6, -9, 0}, {0, 1, 0}), 9 - 2.8, {0.6, -0.8, 0});
    // Down a slope of 45 degrees into the side: at x = 1 after 4 each way.
    check_hit(cast(capsule, {5, 5, 0}, {-1, -1, 0}), 4 * std::sqrt(2.0), {1, 0, 0});
    CHECK_FALSE(cast(capsule, {5, 0, 0}, {1, 0, 0}));
    CHECK_FALSE(cast(capsule, {5, 0, 0}, {-1, 0, 0}, 3.9));
    CHECK_FALSE(cast(capsule, {0, 3.5, 0}, {0.1, 1, 0}));
    CHECK_FALSE(cast(capsule, {0.9, 3, 0}, {-1, 0, 0.1}));
}

TEST_CASE("a ray grazes a capsule along its side and its end, and not a millionth farther out") {
    const Capsule capsule{1, 4};
    check_hit(cast(capsule, {1, 0, -7}, {0, 0, 1}), 7, {1, 0, 0});
    CHECK_FALSE(cast(capsule, {1.000001, 0, -7}, {0, 0, 1}));
    check_hit(cast(capsule, {-7, 3, 0}, {1, 0, 0}), 7, {0, 1, 0});
    CHECK_FALSE(cast(capsule, {-7, 3.000001, 0}, {1, 0, 0}));
    // Along the side it touches where the end's ball begins to come near.
    check_hit(cast(capsule, {1, 9, 0}, {0, -1, 0}), 7, {1, 0, 0});
    CHECK_FALSE(cast(capsule, {1.000001, 9, 0}, {0, -1, 0}));
}

TEST_CASE("a ray from within a capsule meets it at once, one from its surface if it goes in") {
    const Capsule capsule{1, 4};
    check_inside(cast(capsule, {0, 0, 0}, {0, 1, 0}), {0, 1, 0});
    check_inside(cast(capsule, {0.5, 2.5, 0}, {1, 0, 0}), {1, 0, 0});
    check_hit(cast(capsule, {1, 1, 0}, {-1, 0, 0}), 0, {1, 0, 0});
    CHECK_FALSE(cast(capsule, {1, 1, 0}, {0, 1, 0}));
    CHECK_FALSE(cast(capsule, {0, 3, 0}, {1, 0, 0}));
    check_hit(cast(capsule, {0, 3, 0}, {1, -1, 0}), 0, {0, 1, 0});
}

TEST_CASE("a capsule without length is met as the ball is, by rays from everywhere") {
    const Capsule capsule{1, 0};
    const Sphere same{1};
    for (int i = 0; i < 2000; ++i) {
        const double a = 0.7 * i, b = 0.13 * i;
        const Vec3d from = {3 * std::cos(a), 2 * std::sin(b), 3 * std::sin(a)};
        const Vec3d to = {std::sin(3 * a), std::cos(2 * b), std::sin(5 * b)};
        const auto hit = cast(capsule, from, to - from), expected = cast(same, from, to - from);
        REQUIRE(bool(hit) == bool(expected));
        if (!hit) continue;
        CHECK(hit->distance == doctest::Approx(expected->distance).epsilon(1e-12));
        CHECK(length(hit->normal - expected->normal) < 1e-12);
    }
}

TEST_CASE("the signed distance of a point from a capsule is to its core less the radius") {
    const Capsule capsule{1, 4};
    const auto check = [&](Vec3d point, double distance, Vec3d normal) {
        const NearestPoint found = find_nearest_point(capsule, point);
        CHECK(found.distance == doctest::Approx(distance).epsilon(1e-14));
        CHECK(length(found.normal - normal) < 1e-14);
    };
    check({3, 1, 4}, 4, {0.6, 0, 0.8});
    check({3, 6, 0}, 4, {0.6, 0.8, 0});
    check({0, -5, 0}, 2, {0, -1, 0});
    check({0, 1, 0.25}, -0.75, {0, 0, 1});
    check({0, 1, 0}, -1, {1, 0, 0});
}

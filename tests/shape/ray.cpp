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

// Axis and manifold at one go: what the two say apart, and nothing where the shapes are apart.

#include "contact/collide.h"

#include <doctest/doctest.h>

#include <limits>

#include "../narrow/judge.h"
#include "contact/build_manifold.h"

using namespace cairn;
using namespace cairn::judge;

namespace {

constexpr NarrowPhase all_methods[] = {NarrowPhase::Sat, NarrowPhase::GjkEpa};

Geometry random_shape(Random& random) {
    const double kind = random.uniform(0, 1);
    if (kind < 0.2) return Sphere{random.real(0.2, 1)};
    if (kind < 0.4) return Capsule{random.real(0.2, 0.8), random.real(0, 1)};
    return Box{{random.real(0.2, 1), random.real(0.2, 1), random.real(0.2, 1)}};
}

bool is_same_point(const ManifoldPoint& p, const ManifoldPoint& q) {
    return p.from_a == q.from_a && p.from_b == q.from_b && p.separation == q.separation &&
           p.feature == q.feature;
}

}  // namespace

TEST_CASE("collide finds to the bit the points of find_axis and build_manifold, and no others") {
    Random random(61);
    int touching = 0, apart = 0;
    for (int i = 0; i < 20000; ++i) {
        const Geometry a = i % 10 == 0 ? Geometry(Plane{}) : random_shape(random);
        const Geometry b = random_shape(random);
        const Pose pose = {random.vector(1.5), random.rotation()};
        const Reach reach = {random.real(0, 0.2), random.vector(0.1)};
        for (const NarrowPhase method : all_methods) {
            AxisHint hint, hint_alone;
            Axis axis;
            Manifold found;
            const bool is_near = collide(a, b, pose, method, reach, hint, axis, found);
            const Axis alone = find_axis(a, b, pose, method, hint_alone);
            const Manifold expected = build_manifold(a, b, pose, alone, reach.along(alone.normal));
            CHECK(is_near == (found.point_count > 0));
            if (!is_near) {
                // Motion along another normal may reach what motion along this one does not.
                ++apart;
                CHECK(axis.separation > reach.along(axis.normal));
                CHECK(axis.separation <= alone.separation + 1e-5f);
                continue;
            }
            ++touching;
            REQUIRE(found.point_count == expected.point_count);
            CHECK(found.normal == expected.normal);
            CHECK(axis.separation == alone.separation);
            for (std::size_t k = 0; k < std::size_t(found.point_count); ++k) {
                CHECK(is_same_point(found.points[k], expected.points[k]));
            }
        }
    }
    CHECK(touching > 5000);
    CHECK(apart > 5000);
}

TEST_CASE("boxes beyond reach along the last step's axis are apart, whatever the other axes say") {
    const Box cube{{0.5f, 0.5f, 0.5f}};
    for (const NarrowPhase method : all_methods) {
        Axis axis;
        Manifold manifold;
        AxisHint hint;
        const Pose nearer_along_y = {{1.2f, 1.5f, 0}, {}};
        CHECK_FALSE(
            collide(cube, cube, {{1.5f, 0.2f, 0}, {}}, method, {0.1f, {}}, hint, axis, manifold));
        CHECK_FALSE(collide(cube, cube, nearer_along_y, method, {0.1f, {}}, hint, axis, manifold));
        CHECK(axis.normal == Vec3{1, 0, 0});
        CHECK(axis.separation == doctest::Approx(0.2));
        // Within reach along x, it is the best axis's turn.
        CHECK_FALSE(collide(cube, cube, nearer_along_y, method, {0.3f, {}}, hint, axis, manifold));
        CHECK(axis.separation > 0.49f);
    }
}

TEST_CASE("what moves toward the other shape is near from farther off, what moves away is not") {
    const Box cube{{0.5f, 0.5f, 0.5f}};
    const Pose above = {{0, 1.2f, 0}, {}};
    for (const NarrowPhase method : all_methods) {
        for (const float fall : {0.1f, 0.3f, -0.3f}) {
            AxisHint hint;
            Axis axis;
            Manifold manifold;
            const Reach reach = {0.01f, {5, -fall, 0}};
            CHECK(collide(cube, cube, above, method, reach, hint, axis, manifold) == (fall > 0.2f));
        }
    }
}

TEST_CASE("boxes whose place is no number touch nowhere") {
    const Box cube{{0.5f, 0.5f, 0.5f}};
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const NarrowPhase method : all_methods) {
        for (const Pose& pose : {Pose{{0, nan, 0}, {}}, Pose{{0, 0.9f, 0}, {nan, 0, 0, 1}}}) {
            AxisHint hint;
            Axis axis;
            Manifold manifold;
            CHECK_FALSE(collide(cube, cube, pose, method, {0.1f, {}}, hint, axis, manifold));
        }
    }
}

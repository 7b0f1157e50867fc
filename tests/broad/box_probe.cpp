// Rays and points against a tree: what a probe reaches is no less than what brute force in binary64
// says, and the nearest is found however far the limit comes down on the way.

#include "broad/box_probe.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "broad/tree_pairs.h"
#include "support/random.h"

using namespace cairn;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct RandomPoints : test::Random {
    RandomPoints() : Random{11} {}
    Position point(double reach) {
        const double x = between(-reach, reach), y = between(-reach, reach);
        return {x, y, between(-reach, reach)};
    }
};

// Distance at which the line enters the box; infinite where it misses it.
double enter(const Aabb& box, Position o, Vec3 d) {
    double in = 0, out = infinite;
    const double from[3] = {o.x, o.y, o.z};
    for (int k = 0; k < 3; ++k) {
        const double low = double(component(box.lower, k)), high = double(component(box.upper, k));
        const double slope = double(component(d, k));
        if (slope == 0 && (from[k] < low || from[k] > high)) return infinite;
        if (slope == 0) continue;
        const double a = (low - from[k]) / slope, b = (high - from[k]) / slope;
        in = std::max(in, std::min(a, b));
        out = std::min(out, std::max(a, b));
    }
    return in <= out ? in : infinite;
}

double distance(const Aabb& box, Position p) {
    const double from[3] = {p.x, p.y, p.z};
    double squared = 0;
    for (int k = 0; k < 3; ++k) {
        const double low = double(component(box.lower, k)), high = double(component(box.upper, k));
        const double gap = std::max({low - from[k], from[k] - high, 0.0});
        squared += gap * gap;
    }
    return square_root(squared);
}

struct Boxes {
    TreePairs tree;
    std::vector<Aabb> boxes;

    Boxes(RandomPoints& random, int count, double away) {
        for (int i = 0; i < count; ++i) {
            const Position at = random.point(50) + Vec3{float(away), 0, 0};
            const auto half = float(random.between(0.1, 2));
            boxes.push_back(box_around(at, {half, 2 * half, half}));
            tree.insert(std::uint32_t(i), boxes.back(), i % 3 == 0);
        }
    }
};

}  // namespace

TEST_CASE("a ray reaches every box that it enters, near the origin and 1e7 m from it") {
    RandomPoints random;
    for (const double away : {0.0, 1e7}) {
        const Boxes world(random, 400, away);
        for (int i = 0; i < 3000; ++i) {
            Position origin = random.point(70);
            origin.x += away;
            Vec3 d = normalize_or(random.point(1) - Position{}, {1, 0, 0});
            if (i % 4 == 0) d = unit_axis(i / 4 % 3);
            if (i % 8 == 0) d = -d;
            // Along the very face of a box.
            if (i % 16 == 0) origin.y = double(world.boxes[std::size_t(i % 400)].lower.y);
            const double length = i % 2 ? infinite : 30;
            std::vector<bool> reached(world.boxes.size());
            RayProbe probe(origin, d, length);
            world.tree.visit_reached(probe, [&](std::uint32_t id) { reached[id] = true; });

            RayProbe nearest(origin, d, length);
            double found = infinite, expected = infinite;
            world.tree.visit_reached(nearest, [&](std::uint32_t id) {
                found = std::min(found, enter(world.boxes[id], origin, d));
                nearest.limit = std::min(nearest.limit, round_up(found));
            });
            for (std::size_t k = 0; k < world.boxes.size(); ++k) {
                const double at = enter(world.boxes[k], origin, d);
                if (at > length) continue;
                if (at < infinite) CHECK(reached[k]);
                expected = std::min(expected, at);
            }
            if (expected < infinite) CHECK(found == expected);
        }
    }
}

TEST_CASE("a ray reaches few boxes that it does not enter") {
    RandomPoints random;
    const Boxes world(random, 2000, 0);
    std::size_t reached = 0, entered = 0;
    for (int i = 0; i < 500; ++i) {
        const Position origin = random.point(70);
        const Vec3 d = normalize_or(random.point(1) - Position{}, {1, 0, 0});
        RayProbe probe(origin, d, infinite);
        world.tree.visit_reached(probe, [&](std::uint32_t id) {
            ++reached;
            entered += enter(world.boxes[id], origin, d) < infinite ? 1 : 0;
        });
    }
    CHECK(entered > 300);
    CHECK(reached <= entered + 1);
}

TEST_CASE("a point reaches every box within its limit, and the nearest first enough") {
    RandomPoints random;
    for (const double away : {0.0, 1e7}) {
        const Boxes world(random, 400, away);
        for (int i = 0; i < 1000; ++i) {
            Position point = random.point(70);
            point.x += away;
            std::vector<bool> reached(world.boxes.size());
            PointProbe probe(point, 20);
            world.tree.visit_reached(probe, [&](std::uint32_t id) { reached[id] = true; });
            double expected = infinite, found = infinite;
            for (std::size_t k = 0; k < world.boxes.size(); ++k) {
                const double gap = distance(world.boxes[k], point);
                if (gap <= 20) CHECK(reached[k]);
                expected = std::min(expected, gap);
            }
            PointProbe nearest(point, infinite);
            world.tree.visit_reached(nearest, [&](std::uint32_t id) {
                found = std::min(found, distance(world.boxes[id], point));
                nearest.limit = round_up(found);
            });
            CHECK(found == expected);
        }
    }
}

TEST_CASE("a limit below 0 ends a search, endless boxes and all") {
    RandomPoints random;
    Boxes world(random, 400, 0);
    world.tree.insert(1000, whole_space, false);
    int visits = 0;
    RayProbe probe({-100, 0, 0}, {1, 0, 0}, infinite);
    world.tree.visit_reached(probe, [&](std::uint32_t) {
        ++visits;
        probe.limit = -1;
    });
    CHECK(visits == 1);
}

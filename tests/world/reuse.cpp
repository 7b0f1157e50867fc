// Contacts that are carried along rather than found anew: nobody can tell.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "cairn/world.h"

using namespace cairn;

namespace {

constexpr double dt = 1.0 / 60;

World make_world(bool reuse, Solver solver) {
    WorldSettings settings;
    settings.step.solver = solver;
    settings.step.reuse_contacts = reuse;
    settings.sleeping = false;
    return *World::create(settings);
}

BodyId add_box(World& world, Position position, Vec3 half, Quat rotation = {},
               float friction = 0.6f, BodyKind kind = BodyKind::Dynamic, Vec3 spin = {}) {
    ShapeDef shape{.geometry = Box{half}};
    shape.material.friction = friction;
    return *world.create_body({.kind = kind,
                               .position = position,
                               .rotation = rotation,
                               .angular_velocity = spin,
                               .shapes = {shape}});
}

double distance(Position a, Position b) {
    return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) +
                     (a.z - b.z) * (a.z - b.z));
}

// The two worlds' steps side by side: how far the two bodies are apart at most, and how many
// contacts were carried along.
struct Comparison {
    double farthest = 0;
    std::size_t reused = 0;
};

template <class Build>
Comparison compare(Solver solver, int steps, Build&& build) {
    World with = make_world(true, solver), without = make_world(false, solver);
    const BodyId a = build(with), b = build(without);
    Comparison result;
    for (int step = 0; step < steps; ++step) {
        REQUIRE(with.step(dt).ok());
        REQUIRE(without.step(dt).ok());
        result.farthest =
            std::max(result.farthest, distance(with.position(a), without.position(b)));
        result.reused += with.last_step().reused_count;
        CHECK(without.last_step().reused_count == 0);
    }
    return result;
}

constexpr Solver solvers[] = {Solver::SoftStep, Solver::SequentialImpulse, Solver::Xpbd};

}  // namespace

TEST_CASE("contacts of a box at rest are carried along") {
    for (const Solver solver : solvers) {
        const Comparison rest = compare(solver, 120, [](World& world) {
            add_box(world, {0, -1, 0}, {50, 1, 50}, {}, 0.6f, BodyKind::Static);
            return add_box(world, {0, 0.5, 0}, {0.5f, 0.5f, 0.5f});
        });
        CHECK(rest.reused > 60);
        CHECK(rest.farthest < 1e-5);
    }
}

TEST_CASE("a box on a table that tilts stays and tips alike, to 1e-4 of its size") {
    for (const Solver solver : solvers) {
        // 0.1 rad/s: the tall box, half as wide as high, tips at atan(1/2), after 4.6 s.
        const Comparison tilt = compare(solver, 270, [](World& world) {
            add_box(world, {0, -1, 0}, {10, 1, 10}, {}, 2, BodyKind::Kinematic, {0, 0, 0.1f});
            return add_box(world, {0.3, 0.5, 0}, {0.25f, 0.5f, 0.25f}, {}, 2);
        });
        CHECK(tilt.farthest < 1e-4);
    }
}

TEST_CASE("a rocking block swings alike, to 1e-4 of its size") {
    for (const Solver solver : solvers) {
        const Comparison rock = compare(solver, 120, [](World& world) {
            add_box(world, {0, -1, 0}, {10, 1, 10}, {}, 1, BodyKind::Static);
            // Tilted by 0.1 rad about its lower edge, which stands on the ground.
            const double angle = 0.1, x = 0.2, y = 0.8;
            const Quat rotation = {0, 0, static_cast<float>(std::sin(angle / 2)),
                                   static_cast<float>(std::cos(angle / 2))};
            return add_box(world,
                           {x * std::cos(angle) - y * std::sin(angle),
                            x * std::sin(angle) + y * std::cos(angle), 0},
                           {0.2f, 0.8f, 0.2f}, rotation, 1);
        });
        CHECK(rock.farthest < 1e-4 * 0.8);
    }
}

TEST_CASE("what is carried along follows a body that is put elsewhere, or whose ground goes") {
    World world = make_world(true, Solver::SoftStep);
    const BodyId ground = add_box(world, {0, -1, 0}, {50, 1, 50}, {}, 0.6f, BodyKind::Static);
    const BodyId box = add_box(world, {0, 0.5, 0}, {0.5f, 0.5f, 0.5f});
    for (int step = 0; step < 30; ++step) REQUIRE(world.step(dt).ok());
    CHECK(world.last_step().reused_count == 1);
    REQUIRE(world.set_pose(box, {20, 0.5, 3}, {}).ok());
    for (int step = 0; step < 30; ++step) REQUIRE(world.step(dt).ok());
    CHECK(std::abs(world.position(box).y - 0.5) < 1e-3);
    REQUIRE(world.destroy_body(ground).ok());
    for (int step = 0; step < 30; ++step) REQUIRE(world.step(dt).ok());
    CHECK(world.position(box).y < -0.5);
}

TEST_CASE("shapes that were far apart are met in time, however fast they come") {
    for (const float speed : {0.3f, 5.0f, 60.0f}) {
        World world = make_world(true, Solver::SoftStep);
        const BodyId left = add_box(world, {-6, 0, 0}, {0.5f, 0.5f, 0.5f});
        const BodyId right = add_box(world, {6, 0, 0}, {0.5f, 0.5f, 0.5f});
        WorldSettings settings = world.settings();
        settings.gravity = {};
        REQUIRE(world.set_settings(settings).ok());
        REQUIRE(world.set_linear_velocity(left, {speed, 0, 0}).ok());
        REQUIRE(world.set_linear_velocity(right, {-speed, 0, 0}).ok());
        double nearest = 12;
        const int steps = static_cast<int>(20 / (static_cast<double>(speed) * dt));
        for (int step = 0; step < steps; ++step) {
            REQUIRE(world.step(dt).ok());
            nearest = std::min(nearest, world.position(right).x - world.position(left).x);
        }
        CHECK(nearest > 0.98);
        CHECK(nearest < 1.2);
    }
}

// Capsules in the world: they roll, stand, fall and lie on each other as bodies do.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cairn/cairn.h"

namespace {

using namespace cairn;

constexpr double dt = 1.0 / 60;
constexpr double pi = 3.14159265358979323846;
constexpr std::array solvers = {Solver::SoftStep, Solver::SequentialImpulse, Solver::Xpbd};
enum class Ground { Plane, Box };
constexpr std::array grounds = {Ground::Plane, Ground::Box};

World make_world(Solver solver, Ground ground, float friction, bool sleeping = false) {
    WorldSettings settings;
    settings.sleeping = sleeping;
    settings.step.solver = solver;
    World world = World::create(settings).value();
    const Geometry shape =
        ground == Ground::Plane ? Geometry(Plane{}) : Geometry(Box{{100, 1, 100}});
    const double y = ground == Ground::Plane ? 0 : -1;
    (void)world.create_body({.kind = BodyKind::Static,
                             .position = {0, y, 0},
                             .shapes = {{.geometry = shape, .material = {.friction = friction}}}});
    return world;
}

BodyId add_capsule(World& world, Position position, const Quat& rotation,
                   Capsule capsule = {0.25f, 2}, float friction = 0.6f) {
    return world
        .create_body({.position = position,
                      .rotation = rotation,
                      .shapes = {{.geometry = capsule, .material = {.friction = friction}}}})
        .value();
}

void take_steps(World& world, int count) {
    for (int i = 0; i < count; ++i) REQUIRE(world.step(dt));
}

// Along z, and stood on its -y end.
Quat lying() { return rotation_about({1, 0, 0}, pi / 2); }

float turning_at_the_ground(const World& world, BodyId body, float radius) {
    return world.linear_velocity(body).x + radius * world.angular_velocity(body).z;
}

// Two posts on either side of so many logs.
void add_posts(World& world, int base) {
    for (const double x : {-1.0, 1.0}) {
        for (const double z : {-0.8, 0.8}) {
            (void)world.create_body({.kind = BodyKind::Static,
                                     .position = {x * (0.25 * base + 0.1), 0.5, z},
                                     .shapes = {{.geometry = Capsule{0.1f, 2}}}});
        }
    }
}

// Logs along z in rows, each on the two below it.
std::vector<BodyId> add_logs(World& world, int base, float friction = 0.6f) {
    std::vector<BodyId> logs;
    for (int row = 0; row < base; ++row) {
        for (int i = 0; i < base - row; ++i) {
            const double x = 0.5 * (i - 0.5 * (base - row - 1));
            logs.push_back(add_capsule(world, {x, 0.25 * (1 + row * std::sqrt(3.0)), 0}, lying(),
                                       {0.25f, 2}, friction));
        }
    }
    return logs;
}

}  // namespace

TEST_CASE(
    "a capsule that rolls about its axis keeps its height to 0.1 mm, and speed and spin agree") {
    for (const Solver solver : solvers) {
        for (const Ground ground : grounds) {
            CAPTURE(int(solver));
            CAPTURE(int(ground));
            World world = make_world(solver, ground, 0.6f);
            const BodyId body = add_capsule(world, {0, 0.25, 0}, lying());
            REQUIRE(world.set_linear_velocity(body, {4, 0, 0}));
            REQUIRE(world.set_angular_velocity(body, {0, 0, -16}));
            double lowest = 1, highest = 0;
            float worst_slip = 0;
            for (int i = 0; i < 120; ++i) {
                take_steps(world, 1);
                lowest = std::min(lowest, world.position(body).y);
                highest = std::max(highest, world.position(body).y);
                worst_slip =
                    std::max(worst_slip, std::abs(turning_at_the_ground(world, body, 0.25f)));
            }
            CHECK(highest - lowest < 1e-4);
            CHECK(worst_slip < 0.012f);
            CHECK(world.linear_velocity(body).x == doctest::Approx(4).epsilon(2e-3));
            CHECK(std::abs(world.position(body).z) < 1e-3);
            CHECK(world.position(body).x == doctest::Approx(8).epsilon(2e-3));
        }
    }
}

TEST_CASE(
    "a capsule stood on end stays if it is upright, and falls the way it leans if it is not") {
    for (const Solver solver : solvers) {
        for (const Ground ground : grounds) {
            CAPTURE(int(solver));
            CAPTURE(int(ground));
            World world = make_world(solver, ground, 0.6f);
            for (const double side : {-1.0, 1.0}) {
                const Quat lean = rotation_about({0, 0, 1}, -0.02 * side);
                // Its lower end's ball stands on the ground.
                const BodyId body = add_capsule(
                    world, {side * (5 + std::sin(0.02)), 0.25 + std::cos(0.02), 0}, lean);
                CHECK(world.position(body).y > 1.2);
            }
            double energy = world.energy().total, gain = 0;
            for (int i = 0; i < 600; ++i) {
                take_steps(world, 1);
                gain = std::max(gain, world.energy().total - energy);
                energy = world.energy().total;
            }
            // Two of 523 kg, a metre up: 10 kJ in all.
            CHECK(gain < 10);
            const std::vector<BodyId> bodies = world.bodies();
            for (const std::size_t k : {1u, 2u}) {
                const double side = k == 1 ? -1 : 1;
                CHECK(world.position(bodies[k]).y == doctest::Approx(0.25).epsilon(4e-3));
                CHECK(side * world.position(bodies[k]).x > 5);
            }
        }
    }
}

TEST_CASE(
    "a pile of fifteen logs between posts sleeps within 4 s, and kept awake creeps by less than a "
    "millimetre") {
    for (const Solver solver : solvers) {
        for (const Ground ground : grounds) {
            CAPTURE(int(solver));
            CAPTURE(int(ground));
            World sleeping = make_world(solver, ground, 0.6f, true);
            add_posts(sleeping, 5);
            (void)add_logs(sleeping, 5);
            take_steps(sleeping, 240);
            for (const BodyId body : sleeping.bodies()) CHECK_FALSE(sleeping.is_awake(body));

            World awake = make_world(solver, ground, 0.6f);
            add_posts(awake, 5);
            const std::vector<BodyId> logs = add_logs(awake, 5);
            std::vector<Position> starts;
            for (const BodyId log : logs) starts.push_back(awake.position(log));
            take_steps(awake, 1200);
            double farthest = 0;
            float fastest = 0;
            for (std::size_t i = 0; i < logs.size(); ++i) {
                const Position p = awake.position(logs[i]);
                const Vec3 v = awake.linear_velocity(logs[i]);
                farthest = std::max(
                    farthest, std::hypot(p.x - starts[i].x, p.y - starts[i].y, p.z - starts[i].z));
                fastest = std::max(fastest, std::hypot(v.x, v.y, v.z));
            }
            CHECK(farthest < 1e-3);
            CHECK(fastest < 1e-3f);
        }
    }
}

TEST_CASE("three logs hold by friction above 2 - sqrt 3 alone, and roll apart below") {
    for (const Solver solver : solvers) {
        for (const float friction : {0.2f, 0.35f}) {
            CAPTURE(int(solver));
            World world = make_world(solver, Ground::Plane, friction);
            const std::vector<BodyId> logs = add_logs(world, 2, friction);
            take_steps(world, 240);
            const double top = world.position(logs[2]).y;
            if (friction > 0.3f)
                CHECK(top == doctest::Approx(0.25 * (1 + std::sqrt(3.0))).epsilon(1e-3));
            if (friction < 0.3f) CHECK(top < 0.3);
        }
    }
}

TEST_CASE("a heap of capsules, balls and boxes makes no energy while it falls apart") {
    for (const Solver solver : solvers) {
        for (const NarrowPhase narrow_phase : {NarrowPhase::Sat, NarrowPhase::GjkEpa}) {
            CAPTURE(int(solver));
            World world = make_world(solver, Ground::Box, 0.5f);
            WorldSettings settings = world.settings();
            settings.step.narrow_phase = narrow_phase;
            REQUIRE(world.set_settings(settings));
            for (int i = 0; i < 60; ++i) {
                const Quat turned = rotation_about({1, 0.3f * float(i % 5), 0.2f}, 0.7 * i);
                const BodyId body = add_capsule(
                    world,
                    {0.45 * (i % 4) + 0.01 * (i % 7), 0.6 + 0.6 * (i / 8), 0.5 * (i / 4 % 2)},
                    turned, {0.15f, 0.1f * float(i % 5)});
                if (i % 5 == 3) {
                    const ShapeId shape = world.shapes(body)[0];
                    (void)world.create_shape(body, {.geometry = Box{{0.15f, 0.1f, 0.2f}}});
                    (void)world.destroy_shape(shape);
                }
            }
            const double start = world.energy().total;
            double most = start;
            for (int i = 0; i < 480; ++i) {
                take_steps(world, 1);
                most = std::max(most, world.energy().total);
            }
            CHECK(most < start * (1 + 1e-3));
            CHECK(World::penetration(world.contacts()).deepest < 5e-3);
        }
    }
}

TEST_CASE("a capsule's shape is refused by name if its numbers make none") {
    World world;
    const auto refused = [&](Capsule capsule) {
        const auto made = world.create_body({.shapes = {{.geometry = capsule}}});
        REQUIRE_FALSE(made);
        return made.error().message;
    };
    CHECK(refused({0, 1}).find("geometry.radius") != std::string::npos);
    CHECK(refused({-1, 1}).find("geometry.radius") != std::string::npos);
    CHECK(refused({1, -1}).find("geometry.height") != std::string::npos);
    CHECK(refused({1, std::nanf("")}).find("geometry.height") != std::string::npos);
    CHECK(refused({1, 2e9f}).find("geometry.height") != std::string::npos);
    CHECK(world.create_body({.shapes = {{.geometry = Capsule{1, 0}}}}));
}

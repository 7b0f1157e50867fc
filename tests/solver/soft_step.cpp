// The soft step: the same bits at every width, and loads that pass through many contacts.

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "cairn/cairn.h"
#include "determinism/pile.h"

namespace {

using namespace cairn;

World make_ground(int lanes = 0) {
    WorldSettings settings;
    settings.step.lanes = lanes;
    World world = *World::create(settings);
    BodyDef ground{.kind = BodyKind::Static, .position = {0, -1, 0}};
    ground.shapes = {{.geometry = Box{{100, 1, 100}}, .material = {.friction = 0.5f}}};
    (void)world.create_body(ground);
    return world;
}

BodyDef cube(const Position& at, float density = 1000) {
    BodyDef def{.position = at};
    def.shapes = {{.geometry = Box{{0.5f, 0.5f, 0.5f}}, .density = density}};
    def.shapes[0].material.friction = 0.5f;
    return def;
}

// The top of a column, as far as it moves in `seconds`.
double find_worst_drift(int height, float top, double seconds) {
    World world = make_ground();
    BodyId last;
    for (int i = 0; i < height; ++i) {
        last = *world.create_body(cube({0, 0.5 + i, 0}, i == height - 1 ? 1000 * top : 1000));
    }
    double worst = 0;
    for (int step = 0; step < std::lround(60 * seconds); ++step) {
        (void)world.step(1.0 / 60);
        const Position p = world.position(last);
        worst = std::max(worst, std::hypot(p.x, p.y - (height - 0.5), p.z));
    }
    return worst;
}

}  // namespace

TEST_CASE("1, 4, 8 and 16 contacts side by side come to the same bits") {
    std::uint64_t hashes[4];
    int k = 0;
    for (const int lanes : {1, 4, 8, 16}) {
        World world = make_ground(lanes);
        for (int i = 0; i < 40; ++i) (void)world.create_body(test::pile_body(i));
        // One that rolls against resistance, one that may only slide: rows of the special kinds.
        BodyDef roller{.position = {6, 0.5, 0}, .linear_velocity = {2, 0, 0}};
        roller.shapes = {{.geometry = Sphere{0.5f}, .material = {.rolling_friction = 0.02f}}};
        (void)world.create_body(roller);
        BodyDef rail = cube({-6, 0.5, 0});
        rail.linear_velocity = {1, 0, 1};
        const BodyId slider = *world.create_body(rail);
        (void)world.set_locked_axes(slider, {.z = true, .ry = true});
        for (int step = 0; step < 240; ++step) (void)world.step(1.0 / 60);
        hashes[k++] = world.state_hash();
    }
    CHECK(hashes[1] == hashes[0]);
    CHECK(hashes[2] == hashes[0]);
    CHECK(hashes[3] == hashes[0]);
}

TEST_CASE("fifty cubes on each other stand for a minute where they were put") {
    CHECK(find_worst_drift(50, 1, 60) < 1e-3);
}

TEST_CASE("twenty cubes bear a top four hundred times as dense for a minute") {
    CHECK(find_worst_drift(20, 400, 60) < 1e-3);
}

TEST_SUITE("full") {
    TEST_CASE("a wall of forty layers that never sleeps stands straight for half a minute") {
        World world = make_ground();
        WorldSettings settings = world.settings();
        settings.sleeping = false;
        (void)world.set_settings(settings);
        std::vector<BodyId> wall;
        for (int layer = 0; layer < 40; ++layer) {
            for (int i = 0; i < 40 - layer; ++i)
                wall.push_back(
                    *world.create_body(cube({1.05 * (i + 0.5 * layer), 0.5 + layer, 0})));
        }
        for (int step = 0; step < 1800; ++step) (void)world.step(1.0 / 60);
        double lean = 0;
        for (const BodyId body : wall) lean = std::max(lean, std::abs(world.position(body).z));
        CHECK(lean < 1e-3);
        CHECK(world.position(wall.back()).y > 39.5 - 0.01);
    }
}

TEST_CASE("a column that is struck gains less energy than a five-hundredth of what it holds") {
    World world = make_ground();
    BodyId middle;
    for (int i = 0; i < 30; ++i) {
        const BodyId body = *world.create_body(cube({0, 0.5 + i, 0}));
        if (i == 15) middle = body;
    }
    for (int step = 0; step < 30; ++step) (void)world.step(1.0 / 60);
    (void)world.apply_impulse(middle, {4000, 0, 0});
    double before = world.energy().total;
    for (int step = 0; step < 600; ++step) {
        (void)world.step(1.0 / 60);
        const double now = world.energy().total;
        CHECK(now <= before * (1 + 2e-3));
        before = std::min(before, now);
    }
    CHECK(world.non_finite().empty());
}

TEST_CASE("a column that leans on a wall is no column: nothing is thrown") {
    World world = make_ground();
    BodyDef wall{.kind = BodyKind::Static, .position = {1.2, 10, 0}};
    wall.shapes = {{.geometry = Box{{0.5f, 10, 5}}, .material = {.friction = 0.6f}}};
    (void)world.create_body(wall);
    for (int i = 0; i < 16; ++i) (void)world.create_body(cube({0.012 * i, 0.5 + i, 0}));
    double most = 0;
    for (int step = 0; step < 600; ++step) {
        (void)world.step(1.0 / 60);
        for (const BodyId body : world.bodies()) {
            const Vec3 v = world.linear_velocity(body);
            most = std::max(most, std::hypot(double(v.x), double(v.y), double(v.z)));
        }
    }
    // No faster than a fall from the column's height.
    CHECK(most < std::sqrt(2 * 9.81 * 16));
}

TEST_CASE("a load too small to have an inverse bears no friction") {
    WorldSettings settings;
    settings.gravity = {0, -1e-38f, 0};
    World world = *World::create(settings);
    BodyDef ground{.kind = BodyKind::Static};
    ground.shapes = {{.geometry = Plane{{0, 1, 0}, 0}}};
    (void)world.create_body(ground);
    BodyDef ball{.position = {0, 0.5, 0}, .linear_velocity = {1, 0, 0}};
    ball.shapes = {{.geometry = Sphere{0.5f}, .density = 1}};
    const BodyId body = *world.create_body(ball);
    for (int step = 0; step < 10; ++step) {
        (void)world.step(1.0 / 60);
        for (const ContactReport& contact : world.contacts()) {
            CHECK(contact.points[0].normal_impulse < 1e-37f);
            CHECK(contact.friction_impulse == Vec3{});
        }
    }
    CHECK(world.linear_velocity(body).x == doctest::Approx(1));
}

TEST_CASE("a ball that spins in a corner is braked by floor and wall, whatever axes are locked") {
    for (const bool locked : {false, true}) {
        World world = make_ground();
        BodyDef wall{.kind = BodyKind::Static, .position = {0, 0, -1}};
        wall.shapes = {{.geometry = Box{{5, 5, 0.5f}}}};
        (void)world.create_body(wall);
        BodyDef ball{.position = {0, 0.486, -0.014}, .angular_velocity = {-7, 0, 0}};
        ball.shapes = {{.geometry = Sphere{0.486f}}};
        const BodyId body = *world.create_body(ball);
        (void)world.set_locked_axes(body, {.ry = locked});
        double before = world.energy().total;
        for (int step = 0; step < 120; ++step) {
            (void)world.step(1.0 / 60);
            CHECK(world.energy().total <= before * (1 + 1e-5));
            before = world.energy().total;
        }
        CHECK(std::abs(double(world.angular_velocity(body).x)) < 1);
    }
}

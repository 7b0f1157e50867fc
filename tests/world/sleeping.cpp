// Sleeping and waking: what rests costs nothing and loses nothing, what moves is never stopped.

#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "cairn/cairn.h"

namespace {

using namespace cairn;

constexpr double dt = 1.0 / 60;
constexpr std::array solvers = {Solver::SoftStep, Solver::SequentialImpulse, Solver::Xpbd};

World make_world(Solver solver = Solver::SoftStep, bool sleeping = true) {
    WorldSettings settings;
    settings.sleeping = sleeping;
    settings.step.solver = solver;
    return World::create(settings).value();
}

BodyId add_ground(World& world, BodyKind kind = BodyKind::Static) {
    return world
        .create_body({.kind = kind,
                      .position = {0, -1, 0},
                      .shapes = {{.geometry = Box{{100, 1, 100}}, .material = {.friction = 0.5f}}}})
        .value();
}

BodyId add_box(World& world, Position position, float half = 0.5f) {
    return world
        .create_body(
            {.position = position,
             .shapes = {{.geometry = Box{{half, half, half}}, .material = {.friction = 0.5f}}}})
        .value();
}

BodyId add_ball(World& world, Position position, Vec3 velocity = {}, float radius = 0.5f) {
    return world
        .create_body({.position = position,
                      .linear_velocity = velocity,
                      .shapes = {{.geometry = Sphere{radius}, .material = {.friction = 0.5f}}}})
        .value();
}

std::vector<BodyId> add_tower(World& world, double x, int height, double z = 0) {
    std::vector<BodyId> bodies;
    for (int i = 0; i < height; ++i) bodies.push_back(add_box(world, {x, 0.5 + i, z}));
    return bodies;
}

void step(World& world, int steps) {
    for (int i = 0; i < steps; ++i) REQUIRE(world.step(dt).ok());
}

// Steps until the body sleeps; how many steps that took, or -1.
int step_until_asleep(World& world, BodyId body, int most = 1200) {
    for (int i = 0; i < most; ++i) {
        if (world.state(body).asleep) return i;
        step(world, 1);
    }
    return -1;
}

bool are_asleep(const World& world, const std::vector<BodyId>& bodies) {
    for (const BodyId body : bodies) {
        if (!world.state(body).asleep) return false;
    }
    return true;
}

double distance(Position a, Position b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

}  // namespace

TEST_CASE("a tower of ten sleeps within 4 s of being put up, under every solver, and as one") {
    for (const Solver solver : solvers) {
        CAPTURE(int(solver));
        World world = make_world(solver);
        add_ground(world);
        const auto tower = add_tower(world, 0, 10);
        const int steps = step_until_asleep(world, tower[0], 240);
        CHECK(steps >= 29);
        CHECK(are_asleep(world, tower));
        CHECK(world.last_step().asleep_count == 10);
        CHECK(world.last_step().awake_count == 0);
        CHECK(world.linear_velocity(tower[9]) == Vec3{});
    }
}

TEST_CASE("falling asleep loses less energy than a hundredth of a millimetre of height") {
    for (const Solver solver : solvers) {
        CAPTURE(int(solver));
        World world = make_world(solver);
        add_ground(world);
        const auto tower = add_tower(world, 0, 5);
        double before = 0;
        for (int i = 0; i < 600 && !world.state(tower[0]).asleep; ++i) {
            before = world.energy().total;
            step(world, 1);
        }
        REQUIRE(are_asleep(world, tower));
        const double weight = 5 * 1000 * 9.81;
        CHECK(std::abs(world.energy().total - before) < weight * 1e-5);
    }
}

TEST_CASE("a world where all sleeps sees no pair and moves by no bit") {
    World world = make_world();
    add_ground(world);
    const auto tower = add_tower(world, 0, 6);
    REQUIRE(step_until_asleep(world, tower[0]) >= 0);
    const auto hash = world.state_hash();
    const auto contacts = world.contacts().size();
    CHECK(contacts == 6);
    for (int i = 0; i < 200; ++i) {
        step(world, 1);
        CHECK(world.last_step().pair_count == 0);
        CHECK(world.last_step().contact_count == 0);
        CHECK(world.contact_events().empty());
    }
    CHECK(world.state_hash() == hash);
    CHECK(world.contacts().size() == contacts);
    CHECK(world.contacts()[0].points[0].normal_impulse > 0);
}

TEST_CASE("a step costs what is awake: one pile among 200 sees the pairs of one pile alone") {
    const auto pairs_of_one_awake = [](int piles) {
        World world = make_world();
        add_ground(world);
        std::vector<std::vector<BodyId>> all;
        for (int i = 0; i < piles; ++i)
            all.push_back(add_tower(world, 3.0 * (i % 20), 5, 3.0 * (i / 20)));
        step(world, 300);
        CHECK(world.last_step().awake_count == 0);
        // One that may not sleep.
        REQUIRE(world.set_can_sleep(all[0][2], false).ok());
        step(world, 100);
        CHECK(world.last_step().awake_count == 5);
        CHECK(world.last_step().asleep_count == std::size_t(5 * (piles - 1)));
        return world.last_step().pair_count;
    };
    CHECK(pairs_of_one_awake(200) == pairs_of_one_awake(1));
}

TEST_CASE("a tower woken by a touch ends within 1 mm of its twin that never slept") {
    for (const Solver solver : solvers) {
        CAPTURE(int(solver));
        World sleeper = make_world(solver), twin = make_world(solver, false);
        std::vector<BodyId> tower;
        for (World* world : {&sleeper, &twin}) {
            add_ground(*world);
            tower = add_tower(*world, 0, 10);
            step(*world, 600);
        }
        REQUIRE(are_asleep(sleeper, tower));
        for (World* world : {&sleeper, &twin}) add_ball(*world, {0, 11.0, 0}, {}, 0.2f);
        step(sleeper, 1);
        step(twin, 1);
        CHECK(are_asleep(sleeper, tower));
        bool woke = false;
        for (int i = 0; i < 600; ++i) {
            step(sleeper, 1);
            step(twin, 1);
            woke = woke || !sleeper.state(tower[0]).asleep;
        }
        CHECK(woke);
        for (const BodyId body : tower)
            CHECK(distance(sleeper.position(body), twin.position(body)) < 1e-3);
    }
}

TEST_CASE("a ball that strikes a sleeping one gives it its whole momentum in that very step") {
    for (const Solver solver : solvers) {
        CAPTURE(int(solver));
        WorldSettings settings;
        settings.gravity = {};
        settings.step.solver = solver;
        World world = World::create(settings).value();
        std::vector<BodyId> row;
        const Material bouncing = {.friction = 0, .restitution = 1};
        for (int i = 0; i < 5; ++i) {
            row.push_back(
                world
                    .create_body({.position = {1.0005 * i, 0, 0},
                                  .shapes = {{.geometry = Sphere{0.5f}, .material = bouncing}}})
                    .value());
        }
        step(world, 60);
        REQUIRE(are_asleep(world, row));
        const BodyId ball =
            world
                .create_body({.position = {-3, 0, 0},
                              .linear_velocity = {4, 0, 0},
                              .shapes = {{.geometry = Sphere{0.5f}, .material = bouncing}}})
                .value();
        const double momentum = world.momentum().linear[0];
        for (int i = 0; i < 120; ++i) {
            step(world, 1);
            CHECK(world.momentum().linear[0] == doctest::Approx(momentum).epsilon(1e-5));
        }
        CHECK(world.linear_velocity(row[4]).x == doctest::Approx(4).epsilon(0.01));
        CHECK(std::abs(world.linear_velocity(ball).x) < 0.04f);
    }
}

TEST_CASE("a sleeping contact goes on touching: no event when it sleeps, none when it wakes") {
    World world = make_world();
    add_ground(world);
    const BodyId box = add_box(world, {0, 0.6, 0});
    int begins = 0, ends = 0;
    const auto count = [&] {
        for (const ContactEvent& event : world.contact_events())
            ++(event.kind == ContactEventKind::Begin ? begins : ends);
    };
    for (int i = 0; i < 300; ++i) {
        step(world, 1);
        count();
    }
    REQUIRE(world.state(box).asleep);
    CHECK(begins == 1);
    CHECK(ends == 0);
    REQUIRE(world.set_awake(box, true).ok());
    CHECK(world.is_awake(box));
    for (int i = 0; i < 300; ++i) {
        step(world, 1);
        count();
    }
    CHECK(world.state(box).asleep);
    CHECK(begins == 1);
    CHECK(ends == 0);
    // Thrown up, it ceases to touch.
    REQUIRE(world.set_linear_velocity(box, {0, 5, 0}).ok());
    for (int i = 0; i < 20; ++i) {
        step(world, 1);
        count();
    }
    CHECK(ends == 1);
}

TEST_CASE("whatever is done to a sleeping body wakes its pile, and doing nothing does not") {
    World world = make_world();
    add_ground(world);
    const auto tower = add_tower(world, 0, 3);
    const auto far_tower = add_tower(world, 10, 3);
    const BodyId body = tower[1];
    const Vec3 push = {0, 0.01f, 0};
    using Change = std::function<Status()>;
    const ShapeId shape = world.shapes(body)[0];
    MassProperties heavier = world.mass_properties(body);
    heavier.mass *= 1.5f;
    const std::vector<std::pair<const char*, Change>> changes = {
        {"apply_force", [&] { return world.apply_force(body, push); }},
        {"apply_force_at",
         [&] {
             return world.apply_force_at(body, push, {0, 1, 0});
         }},
        {"apply_torque", [&] { return world.apply_torque(body, push); }},
        {"apply_impulse", [&] { return world.apply_impulse(body, push); }},
        {"apply_impulse_at",
         [&] {
             return world.apply_impulse_at(body, push, {0, 1, 0});
         }},
        {"apply_angular_impulse", [&] { return world.apply_angular_impulse(body, push); }},
        {"set_linear_velocity", [&] { return world.set_linear_velocity(body, push); }},
        {"set_angular_velocity", [&] { return world.set_angular_velocity(body, push); }},
        {"set_constant_force", [&] { return world.set_constant_force(body, push, {}); }},
        {"set_gravity_scale", [&] { return world.set_gravity_scale(body, 0.99f); }},
        {"set_mass_properties", [&] { return world.set_mass_properties(body, heavier); }},
        {"set_locked_axes", [&] { return world.set_locked_axes(body, {.rx = true}); }},
        {"set_material", [&] { return world.set_material(shape, {.friction = 0.4f}); }},
        {"set_collision_filter", [&] { return world.set_collision_filter(body, {.category = 2}); }},
        {"set_pose", [&] { return world.set_pose(body, world.position(body), {}); }},
        {"set_awake", [&] { return world.set_awake(body, true); }},
    };
    for (const auto& [name, change] : changes) {
        const std::string call = name;
        CAPTURE(call);
        REQUIRE(step_until_asleep(world, body) >= 0);
        step(world, 2);
        const World before = world;
        REQUIRE(change().ok());
        CHECK(!world.state(tower[0]).asleep);
        CHECK(!world.state(tower[2]).asleep);
        CHECK(are_asleep(world, far_tower));
        // Done again it changes nothing, and wakes nothing.
        world = before;
        REQUIRE(world.apply_force(body, {}).ok());
        REQUIRE(world.apply_impulse(body, {}).ok());
        REQUIRE(world.set_linear_velocity(body, {}).ok());
        REQUIRE(world.set_gravity_scale(body, 1).ok());
        CHECK(are_asleep(world, tower));
    }
}

TEST_CASE("a sleeping pile falls when its ground is destroyed, moved, or no longer collides") {
    for (int how = 0; how < 5; ++how) {
        CAPTURE(how);
        World world = make_world();
        const BodyId ground = add_ground(world);
        const auto tower = add_tower(world, 0, 3);
        const auto other = add_tower(world, 10, 3);
        REQUIRE(step_until_asleep(world, tower[0]) >= 0);
        step(world, 5);
        if (how == 0) REQUIRE(world.destroy_body(ground).ok());
        if (how == 1) REQUIRE(world.set_pose(ground, {0, -3, 0}, {}).ok());
        if (how == 2) REQUIRE(world.set_collision_filter(ground, {.mask = 0}).ok());
        if (how == 3) REQUIRE(world.destroy_shape(world.shapes(ground)[0]).ok());
        if (how == 4) REQUIRE(world.set_kind(ground, BodyKind::Dynamic).ok());
        step(world, 30);
        CHECK(world.position(tower[0]).y < 0);
        CHECK(world.position(other[2]).y < 2);
        // The neighbour destroyed is no different.
    }
    World world = make_world();
    add_ground(world);
    const auto tower = add_tower(world, 0, 4);
    REQUIRE(step_until_asleep(world, tower[0]) >= 0);
    REQUIRE(world.destroy_body(tower[1]).ok());
    step(world, 60);
    CHECK(world.position(tower[3]).y == doctest::Approx(2.5).epsilon(0.01));
}

TEST_CASE("a lift that starts wakes what stands on it, and while it moves nothing on it sleeps") {
    for (const Solver solver : solvers) {
        CAPTURE(int(solver));
        World world = make_world(solver);
        const BodyId lift = add_ground(world, BodyKind::Kinematic);
        const BodyId box = add_box(world, {0, 0.5, 0});
        REQUIRE(step_until_asleep(world, box) >= 0);
        CHECK(!world.is_awake(lift));
        REQUIRE(world.set_linear_velocity(lift, {0, 0.5f, 0}).ok());
        CHECK(world.is_awake(lift));
        for (int i = 0; i < 120; ++i) {
            step(world, 1);
            CHECK(!world.state(box).asleep);
        }
        CHECK(world.position(box).y == doctest::Approx(1.5).epsilon(0.01));
        REQUIRE(world.set_linear_velocity(lift, {}).ok());
        CHECK(step_until_asleep(world, box) >= 0);
        // Moved by its pose, it is missed at once.
        REQUIRE(world.set_pose(lift, {0, -3, 0}, {}).ok());
        CHECK(!world.state(box).asleep);
    }
}

TEST_CASE("what lies still on ground that slides away below it does not sleep") {
    World world = make_world();
    const BodyId belt = *world.create_body(
        {.kind = BodyKind::Kinematic,
         .position = {0, -1, 0},
         .linear_velocity = {0.5f, 0, 0},
         .shapes = {{.geometry = Box{{100, 1, 100}}, .material = {.friction = 0}}}});
    const BodyId box = add_box(world, {0, 0.5, 0});
    for (int i = 0; i < 200; ++i) {
        step(world, 1);
        CHECK(!world.state(box).asleep);
    }
    CHECK(std::abs(world.position(box).x) < 1e-4);
    REQUIRE(world.set_linear_velocity(belt, {}).ok());
    CHECK(step_until_asleep(world, box) >= 0);
}

TEST_CASE("a tower wakes under another solver and a shorter step, and stands as before") {
    for (const Solver solver : solvers) {
        CAPTURE(int(solver));
        World world = make_world();
        add_ground(world);
        const auto tower = add_tower(world, 0, 5);
        REQUIRE(step_until_asleep(world, tower[0]) >= 0);
        step(world, 2);
        const Position top = world.position(tower[4]);
        WorldSettings settings = world.settings();
        settings.step.solver = solver;
        REQUIRE(world.set_settings(settings).ok());
        REQUIRE(world.set_awake(tower[0], true).ok());
        for (int i = 0; i < 600; ++i) REQUIRE(world.step(1.0 / 600).ok());
        CHECK(world.contacts().size() == 5);
        CHECK(distance(world.position(tower[4]), top) < 1e-3);
    }
}

TEST_CASE("a static body put into a sleeping one, or a new one made there, wakes it") {
    World world = make_world();
    add_ground(world);
    const BodyId box = add_box(world, {0, 0.5, 0});
    const BodyId wall = world
                            .create_body({.kind = BodyKind::Static,
                                          .position = {5, 0.5, 0},
                                          .shapes = {{.geometry = Box{{0.5f, 0.5f, 0.5f}}}}})
                            .value();
    REQUIRE(step_until_asleep(world, box) >= 0);
    World other = world;
    REQUIRE(world.set_pose(wall, {0.95, 0.5, 0}, {}).ok());
    step(world, 60);
    CHECK(world.position(box).x < -0.02);
    add_box(other, {0.95, 0.5, 0});
    step(other, 60);
    CHECK(other.position(box).x < -0.02);
}

TEST_CASE("a sleeping box that becomes static and goes leaves its slots no contact of its own") {
    for (const Solver solver : solvers) {
        CAPTURE(int(solver));
        World world = make_world(solver);
        add_ground(world);
        const BodyId late = add_ball(world, {10, 3, 0}, {}, 0.2f);
        const BodyId first = add_box(world, {0, 0.5, 0});
        REQUIRE(world.set_can_sleep(late, false).ok());
        REQUIRE(step_until_asleep(world, first) >= 0);
        step(world, 2);  // its contacts are put aside
        REQUIRE(world.set_kind(first, BodyKind::Static).ok());
        step(world, 1);
        REQUIRE(world.destroy_body(first).ok());
        // Another body takes the shape's slot, a third the body's.
        REQUIRE(world.create_shape(late, {.geometry = Sphere{0.5f}}).ok());
        const BodyId third = add_box(world, {0, 0.5, 0});
        REQUIRE(step_until_asleep(world, third) >= 0);
        REQUIRE(world.set_awake(third, true).ok());
        step(world, 200);
        CHECK(world.position(late).y > 0.49);
        CHECK(world.position(third).y > 0.49);
    }
}

TEST_CASE("a change of gravity, or sleeping switched off, wakes everything") {
    World world = make_world();
    add_ground(world);
    const auto tower = add_tower(world, 0, 3);
    REQUIRE(step_until_asleep(world, tower[0]) >= 0);
    WorldSettings settings = world.settings();
    settings.restitution_threshold = 2;
    REQUIRE(world.set_settings(settings).ok());
    CHECK(are_asleep(world, tower));
    World other = world;
    settings.gravity = {0, 1, 0};
    REQUIRE(world.set_settings(settings).ok());
    step(world, 60);
    CHECK(world.position(tower[0]).y > 0.9);
    settings = other.settings();
    settings.sleeping = false;
    REQUIRE(other.set_settings(settings).ok());
    step(other, 200);
    CHECK(other.last_step().awake_count == 3);
}

TEST_CASE("the settings said once more wake nobody, though sleeping is off") {
    World world = make_world(Solver::SoftStep, false);
    const BodyId box = add_box(world, {0, 3, 0});
    step(world, 1);
    REQUIRE(world.set_awake(box, false).ok());
    WorldSettings settings = world.settings();
    settings.step.lanes = 1;
    REQUIRE(world.set_settings(settings).ok());
    CHECK(!world.is_awake(box));
}

TEST_CASE("a ball that rolls by a two hundredth of its radius a second never stops") {
    for (const Solver solver : solvers) {
        CAPTURE(int(solver));
        World world = make_world(solver);
        add_ground(world);
        const BodyId ball = add_ball(world, {0, 0.5, 0}, {0.0025f, 0, 0});
        REQUIRE(world.set_angular_velocity(ball, {0, 0, -0.005f}).ok());
        step(world, 1200);
        CHECK(!world.state(ball).asleep);
        CHECK(world.position(ball).x == doctest::Approx(0.05).epsilon(0.05));
    }
}

TEST_CASE("a box let go a fifth of a millimetre beyond its balance on an edge falls over") {
    for (const double beyond : {0.0002, 0.001, 0.01}) {
        World world = make_world();
        add_ground(world);
        // Held by friction at the edge; the diagonal is upright but for `beyond`.
        const double angle = 0.25 * 3.14159265358979 + beyond / 0.70710678;
        const Quat tilt = rotation_about({0, 0, 1}, -angle);
        const BodyId box = add_box(world, {beyond, 0.70710678, 0});
        REQUIRE(world.set_pose(box, {beyond, 0.70710678, 0}, tilt).ok());
        step(world, 600);
        CHECK(world.position(box).y == doctest::Approx(0.5).epsilon(0.01));
    }
}

TEST_CASE("what falls from rest in a gravity of a hundred thousandth does not hang in the air") {
    WorldSettings settings;
    settings.gravity = {0, -1e-4f, 0};
    World world = World::create(settings).value();
    const BodyId box = add_box(world, {0, 100, 0});
    step(world, 6000);
    CHECK(!world.state(box).asleep);
    CHECK(world.position(box).y == doctest::Approx(100 - 0.5e-4 * 1e4).epsilon(1e-3));
    // Without any, it may.
    settings.gravity = {};
    World weightless = World::create(settings).value();
    const BodyId still = add_box(weightless, {0, 100, 0});
    CHECK(step_until_asleep(weightless, still) == 30);
}

TEST_CASE("a body without shapes sleeps if it does not move at all, and spins on for ever") {
    WorldSettings settings;
    settings.gravity = {};
    World world = World::create(settings).value();
    const BodyDef top = {.angular_velocity = {0, 1e-3f, 0},
                         .mass_properties = MassProperties{2, {}, {1, 2, 3, 0, 0, 0}}};
    const BodyId spinning = world.create_body(top).value();
    const BodyId still = world.create_body({.mass_properties = top.mass_properties}).value();
    step(world, 60);
    CHECK(!world.state(spinning).asleep);
    CHECK(world.state(still).asleep);
}

TEST_CASE("two that touch sleep together or not at all; one that has left sleeps alone") {
    World world = make_world();
    add_ground(world);
    const BodyId low = add_box(world, {0, 0.5, 0});
    const BodyId high = add_box(world, {0, 1.5, 0});
    const BodyId apart = add_box(world, {5, 0.5, 0});
    REQUIRE(world.set_can_sleep(high, false).ok());
    step(world, 200);
    CHECK(!world.state(low).asleep);
    CHECK(world.state(apart).asleep);
    REQUIRE(world.set_pose(high, {-5, 0.5, 0}, {}).ok());
    step(world, 200);
    CHECK(world.state(low).asleep);
    CHECK(!world.state(high).asleep);
    REQUIRE(world.set_can_sleep(high, true).ok());
    step(world, 60);
    CHECK(world.state(high).asleep);
}

TEST_CASE("set_awake(false) stops a moving pile where it is, and only that") {
    World world = make_world();
    const BodyId ground = add_ground(world);
    const BodyId falling = add_box(world, {0, 5, 0});
    const BodyId other = add_box(world, {5, 5, 0});
    step(world, 20);
    REQUIRE(world.set_awake(falling, false).ok());
    REQUIRE(world.set_awake(ground, false).ok());
    const Position there = world.position(falling);
    step(world, 60);
    CHECK(world.position(falling) == there);
    CHECK(world.position(other).y < 2);
    REQUIRE(world.set_awake(falling, true).ok());
    step(world, 120);
    CHECK(world.position(falling).y == doctest::Approx(0.5).epsilon(0.01));
    CHECK(!world.set_awake({}, true).ok());
    CHECK(!world.set_can_sleep({}, true).ok());
}

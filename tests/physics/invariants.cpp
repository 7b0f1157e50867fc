// What every solver owes whatever the scene: conservation, symmetry, similarity of scales, and the
// plain promises of the public face (belts, locks, scales of gravity, pushing by what nothing
// pushes).
//
// Set-ups are z up and SI; each runs for every solver with the solver's own budget at 1/60 s.

#include <doctest/doctest.h>

#include <algorithm>

#include "scene.h"
#include "table.h"

namespace {

using namespace cairn;
using namespace cairn::physics;

constexpr Solver solvers[] = {Solver::SequentialImpulse, Solver::SoftStep, Solver::Xpbd};

Setup setup_of(Solver solver) { return {solver, NarrowPhase::Sat, 1.0 / 60, false}; }

BodyDef body_of(const ShapeDef& shape, const Vec& at, const Turn& turn = {}) {
    BodyDef def;
    def.shapes = {shape};
    def.position = to_position(at);
    def.rotation = to_quat(turn);
    return def;
}

Vec as_vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

TEST_CASE(
    "elastic balls in a closed box gain less than 0.1% of energy in 10 s and lose less than 3%") {
    for (const Solver solver : solvers) {
        const Setup setup = setup_of(solver);
        World world = make_world(setup, {.gravity = 0, .restitution_threshold = 0.01});
        for (const double side : {-1.0, 1.0}) {
            add_static(world, block({1, 5, 5}, rough(0, 1)), {2 * side, 0, 0});
            add_static(world, block({5, 1, 5}, rough(0, 1)), {0, 2 * side, 0});
            add_static(world, block({5, 5, 1}, rough(0, 1)), {0, 0, 2 * side});
        }
        Random random(1);
        for (int i = 0; i < 27; ++i) {
            const Vec at = 0.9 * Vec{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
            BodyDef def = body_of(ball(0.2, rough(0, 1)), at);
            def.linear_velocity = to_vec3(random.in_cube(2));
            add(world, def);
        }
        const double start = world.energy().kinetic;
        double most = start, least = start;
        for (int i = 0; i < 600; ++i) {
            advance(world, setup.dt);
            most = std::max(most, world.energy().kinetic);
            least = std::min(least, world.energy().kinetic);
        }
        CHECK_MESSAGE(most < 1.001 * start, std::string(name(solver)));
        CHECK_MESSAGE(least > 0.97 * start, std::string(name(solver)));
    }
}

TEST_CASE("colliding boxes keep their momentum to 1e-5 and never gain energy") {
    for (const Solver solver : solvers) {
        const Setup setup = setup_of(solver);
        World world = make_world(setup, {.gravity = 0, .restitution_threshold = 0.01});
        Random random(2);
        double sizes = 0;
        for (int i = 0; i < 27; ++i) {
            const Vec at = 0.7 * Vec{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
            const Vec size = {random.uniform(0.2, 0.4), random.uniform(0.2, 0.4), 0.3};
            BodyDef def = body_of(block(size, rough(0.4, 0.5)), at, random.turn());
            def.linear_velocity = to_vec3(random.in_cube(0.5) - 2 * at);
            const BodyId body = add(world, def);
            sizes += static_cast<double>(world.mass_properties(body).mass) * speed_of(world, body);
        }
        const Vec before = as_vec(world.momentum().linear);
        const double start = world.energy().kinetic;
        double energy = start, gain = 0;
        for (int i = 0; i < 120; ++i) {
            advance(world, setup.dt);
            gain = std::max(gain, world.energy().kinetic - energy);
            energy = world.energy().kinetic;
        }
        CHECK_MESSAGE(length(as_vec(world.momentum().linear) - before) < 1e-5 * sizes,
                      name(solver));
        CHECK_MESSAGE(gain < 1e-5 * start, std::string(name(solver)));
        CHECK_MESSAGE(energy < 0.8 * start, std::string(name(solver)));
    }
}

TEST_CASE("a pyramid of six cubes at rest moves less than 0.1 mm in 10 s") {
    for (const Solver solver : solvers) {
        const Setup setup = setup_of(solver);
        World world = make_world(setup);
        add_ground(world, Ground::Plane, rough(0.6));
        std::vector<BodyId> cubes;
        for (int row = 0; row < 3; ++row) {
            for (int i = 0; i < 3 - row; ++i) {
                const Vec at = {1.02 * (i + 0.5 * row), 0, 0.5 + row};
                cubes.push_back(add(world, body_of(block({1, 1, 1}, rough(0.6)), at)));
            }
        }
        run(world, setup, 2);
        std::vector<Vec> start;
        for (const BodyId cube : cubes) start.push_back(center_of(world, cube));
        run(world, setup, 10);
        for (std::size_t i = 0; i < cubes.size(); ++i) {
            CHECK_MESSAGE(length(center_of(world, cubes[i]) - start[i]) < 1e-4,
                          std::string(name(solver)));
        }
    }
}

TEST_CASE("a box that slides and spins comes to rest where its mirror image does, to 1 mm") {
    for (const Solver solver : solvers) {
        const Setup setup = setup_of(solver);
        std::vector<Vec> paths[2];
        for (int side = 0; side < 2; ++side) {
            const double s = side == 0 ? 1 : -1;
            World world = make_world(setup);
            add_ground(world, Ground::Plane, rough(0.4));
            const Turn yaw = turn_about({0, 0, 1}, s * 0.4);
            BodyDef def = body_of(block({0.4, 0.6, 0.2}, rough(0.4)), {0, 0, 0.1}, yaw);
            def.linear_velocity = to_vec3({s * 2, 0.5, 0});
            def.angular_velocity = to_vec3({0, 0, s * 6});
            const BodyId body = add(world, def);
            for (int i = 0; i < 60; ++i) {
                advance(world, setup.dt);
                const Vec at = center_of(world, body);
                paths[side].push_back({s * at.x, at.y, at.z});
            }
        }
        double apart = 0;
        for (std::size_t i = 0; i < paths[0].size(); ++i) {
            apart = std::max(apart, length(paths[0][i] - paths[1][i]));
        }
        CHECK_MESSAGE(apart < 1e-3, std::string(name(solver)));
    }
}

TEST_CASE(
    "a scene ten times smaller, its step scaled by sqrt 0.1, does the same ten times smaller") {
    for (const Solver solver : solvers) {
        std::vector<Vec> paths[2];
        for (int kind = 0; kind < 2; ++kind) {
            const double size = kind == 0 ? 1 : 0.1, time = std::sqrt(size);
            Setup setup = setup_of(solver);
            setup.dt *= time;
            World world = make_world(setup, {.restitution_threshold = time});
            add_ground(world, Ground::Plane, rough(0.5, 0.3));
            const Turn lean = turn_about({0.3, 1, 0.2}, 0.3);
            BodyDef def =
                body_of(block(size * Vec{0.6, 0.8, 0.5}, rough(0.5)), {0, 0, 0.9 * size}, lean);
            const BodyId box = add(world, def);
            def = body_of(ball(0.3 * size, rough(0.5, 0.3)), size * Vec{1.5, 0.1, 0.8});
            def.linear_velocity = to_vec3((size / time) * Vec{-1, 0, 0});
            const BodyId round = add(world, def);
            for (int i = 0; i < 60; ++i) {
                advance(world, setup.dt);
                paths[kind].push_back((1 / size) * center_of(world, box));
                paths[kind].push_back((1 / size) * center_of(world, round));
            }
        }
        double apart = 0;
        for (std::size_t i = 0; i < paths[0].size(); ++i) {
            apart = std::max(apart, length(paths[0][i] - paths[1][i]));
        }
        CHECK_MESSAGE(apart < 1e-3, std::string(name(solver)));
    }
}

TEST_CASE("an XPBD contact of compliance c gives way by c times its share of the weight") {
    const Setup setup = setup_of(Solver::Xpbd);
    World world = make_world(setup);
    const BodyId cube = add(world, body_of(block({1, 1, 1}, rough(0.6)), {0, 0, 0.5}));
    add_ground(world, Ground::Plane, rough(0.6));
    const double load = static_cast<double>(world.mass_properties(cube).mass) * gravity / 4;
    WorldSettings settings = world.settings();
    settings.step.contact_compliance = static_cast<float>(1e-3 / load);
    REQUIRE(world.set_settings(settings).ok());
    run(world, setup, 3);
    CHECK(World::penetration(world.contacts()).deepest == doctest::Approx(1e-3).epsilon(0.02));
    CHECK(speed_of(world, cube) < 1e-4);
}

TEST_CASE("a belt's surface takes a box along at mu g until both go alike") {
    for (const Solver solver : solvers) {
        const Setup setup = setup_of(solver);
        World world = make_world(setup);
        Material belt = rough(0.4);
        belt.surface_velocity = {2, 0, 0};
        add_static(world, block({40, 4, 1}, belt), {0, 0, -0.5});
        const BodyId box = add(world, body_of(block({0.5, 0.5, 0.2}, rough(0.4)), {0, 0, 0.1}));
        run(world, setup, 0.4);
        CHECK(velocity_of(world, box).x == doctest::Approx(0.4 * gravity * 0.4).epsilon(0.01));
        run(world, setup, 1);
        CHECK(velocity_of(world, box).x == doctest::Approx(2).epsilon(0.001));
    }
}

TEST_CASE("locked axes stay as they are under force, torque and contact") {
    for (const Solver solver : solvers) {
        const Setup setup = setup_of(solver);
        World world = make_world(setup);
        add_ground(world, Ground::Plane, rough(0.5), radians(20));
        BodyDef def = body_of(block({0.4, 0.4, 0.4}, rough(0.5)), {0, 0, 0.6});
        def.lock.x = true;
        def.lock.rx = def.lock.ry = def.lock.rz = true;
        def.force = {100, 30, 0};
        def.torque = {5, 5, 5};
        const BodyId body = add(world, def);
        run(world, setup, 2);
        CHECK(center_of(world, body).x == 0);
        CHECK(degrees(angle_between({}, turn_of(world, body))) == 0);
        CHECK(center_of(world, body).y != 0);
    }
}

TEST_CASE("gravity's scale turns a fall into a hover and a rise") {
    for (const Solver solver : solvers) {
        const Setup setup = setup_of(solver);
        double heights[3] = {};
        for (int i = 0; i < 3; ++i) {
            World world = make_world(setup);
            BodyDef def = body_of(ball(0.1, rough(0)), {});
            def.gravity_scale = static_cast<float>(1 - i);
            const BodyId body = add(world, def);
            run(world, setup, 1);
            heights[i] = center_of(world, body).z;
        }
        CHECK(heights[0] < -4.9);
        CHECK(heights[1] == 0);
        CHECK(heights[2] == doctest::Approx(-heights[0]).epsilon(1e-6));
    }
}

TEST_CASE("a kinematic wall pushes a box on ice to its own speed and feels nothing") {
    for (const Solver solver : solvers) {
        const Setup setup = setup_of(solver);
        World world = make_world(setup);
        add_ground(world, Ground::Plane, rough(0));
        BodyDef wall = body_of(block({0.2, 2, 1}, rough(0)), {-1, 0, 0.6});
        wall.kind = BodyKind::Kinematic;
        wall.linear_velocity = {1, 0, 0};
        const BodyId pusher = add(world, wall);
        const BodyId box = add(world, body_of(block({0.5, 0.5, 0.5}, rough(0)), {0, 0, 0.25}));
        run(world, setup, 3);
        CHECK(center_of(world, pusher).x == doctest::Approx(2).epsilon(1e-6));
        CHECK(velocity_of(world, box).x == doctest::Approx(1).epsilon(1e-3));
        CHECK(center_of(world, box).x == doctest::Approx(2.35).epsilon(1e-3));
        CHECK(degrees(angle_between({}, turn_of(world, box))) < 0.1);
    }
}

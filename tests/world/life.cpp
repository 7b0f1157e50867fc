// Bodies that come, go, freeze and are changed between steps; events; what reports add up to.

#include <cairn/cairn.h>
#include <doctest/doctest.h>

#include <cmath>

using namespace cairn;

namespace {

constexpr double dt = 1.0 / 60;

World world_with(Solver solver) {
    WorldSettings settings;
    settings.step.solver = solver;
    World world = *World::create(settings);
    world.create_body({.kind = BodyKind::Static, .shapes = {{.geometry = Plane{}}}});
    return world;
}

BodyDef cube(Position position) { return {.position = position, .shapes = {{.geometry = Box{}}}}; }

}  // namespace

TEST_CASE("a body whose force exceeds all numbers is frozen and named, and its neighbours go on") {
    for (const Solver solver : {Solver::SequentialImpulse, Solver::SoftStep, Solver::Xpbd}) {
        World world = world_with(solver);
        const BodyId lower = *world.create_body(cube({0, 0.5, 0}));
        const BodyId upper = *world.create_body(cube({0, 1.5, 0}));
        const BodyId apart = *world.create_body(cube({5, 3, 0}));
        for (int i = 0; i < 30; ++i) world.step(dt);
        // Within the face's limits, but 1e12 N s a step on 1000 kg is soon past every speed.
        MassProperties light = world.mass_properties(upper);
        light.mass = 1e-6f;
        CHECK(world.set_mass_properties(upper, light).ok());
        CHECK(world.apply_force(upper, {0, 1e15f, 0}).ok());
        world.step(dt);
        REQUIRE(world.non_finite().size() == 1);
        CHECK(world.non_finite()[0].body == upper);
        CHECK(world.non_finite()[0].step == 31);
        CHECK(world.state(upper).frozen);
        CHECK(world.position(upper).y == doctest::Approx(1.5).epsilon(0.01));
        for (int i = 0; i < 120; ++i) world.step(dt);
        CHECK(world.position(lower).y == doctest::Approx(0.5).epsilon(0.01));
        CHECK(world.position(apart).y == doctest::Approx(0.5).epsilon(0.01));
        // Put somewhere, it is thawed.
        CHECK(world.set_mass_properties(upper, world.mass_properties(lower)).ok());
        CHECK(world.set_pose(upper, {0, 4, 0}, {}).ok());
        CHECK_FALSE(world.state(upper).frozen);
        for (int i = 0; i < 120; ++i) world.step(dt);
        CHECK(world.position(upper).y == doctest::Approx(1.5).epsilon(0.01));
    }
}

TEST_CASE("a contact begins once, lasts, and ends once") {
    World world = world_with(Solver::SequentialImpulse);
    const BodyId body = *world.create_body(cube({0, 1, 0}));
    int begun = 0, ended = 0;
    const auto count = [&] {
        for (const ContactEvent& event : world.contact_events()) {
            CHECK((event.body_a == body || event.body_b == body));
            (event.kind == ContactEventKind::Begin ? begun : ended) += 1;
        }
    };
    for (int i = 0; i < 120; ++i) {
        world.step(dt);
        count();
    }
    CHECK(begun == 1);
    CHECK(ended == 0);
    world.set_linear_velocity(body, {0, 10, 0});
    for (int i = 0; i < 30; ++i) {
        world.step(dt);
        count();
    }
    CHECK(begun == 1);
    CHECK(ended == 1);
}

TEST_CASE("the reported impulses are the change of momentum, bounces and friction included") {
    for (const Solver solver : {Solver::SequentialImpulse, Solver::SoftStep, Solver::Xpbd}) {
        World world = world_with(solver);
        BodyDef def = cube({0, 1.2, 0});
        def.linear_velocity = {3, -2, 1};
        def.angular_velocity = {1, 2, 3};
        def.shapes[0].material.restitution = 0.5f;
        const BodyId body = *world.create_body(def);
        const double mass = double(world.mass_properties(body).mass);
        for (int i = 0; i < 120; ++i) {
            const Vec3 before = world.linear_velocity(body);
            world.step(dt);
            const Vec3 after = world.linear_velocity(body);
            double y = -mass * 9.81 * dt;
            double x = 0;
            for (const ContactReport& contact : world.contacts()) {
                for (int k = 0; k < contact.point_count; ++k) {
                    y += double(contact.points[std::size_t(k)].normal_impulse);
                }
                x += double(contact.friction_impulse.x);
            }
            REQUIRE(std::abs(mass * double(after.y - before.y) - y) < 1e-3 * mass);
            REQUIRE(std::abs(mass * double(after.x - before.x) - x) < 1e-3 * mass);
        }
    }
}

TEST_CASE("a shape added off the center shifts the center of mass and leaves the origin in place") {
    World world;
    const BodyId body =
        *world.create_body({.position = {1, 2, 3}, .shapes = {{.geometry = Sphere{0.5f}}}});
    const Result<ShapeId> added =
        world.create_shape(body, {.geometry = Sphere{0.5f}, .local_pose = {.position = {2, 0, 0}}});
    REQUIRE(added.ok());
    CHECK(world.position(body) == Position{1, 2, 3});
    CHECK(double(world.mass_properties(body).center_of_mass.x) == doctest::Approx(1));
    CHECK(world.destroy_shape(*added).ok());
    CHECK(world.mass_properties(body).center_of_mass == Vec3{});
    // The last shape of a dynamic body whose mass came from it cannot go.
    CHECK_FALSE(world.destroy_shape(world.shapes(body)[0]).ok());
}

TEST_CASE("what is said of a static body holds once it is dynamic, and for that body alone") {
    World world;
    BodyDef def = cube({0, 0, 0});
    def.kind = BodyKind::Static;
    const BodyId told = *world.create_body(def);
    def.position = {5, 0, 0};
    const BodyId other = *world.create_body(def);
    CHECK(world.set_gravity_scale(told, 0).ok());
    CHECK(world.set_damping(told, 0.5f, 0).ok());
    CHECK(world.set_locked_axes(told, {.z = true}).ok());
    CHECK(world.set_constant_force(told, {1000, 0, 1000}, {}).ok());
    CHECK(world.apply_impulse(other, {1000, 0, 0}).ok());
    for (const BodyId body : {told, other}) CHECK(world.set_kind(body, BodyKind::Dynamic).ok());
    world.step(dt);
    // 1 m/s^2 on 1000 kg, hardly damped yet, and no fall.
    CHECK(double(world.linear_velocity(told).x) == doctest::Approx(dt).epsilon(0.01));
    CHECK(double(world.linear_velocity(told).y) == 0.0);
    CHECK(double(world.linear_velocity(told).z) == 0.0);
    // A static body takes no impulse; this one falls, and nothing else.
    CHECK(double(world.linear_velocity(other).x) == 0.0);
    CHECK(double(world.linear_velocity(other).y) == doctest::Approx(-10 * dt).epsilon(0.03));
    // Nor does one inherit anything that comes in where another was.
    CHECK(world.destroy_body(told).ok());
    const BodyId heir = *world.create_body(cube({0, 9, 0}));
    world.step(dt);
    CHECK(double(world.linear_velocity(heir).x) == 0.0);
    CHECK(double(world.linear_velocity(heir).y) == doctest::Approx(-10 * dt).epsilon(0.03));
}

TEST_CASE(
    "a static shape off the middle, and turned, is where it was put, and its def comes back") {
    World world;
    const Quat turned = rotation_about({0, 0, 1}, 0.5);
    const ShapeDef def = {.geometry = Box{{1, 2, 3}},
                          .local_pose = {{0, 4, 0}, turned},
                          .density = 300,
                          .material = {.friction = 0.3f}};
    const BodyId body =
        *world.create_body({.kind = BodyKind::Static, .position = {1, 0, 0}, .shapes = {def}});
    CHECK(world.position(body) == Position{1, 0, 0});
    const ShapeDef back = world.shape(world.shapes(body)[0]);
    CHECK(back.geometry == def.geometry);
    CHECK(back.local_pose.position == def.local_pose.position);
    CHECK(double(back.local_pose.rotation.z) == doctest::Approx(double(turned.z)));
    CHECK(back.density == def.density);
    CHECK(back.material == def.material);
    CHECK(world.mass_properties(body).center_of_mass == Vec3{0, 4, 0});
    CHECK(world.destroy_shape(world.shapes(body)[0]).ok());
    CHECK(world.position(body) == Position{1, 0, 0});
    CHECK(world.mass_properties(body).center_of_mass == Vec3{});
}

TEST_CASE("a kinematic body arrives where it was sent, turned as told") {
    World world;
    const BodyId body =
        *world.create_body({.kind = BodyKind::Kinematic, .shapes = {{.geometry = Box{}}}});
    const Quat turned = rotation_about({0, 1, 0}, 1.0);
    CHECK(world.move_kinematic(body, {1, 2, 3}, turned, 0.5).ok());
    for (int i = 0; i < 30; ++i) world.step(dt);
    CHECK(world.position(body).x == doctest::Approx(1).epsilon(1e-6));
    CHECK(world.position(body).y == doctest::Approx(2).epsilon(1e-6));
    CHECK(double(world.rotation(body).y) == doctest::Approx(double(turned.y)).epsilon(1e-5));
}

TEST_CASE("filters: equal groups decide, else each mask must hold the other's category") {
    const auto touches = [](CollisionFilter a, CollisionFilter b) {
        World world;
        world.create_body(
            {.kind = BodyKind::Static, .shapes = {{.geometry = Box{}}}, .collision = a});
        world.create_body(
            {.position = {0, 0.9, 0}, .shapes = {{.geometry = Box{}}}, .collision = b});
        return !world.contacts().empty();
    };
    CHECK(touches({}, {}));
    CHECK_FALSE(touches({.category = 2}, {.mask = 1}));
    CHECK(touches({.category = 2, .group = 4}, {.mask = 1, .group = 4}));
    CHECK_FALSE(touches({.group = -1}, {.group = -1}));
}

TEST_CASE("a tower of twenty boxes stands without a sag, and a thousandfold density rests on one") {
    World world = world_with(Solver::SequentialImpulse);
    BodyId top;
    for (int i = 0; i < 20; ++i) top = *world.create_body(cube({0, 0.5 + i, 0}));
    BodyDef heavy = cube({10, 1.5, 0});
    heavy.shapes[0].density = 1e6f;
    world.create_body(cube({10, 0.5, 0}));
    const BodyId weight = *world.create_body(heavy);
    for (int i = 0; i < 300; ++i) {
        world.step(dt);
        REQUIRE(std::abs(world.position(top).y - 19.5) < 1e-3);
        REQUIRE(std::abs(world.position(weight).y - 1.5) < 1e-3);
    }
}

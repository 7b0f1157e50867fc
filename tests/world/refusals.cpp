// What the public face refuses, in which words, and that a refused call changes nothing.

#include <cairn/cairn.h>
#include <doctest/doctest.h>

#include <limits>

using namespace cairn;

namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

BodyDef ball() { return {.shapes = {{.geometry = Sphere{0.5f}}}}; }

std::string refused(const BodyDef& def) {
    World world;
    const Result<BodyId> result = world.create_body(def);
    CHECK_FALSE(result.ok());
    CHECK(world.body_count() == 0);
    CHECK_FALSE(world.is_valid(*result));
    return result.error().message;
}

}  // namespace

TEST_CASE("a number that is not finite is refused by name") {
    BodyDef def = ball();
    def.position.y = infinity;
    CHECK(refused(def).find("position.y: inf") != std::string::npos);
    def = ball();
    def.angular_velocity.z = nan;
    CHECK(refused(def).find("angular_velocity.z: nan") != std::string::npos);
    def = ball();
    def.shapes[0].geometry = Sphere{nan};
    CHECK(refused(def).find("shapes[0].geometry.radius: nan") != std::string::npos);
    def = ball();
    def.rotation = {0, 0, 0, 0};
    CHECK(refused(def).find("rotation") != std::string::npos);
}

TEST_CASE("a body that cannot be is refused") {
    CHECK(refused({}).find("shapes") != std::string::npos);
    CHECK(refused({.shapes = {{.geometry = Plane{}}}}).find("static") != std::string::npos);
    BodyDef def = ball();
    def.mass = -1.0f;
    CHECK(refused(def).find("mass: -1") != std::string::npos);
    def = ball();
    def.mass = 1.0f;
    def.mass_properties = MassProperties{.mass = 1, .inertia = {1, 1, 1, 0, 0, 0}};
    CHECK(refused(def).find("together") != std::string::npos);
    def = ball();
    // No distribution of mass has a moment above the sum of the other two.
    def.mass_properties = MassProperties{.mass = 1, .inertia = {1, 1, 3, 0, 0, 0}};
    CHECK(refused(def).find("inertia") != std::string::npos);
    def = ball();
    def.shapes[0].material.restitution = 1.5f;
    CHECK(refused(def).find("restitution: 1.5; allowed: 0 to 1") != std::string::npos);
}

TEST_CASE("an id whose body is gone is an error, never another body") {
    World world;
    std::vector<Error> errors;
    world.set_error_handler([&](const Error& error) { errors.push_back(error); });
    const BodyId first = *world.create_body(ball());
    CHECK(world.destroy_body(first).ok());
    const BodyId second = *world.create_body(ball());
    CHECK(second.index == first.index);
    CHECK_FALSE(world.is_valid(first));
    CHECK_FALSE(world.set_linear_velocity(first, {1, 0, 0}).ok());
    CHECK(world.linear_velocity(second) == Vec3{});
    CHECK(world.position(first) == Position{});
    REQUIRE(errors.size() == 2);
    CHECK(errors[0].code == ErrorCode::InvalidId);
}

TEST_CASE("a step of no length, or a negative or endless one, is refused and nothing moves") {
    World world;
    const BodyId body = *world.create_body(ball());
    for (const double dt : {0.0, -1.0, infinity, double(nan)}) CHECK_FALSE(world.step(dt).ok());
    CHECK(world.position(body) == Position{});
    CHECK(world.last_step().step == 0);
}

TEST_CASE("settings out of range are refused and the old ones stay") {
    World world;
    WorldSettings settings = world.settings();
    settings.step.substeps = 5000;
    CHECK_FALSE(world.set_settings(settings).ok());
    CHECK(world.settings().step.substeps == 0);
    CHECK_FALSE(World::create({.gravity = {0, nan, 0}}).ok());
}

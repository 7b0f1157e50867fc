// What a scene file means: defaults, numbers to the bit, rotations, repeats, names.

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>

#include "scene/pcg32.h"
#include "scene/scene.h"

namespace {

using namespace cairn;
using scene::Scene;

Scene read(const std::string& text) {
    Result<Scene> read = scene::read_scene(text);
    INFO(read.error().message);
    REQUIRE(read.ok());
    return std::move(read).value();
}

Scene read_body(const std::string& members) {
    return read(R"({"cairn": 1, "bodies": [{"shapes": [{"kind": "sphere", "radius": 0.5}], )" +
                members + "}]}");
}

}  // namespace

TEST_CASE("absent keys mean the format's defaults") {
    const Scene scene =
        read(R"({"cairn": 1, "bodies": [{"shapes": [{"kind": "sphere", "radius": 1}]}]})");
    CHECK(scene.duration == 10);
    CHECK(scene.dt == 1.0 / 60);
    CHECK(scene.world.gravity == Vec3{0, -9.81f, 0});
    CHECK(scene.world.restitution_threshold == 1);
    CHECK(scene.world.step.solver == Solver::SoftStep);
    CHECK(scene.world.step.narrow_phase == NarrowPhase::Sat);
    CHECK(scene.world.step.broad_phase == BroadPhase::Tree);
    CHECK(scene.world.sleeping);
    CHECK(scene.world.sleep_time == 0.5f);
    CHECK(scene.continuous);
    CHECK(scene.camera.eye == Vec3{8, 5, 8});
    CHECK(scene.camera.target == Vec3{0, 1, 0});
    const BodyDef& body = scene.bodies.at(0).def;
    CHECK(body.kind == BodyKind::Dynamic);
    CHECK(body.position == Position{});
    CHECK(body.gravity_scale == 1);
    CHECK(body.gyroscopic);
    CHECK(body.collision == CollisionFilter{});
    const ShapeDef& shape = body.shapes.at(0);
    CHECK(shape.density == 1000);
    CHECK(shape.material == Material{});
    CHECK(shape.material.friction == 0.6f);
    CHECK(shape.material.restitution == 0);
}

TEST_CASE("a number of the file is rounded once, to the nearest binary32") {
    // 1 + 2^-24, which is 1.00000005960464..., lies midway between two binary32 numbers.
    const Scene above = read_body(R"("linear_velocity": [1.0000000596047, 0.1, -0.0])");
    CHECK(above.bodies[0].def.linear_velocity.x == 1.00000012f);
    CHECK(above.bodies[0].def.linear_velocity.y == 0.1f);
    CHECK(std::signbit(above.bodies[0].def.linear_velocity.z));
    const Scene exact = read_body(R"("position": [0.1, 1e-300, 123456789.123456789])");
    CHECK(exact.bodies[0].def.position == Position{0.1, 1e-300, 123456789.123456789});
}

TEST_CASE("a rotation by an axis of any length is the quaternion of half the angle") {
    const Quat q =
        read_body(R"("rotation": {"axis": [0, 0, 250], "degrees": 90})").bodies[0].def.rotation;
    CHECK(q.x == 0);
    CHECK(q.y == 0);
    CHECK(std::fabs(q.z - 0.70710678f) < 1e-7f);
    CHECK(std::fabs(q.w - 0.70710678f) < 1e-7f);
    const Quat scaled = read_body(R"("rotation": [0, 0, 3, 4])").bodies[0].def.rotation;
    CHECK(scaled == Quat{0, 0, 0.6f, 0.8f});
    // As binary32 has it, this is unit already, and stays as it is.
    const Quat kept =
        read_body(R"("rotation": [0.5, 0.5, 0.5, 0.50000006])").bodies[0].def.rotation;
    CHECK(kept.w == 0.50000006f);
}

TEST_CASE("copies stand x fastest, then y, then z, about the body's position, and are named so") {
    const Scene scene = read(R"({"cairn": 1, "bodies": [
        {"shapes": [{"kind": "sphere", "radius": 0.1}]},
        {"repeat": {"count": [3, 2, 2], "spacing": [1, 10, 100]},
         "body": {"name": "c", "position": [5, 6, 7], "shapes": [{"kind": "sphere", "radius": 0.1}]}},
        {"shapes": [{"kind": "sphere", "radius": 0.1}]}]})");
    CHECK(scene::count_bodies(scene) == 14);
    const auto placed = scene::place_bodies(scene);
    REQUIRE(placed.size() == 14);
    CHECK(placed[0].name == "body[0]");
    CHECK(placed[1].name == "c[0,0,0]");
    CHECK(placed[2].name == "c[1,0,0]");
    CHECK(placed[4].name == "c[0,1,0]");
    CHECK(placed[7].name == "c[0,0,1]");
    CHECK(placed[13].name == "body[13]");
    CHECK(placed[1].position == Position{4, 1, -43});
    CHECK(placed[12].position == Position{6, 11, 57});
}

TEST_CASE("jitter stays within its bound, differs from copy to copy, and follows the seed") {
    const auto place = [](int seed) {
        return scene::place_bodies(read(
            R"({"cairn": 1, "bodies": [{"repeat": {"count": [10, 10, 10], "spacing": [0, 0, 0],
                "jitter": 0.25, "seed": )" +
            std::to_string(seed) +
            R"(}, "body": {"shapes": [{"kind": "sphere", "radius": 0.1}]}}]})"));
    };
    const auto first = place(7), again = place(7), other = place(8);
    std::set<double> coordinates;
    double lowest = 1, highest = -1;
    for (std::size_t i = 0; i < first.size(); ++i) {
        CHECK(first[i].position == again[i].position);
        for (const double c : {first[i].position.x, first[i].position.y, first[i].position.z}) {
            coordinates.insert(c);
            lowest = std::min(lowest, c);
            highest = std::max(highest, c);
        }
    }
    CHECK(coordinates.size() == 3000);
    CHECK(lowest >= -0.25);
    CHECK(highest <= 0.25);
    CHECK(highest - lowest > 0.49);
    CHECK(first[0].position != other[0].position);
    // The first copy has the generator's first three numbers, in the order x, y, z.
    scene::Pcg32 random(7);
    const double x = random.symmetric(0.25), y = random.symmetric(0.25), z = random.symmetric(0.25);
    CHECK(first[0].position == Position{x, y, z});
}

TEST_CASE("PCG32 gives the numbers that the definition of PCG-XSH-RR gives") {
    // Worked out by hand with whole numbers of any size: seed 42, increment 1442695040888963407.
    scene::Pcg32 random(42);
    std::uint64_t state = 42 + 1442695040888963407ull;
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    for (int i = 0; i < 1000; ++i) {
        const auto word = static_cast<std::uint32_t>(((state >> 18) ^ state) >> 27);
        const int turn = static_cast<int>(state >> 59);
        CHECK(random.next() == std::rotr(word, turn));
        state = state * 6364136223846793005ull + 1442695040888963407ull;
    }
}

TEST_CASE("a shape's material is the one that it names, or its own") {
    const Scene scene = read(R"({"cairn": 1, "bodies": [{"shapes": [
        {"kind": "sphere", "radius": 1, "material": "ice"},
        {"kind": "box", "half_extents": [1, 1, 1], "restitution": 0.5, "surface_velocity": [1, 0, 0]}]}],
        "materials": {"ice": {"friction": 0.02, "rolling_friction": 0.001}}})");
    const auto& shapes = scene.bodies[0].def.shapes;
    CHECK(shapes[0].material == Material{.friction = 0.02f, .rolling_friction = 0.001f});
    CHECK(shapes[1].material == Material{.restitution = 0.5f, .surface_velocity = {1, 0, 0}});
    CHECK(scene.bodies[0].materials[0] == "ice");
}

TEST_CASE("a scene that the format allows and the world refuses names the body") {
    // The mass of a ball this large overflows binary32.
    const Scene scene = read(R"({"cairn": 1, "bodies": [
        {"shapes": [{"kind": "sphere", "radius": 1}]}, {"shapes": [{"kind": "sphere", "radius": 1e30}]}]})");
    const auto built = scene::build_world(scene);
    REQUIRE_FALSE(built.ok());
    CHECK(built.error().message.substr(0, 11) == "bodies[1]: ");
}

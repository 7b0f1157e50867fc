// Scenes that are written read back to the same bits: the same text, the same world, the same
// future.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "scene/builtin.h"
#include "scene/json_writer.h"
#include "scene/pcg32.h"
#include "scene/scene.h"

namespace {

using namespace cairn;

std::uint64_t hash_after(const scene::Scene& scene, int steps) {
    auto built = scene::build_world(scene);
    INFO(built.error().message);
    REQUIRE(built.ok());
    World world = built->world;
    for (int i = 0; i < steps; ++i) REQUIRE(world.step(scene.dt).ok());
    return world.state_hash();
}

// Whether two numbers of JSON are the same, the sign of a zero included.
bool is_same_number(const nlohmann::json& a, const nlohmann::json& b) {
    return a == b && std::signbit(a.get<double>()) == std::signbit(b.get<double>());
}

// Each value of `given` must stand at its place in `written`. Rotations and normals come back in
// another form, of unit length; what they do is in the hash of the world.
void check_nothing_lost(const std::string& given, const std::string& written) {
    const nlohmann::json kept = nlohmann::json::parse(written).flatten();
    const nlohmann::json all = nlohmann::json::parse(given).flatten();
    for (const auto& item : all.items()) {
        const std::string& place = item.key();
        const nlohmann::json& value = item.value();
        CAPTURE(place);
        if (place.find("/rotation/") != std::string::npos) continue;
        if (place.find("/normal/") != std::string::npos) continue;
        REQUIRE(kept.contains(place));
        CAPTURE(kept[place].dump());
        CHECK((value.is_number() ? is_same_number(kept[place], value) : kept[place] == value));
    }
}

}  // namespace

TEST_CASE("every built-in scene, written and read, is the same scene with the same future") {
    for (const scene::Builtin& builtin : scene::builtins()) {
        CAPTURE(builtin.name);
        const auto made = scene::make_builtin(builtin, {});
        REQUIRE(made.ok());
        const std::string text = scene::write_scene(*made);
        const auto read = scene::read_scene(text);
        INFO(read.error().message);
        REQUIRE(read.ok());
        CHECK(scene::write_scene(*read) == text);
        CHECK(hash_after(*made, 5) == hash_after(*read, 5));
    }
}

TEST_CASE("a scene with every field of the format, written and read, is the same") {
    const std::string text =
        R"({"cairn": 1, "name": "all \"of\" it\n", "description": "Ä ∂", "duration": 3.25,
      "world": {"gravity": [0.1, -0.2, -0.0], "sleeping": false, "sleep_time": 0.25, "continuous": false, "restitution_threshold": 0.3},
      "step": {"dt": 0.0123456789012345678, "solver": "xpbd", "substeps": 7, "iterations": 3,
               "narrow_phase": "gjk-epa", "broad_phase": "brute-force"},
      "materials": {"ice": {"friction": 0.02, "restitution": 0.1, "rolling_friction": 0.3,
                            "spinning_friction": 0.4, "surface_velocity": [1, 2, 3]}},
      "bodies": [
        {"name": "k", "kind": "kinematic", "position": [1e-7, 1e7, 3.3], "rotation": [0.1, 0.2, 0.3, 0.4],
         "linear_velocity": [-0.0, 1, 2], "angular_velocity": [0.1, 0.2, 0.3],
         "shapes": [{"kind": "box", "half_extents": [0.1, 0.2, 0.3], "position": [1, 2, 3],
                     "rotation": {"axis": [1, 1, 0], "degrees": 33}, "density": 7.7, "material": "ice"}]},
        {"repeat": {"count": [2, 3, 4], "spacing": [1.1, 2.2, 3.3], "jitter": 0.01, "seed": 18446744073709551615},
         "body": {"name": "r", "shapes": [{"kind": "sphere", "radius": 0.25, "friction": 0.125}], "mass": 3,
           "linear_velocity": [-0.0, 0, 0],
           "gravity_scale": -0.5, "linear_damping": 0.1, "angular_damping": 0.2, "gyroscopic": false,
           "force": [1, 2, 3], "torque": [4, 5, 6], "lock": ["x", "rz"], "can_sleep": false, "continuous": true,
           "collision": {"category": 2, "mask": 4294967294, "group": -3}}},
        {"mass_properties": {"mass": 2, "center_of_mass": [0.1, 0, 0], "inertia": [1, 2, 2.5, 0.1, 0.2, 0.3]}},
        {"kind": "static", "shapes": [{"kind": "plane", "normal": [0.1, 1, 0], "offset": -1.5}]}],
      "camera": {"eye": [1, 2, 3], "target": [4, 5, 6]}})";
    const auto first = scene::read_scene(text);
    INFO(first.error().message);
    REQUIRE(first.ok());
    const std::string written = scene::write_scene(*first);
    const auto second = scene::read_scene(written);
    INFO(second.error().message);
    REQUIRE(second.ok());
    CHECK(scene::write_scene(*second) == written);
    check_nothing_lost(text, written);
    CHECK(second->name == "all \"of\" it\n");
    CHECK(second->description == "Ä ∂");
    CHECK(second->bodies[1].repeat == first->bodies[1].repeat);
    CHECK(second->bodies[1].def.lock == first->bodies[1].def.lock);
    CHECK(second->bodies[1].def.collision == first->bodies[1].def.collision);
    CHECK(second->world == first->world);
    CHECK(hash_after(*first, 0) == hash_after(*second, 0));
    CHECK(hash_after(*first, 10) == hash_after(*second, 10));
}

TEST_CASE("a number written reads back to the same bits, by way of binary64 too") {
    scene::Pcg32 random(1);
    for (int i = 0; i < 300000; ++i) {
        const std::uint32_t bits = random.next();
        float number;
        std::memcpy(&number, &bits, sizeof number);
        if (!(number == number) || number - number != 0) continue;
        std::string text;
        scene::append_number(text, number);
        const float back = static_cast<float>(std::strtod(text.c_str(), nullptr));
        REQUIRE(std::memcmp(&back, &number, sizeof number) == 0);
    }
    for (int i = 0; i < 300000; ++i) {
        const std::uint64_t bits = (std::uint64_t{random.next()} << 32) | random.next();
        double number;
        std::memcpy(&number, &bits, sizeof number);
        if (!(number == number) || number - number != 0) continue;
        std::string text;
        scene::append_number(text, number);
        const double back = std::strtod(text.c_str(), nullptr);
        REQUIRE(std::memcmp(&back, &number, sizeof number) == 0);
    }
    // The shortest digits of this one, read as binary64 and then rounded, are its neighbour's.
    const std::uint32_t between = 0x15ae43fd;
    float number;
    std::memcpy(&number, &between, sizeof number);
    std::string digits;
    scene::append_number(digits, number);
    CHECK(static_cast<float>(std::strtod(digits.c_str(), nullptr)) == number);
    std::string zero;
    scene::append_number(zero, -0.0f);
    CHECK(zero == "-0.0");
}

TEST_CASE("a built-in's parameters are checked, and the error lists them") {
    const scene::Builtin* pyramid = scene::find_builtin("pyramid");
    REQUIRE(pyramid != nullptr);
    const auto make = [&](std::string setting) {
        const std::vector<std::string> settings = {std::move(setting)};
        return scene::make_builtin(*pyramid, settings);
    };
    CHECK(make("base=4")->bodies.size() == 11);
    for (const char* bad : {"base", "base=", "base=x", "base=0", "base=201", "base=2.5", "bse=4",
                            "=4", "base=nan", "base=1e99", "base=4 "}) {
        CAPTURE(bad);
        const auto made = make(bad);
        REQUIRE_FALSE(made.ok());
        CHECK(made.error().message.find("base=20 (1 to 200, whole)") != std::string::npos);
    }
    CHECK(make("bse=4").error().message.find("did you mean \"base\"") != std::string::npos);
}

TEST_CASE(
    "every built-in scene stands at both ends of each parameter's range that a test can afford") {
    for (const scene::Builtin& builtin : scene::builtins()) {
        for (const scene::Parameter& parameter : builtin.parameters) {
            for (const double value :
                 {parameter.least, std::min(parameter.most, parameter.least + 40)}) {
                // The cradle needs fewer moving balls than balls.
                if (std::string_view(builtin.name) == "cradle" && value >= 5) continue;
                const double kept =
                    parameter.is_whole ? static_cast<double>(static_cast<int>(value)) : value;
                std::string text = parameter.name + std::string("=");
                scene::append_number(text, kept);
                CAPTURE(builtin.name);
                CAPTURE(text);
                const std::vector<std::string> settings = {text};
                const auto made = scene::make_builtin(builtin, settings);
                INFO(made.error().message);
                REQUIRE(made.ok());
                CHECK(scene::read_scene(scene::write_scene(*made)).ok());
                CHECK(scene::build_world(*made).ok());
            }
        }
    }
}

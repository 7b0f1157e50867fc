// The doctor: what will misbehave is told with its place and its cure; what is well is left alone.

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "scene/check.h"

namespace {

using namespace cairn;

// All findings, a line each.
std::string examine(const std::string& text) {
    const auto read = scene::read_scene(text);
    INFO(read.error().message);
    REQUIRE(read.ok());
    const auto findings = scene::find_misbehaviour(*read);
    INFO(findings.error().message);
    REQUIRE(findings.ok());
    std::string lines;
    for (const scene::Finding& finding : *findings) {
        CHECK_FALSE(finding.cure.empty());
        lines += finding.where + ": " + finding.what + "\n";
    }
    return lines;
}

const std::string ground =
    R"({"kind": "static", "shapes": [{"kind": "plane", "normal": [0, 1, 0]}]})";
std::string make_scene(const std::string& bodies, const std::string& more = "") {
    return R"({"cairn": 1, )" + more + R"("bodies": [)" + ground + ", " + bodies + "]}";
}
const std::string cube = R"("shapes": [{"kind": "box", "half_extents": [0.5, 0.5, 0.5]}])";

}  // namespace

TEST_CASE("a cube that stands on the ground has nothing wrong with it") {
    CHECK(examine(make_scene(R"({"position": [0, 0.5, 0], )" + cube + "}")) == "");
}

TEST_CASE("bodies that start inside each other are named with how deep they are") {
    const std::string lines =
        examine(make_scene(R"({"name": "a", "position": [0, 0.5, 0], )" + cube +
                           R"(}, {"name": "b", "position": [0, 1.3, 0], )" + cube + "}"));
    CHECK(lines.find("\"a\" and \"b\": they start 0.2 m inside each other") != std::string::npos);
}

TEST_CASE("a light cube that carries a heavy one, and the one below it, are named") {
    const std::string heavy =
        R"("shapes": [{"kind": "box", "half_extents": [0.5, 0.5, 0.5], "density": 20000}])";
    const std::string light =
        R"("shapes": [{"kind": "box", "half_extents": [0.5, 0.5, 0.5], "density": 100}])";
    const std::string bodies = R"({"name": "low", "position": [0, 0.5, 0], )" + light +
                               R"(}, {"name": "middle", "position": [0, 1.5, 0], )" + light +
                               R"(}, {"name": "top", "position": [0, 2.5, 0], )" + heavy + "}";
    const std::string lines = examine(make_scene(bodies));
    CHECK(lines.find("\"middle\": 100 kg carry 2e+04 kg, 200 times as much") != std::string::npos);
    CHECK(lines.find("\"low\": 100 kg carry 2.01e+04 kg, 201 times as much") != std::string::npos);
    CHECK(lines.find("\"top\"") == std::string::npos);
}

TEST_CASE("units, steps, speeds, masses and materials out of proportion are told") {
    const auto contains = [](const std::string& lines, const char* words) {
        CAPTURE(lines);
        CHECK(lines.find(words) != std::string::npos);
    };
    const std::string body = R"({"position": [0, 3, 0], )" + cube;
    contains(examine(make_scene(body + "}", R"("world": {"gravity": [0, -981, 0]}, )")),
             "world.gravity");
    contains(examine(make_scene(body + "}", R"("step": {"dt": 0.1}, )")), "step.dt");
    contains(examine(make_scene(body + R"(, "linear_velocity": [500, 0, 0]})")),
             "it can pass through things");
    contains(examine(make_scene(body + R"(, "angular_velocity": [500, 0, 0]})")),
             "degrees in a step");
    contains(examine(make_scene(
                 body + R"(, "mass_properties": {"mass": 1, "inertia": [90, 90, 90, 0, 0, 0]}})")),
             "more than its mass within its shapes can have");
    contains(
        examine(make_scene(
            body + R"(, "mass_properties": {"mass": 1, "inertia": [1e-6, 1e-6, 1e-6, 0, 0, 0]}})")),
        "spin wildly");
    contains(
        examine(make_scene(
            body +
            R"(, "mass_properties": {"mass": 1, "center_of_mass": [9, 0, 0], "inertia": [1, 1, 1, 0, 0, 0]}})")),
        "outside of the body's shapes");
    contains(
        examine(make_scene(
            R"({"position": [0, 900, 0], "shapes": [{"kind": "sphere", "radius": 300, "density": 6}]})")),
        "another unit than metres");
    contains(
        examine(make_scene(
            R"({"position": [0, 3, 0], "shapes": [{"kind": "sphere", "radius": 1, "density": 1}]})")),
        "densest metal");
    contains(
        examine(make_scene(
            R"({"position": [0, 3, 0], "shapes": [{"kind": "sphere", "radius": 1, "friction": 45}]})")),
        "rubber on dry concrete");
    contains(
        examine(make_scene(
            R"({"position": [0, 3, 0], "shapes": [{"kind": "box", "half_extents": [1, 1e-4, 1]}]})")),
        "thin, less than it falls");
    contains(examine(make_scene(R"({"name": "far", "position": [2e6, 3, 0], )" + cube + "}, " +
                                body + "}")),
             "\"far\": it stands 2e+03 km from the middle");
    contains(examine(make_scene(body + R"(, "lock": ["x", "y", "z", "rx", "ry", "rz"]})")),
             "cannot move at all");
    contains(examine(R"({"cairn": 1, "bodies": [{"name": "lost", )" + cube + "}]}"),
             "\"lost\": nothing is below it");
    contains(examine(R"({"cairn": 1, "bodies": [)" + ground + "]}"), "no body is dynamic");
}

TEST_CASE("of many alike only a few are told, with how many more there are") {
    const std::string lines = examine(make_scene(
        R"({"repeat": {"count": [10, 1, 1], "spacing": [0.5, 1, 1]}, "body": {"position": [0, 0.5, 0], )" +
        cube + "}}"));
    CHECK(lines.find("more like this)") != std::string::npos);
    CHECK(std::count(lines.begin(), lines.end(), '\n') < 8);
}

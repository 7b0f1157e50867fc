// `cairn query` from outside: the answers to the letter, and what is refused.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "support/command.h"

using namespace cairn::test;

namespace {

using Json = nlohmann::ordered_json;

// A ball of radius 0.5 over a plane, and a box that is turned by 45 degrees.
const char* const scene = R"({"cairn": 1, "name": "still", "bodies": [
  {"name": "floor", "kind": "static", "shapes": [{"kind": "plane", "normal": [0, 1, 0]}]},
  {"name": "ball", "position": [0, 3, 0], "shapes": [{"kind": "sphere", "radius": 0.5}]},
  {"name": "rock", "kind": "static", "position": [10, 1, 0],
   "shapes": [{"kind": "box", "half_extents": [1, 1, 1], "position": [0, 50, 0]},
              {"kind": "box", "half_extents": [1, 1, 1],
               "rotation": {"axis": [0, 1, 0], "degrees": 45}}]}]})";

Outcome ask(const std::string& arguments) { return call("query - " + arguments, scene); }

Json answer(const std::string& arguments) {
    const Outcome outcome = ask(arguments);
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.err.empty());
    return Json::parse(outcome.out);
}

void check_refused(const std::string& arguments, const std::string& words) {
    const Outcome outcome = ask(arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(outcome.err.find(words) != std::string::npos);
}

}  // namespace

TEST_CASE("a ray down onto the ball names it, and with --all the floor below it too") {
    const Json first = answer("--ray 0,5,0,0,-2,0");
    CHECK(first["scene"] == "still");
    CHECK(first["time"] == 0);
    const Json& ray = first["rays"][0];
    CHECK(ray["direction"] == Json({0, -2, 0}));
    CHECK(ray["length"].is_null());
    REQUIRE(ray["hits"].size() == 1);
    CHECK(ray["hits"][0] == Json::parse(R"({"body": "ball", "shape": 0, "distance": 1.5,
        "point": [0, 3.5, 0], "normal": [0, 1, 0], "inside": false})"));
    const Json all = answer("--all --ray 0,5,0,0,-2,0 --ray 0,5,0,0,-2,0,1 --ray=-4,9,0,0,-1,0");
    REQUIRE(all["rays"][0]["hits"].size() == 2);
    CHECK(all["rays"][0]["hits"][1]["body"] == "floor");
    CHECK(all["rays"][0]["hits"][1]["distance"] == 5);
    CHECK(all["rays"][1]["hits"].empty());
    CHECK(all["rays"][1]["length"] == 1);
    CHECK(all["rays"][2]["hits"][0]["point"] == Json({-4, 0, 0}));
}

TEST_CASE("a turned box is met on its corner's side, as the second shape of its body") {
    const Json hit = answer("--ray -5,1,0.5,1,0,0")["rays"][0]["hits"][0];
    CHECK(hit["body"] == "rock");
    CHECK(hit["shape"] == 1);
    CHECK(hit["distance"].get<double>() == doctest::Approx(15 - std::sqrt(2.0) + 0.5));
    CHECK(hit["normal"][0].get<double>() == doctest::Approx(-std::sqrt(0.5)));
}

TEST_CASE("points and boxes are answered beside rays, after as many steps as are asked for") {
    const Json told = answer("--point 0,4,0 --point 0,50,99,3 --box -1,-1,-1,1,4,1 --steps 30");
    CHECK(told["time"] == doctest::Approx(0.5));
    CHECK(told["rays"].empty());
    // Half a second of fall, 1.25 m.
    CHECK(told["points"][0]["nearest"]["body"] == "ball");
    CHECK(told["points"][0]["nearest"]["distance"].get<double>() > 1.7);
    CHECK(told["points"][1]["nearest"].is_null());
    CHECK(told["boxes"][0]["bodies"] == Json({"floor", "ball"}));
}

TEST_CASE("questions that make no sense are refused in one line") {
    check_refused("", "found no question; allowed: --ray, --point, --box");
    check_refused("--ray 1,2,3", "--ray: found \"1,2,3\"; allowed: ox,oy,oz,dx,dy,dz");
    check_refused("--ray 1,2,3,4,5,x", "--ray: found \"1,2,3,4,5,x\"");
    check_refused("--ray 1,2,3,4,5,6,", "--ray: found");
    check_refused("--ray 0,0,0,0,0,0", "ray.direction: a vector of length 0");
    check_refused("--ray nan,0,0,0,1,0", "ray.origin.x: nan; allowed: a finite number");
    check_refused("--ray 0,0,0,0,1e300,0", "ray.direction.y: inf");
    check_refused("--ray 0,0,0,0,1,0 --ray 0,0,0,0,1,0,-1", "ray.length: -1");
    check_refused("--point 1,2", "--point: found \"1,2\"");
    check_refused("--point 1,2,3,-1", "reach: -1");
    check_refused("--box 0,0,0,1,1,-1", "box.upper");
    check_refused("--ray 0,5,0,0,-1,0 --steps -1", "--steps");
}

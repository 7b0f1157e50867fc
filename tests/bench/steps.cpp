// Every benchmark scene in every build, with our own assertions on where there are any: a part of
// each that an unoptimised build steps in a moment.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cairn/cairn.h"
#include "cairn_scene.h"
#include "scenes.h"

namespace {

using namespace cairn;
using namespace cairn::bench;

constexpr std::size_t most_bodies = 200;
constexpr int enough_steps = 40;
constexpr int most_steps = 200;

// Whether the body bears or may bear one of the others, by the boxes about its parts.
bool is_near(const BenchScene& scene, const SceneBody& body, const std::vector<SceneBody>& others) {
    constexpr double reach = 2;
    const Part& part = scene.parts[body.first_part];
    if (body.part_count > 1 || part.form != Form::Box) return true;
    return std::any_of(others.begin(), others.end(), [&](const SceneBody& other) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double apart = std::abs(other.position[i] - body.position[i]);
            if (apart > part.half_extents[i] + reach) return false;
        }
        return true;
    });
}

// The first dynamic bodies, and of the others what drives or bears them.
std::vector<SceneBody> take_part(const BenchScene& scene) {
    std::vector<SceneBody> kept;
    for (const SceneBody& body : scene.bodies) {
        if (body.mobility == Mobility::Dynamic && kept.size() < most_bodies) kept.push_back(body);
    }
    const std::vector<SceneBody> dynamic = kept;
    std::size_t lonely = 0;
    for (const SceneBody& body : scene.bodies) {
        if (body.mobility == Mobility::Dynamic) continue;
        const bool is_alone = dynamic.empty() && lonely++ < most_bodies;
        if (is_alone || is_near(scene, body, dynamic)) kept.push_back(body);
    }
    return kept;
}

}  // namespace

TEST_CASE("every scene of the benchmark steps, meets, and breaks no assertion") {
    for (const SceneEntry& entry : scene_entries()) {
        CAPTURE(std::string(entry.name));
        const BenchScene scene = entry.make();
        World world = *World::create(describe_world(scene));
        for (const SceneBody& body : take_part(scene))
            REQUIRE(world.create_body(describe_body(scene, body)).ok());
        int steps_in_touch = 0;
        for (int step = 0; step < most_steps && steps_in_touch < enough_steps; ++step) {
            REQUIRE(world.step(scene.dt).ok());
            if (world.last_step().contact_count > 0) ++steps_in_touch;
        }
        CHECK(world.non_finite().empty());
        // Of two the bodies are there to be counted, and never meet.
        CHECK((steps_in_touch > 0) == !entry.is_memory_probe);
    }
}

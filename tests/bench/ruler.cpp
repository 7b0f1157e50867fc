// The ruler that judges every engine, against closed forms and against the library, and the scenes
// against the figures that they are known by.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "cairn/cairn.h"
#include "overlap.h"
#include "quality.h"
#include "scene_parts.h"
#include "scenes.h"
#include "splitmix64.h"

namespace {

using namespace cairn::bench;

double measure(const Part& a, const Vector& at_a, const Rotation& q_a, const Part& b,
               const Vector& at_b, const Rotation& q_b) {
    return measure_overlap(place_part(a, at_a, q_a), place_part(b, at_b, q_b));
}

const Rotation upright = {0, 0, 0, 1};
const Part unit_cube = {.form = Form::Box, .half_extents = {0.5, 0.5, 0.5}};
const Part ball = {.form = Form::Sphere, .radius = 0.5};

std::vector<BodyMotion> list_starts(const BenchScene& scene) {
    std::vector<BodyMotion> motions;
    for (const SceneBody& body : scene.bodies) {
        motions.push_back({.position = body.position, .rotation = body.rotation});
    }
    return motions;
}

std::ptrdiff_t count_moving(const BenchScene& scene) {
    return std::count_if(scene.bodies.begin(), scene.bodies.end(),
                         [](const SceneBody& body) { return body.mobility == Mobility::Dynamic; });
}

}  // namespace

TEST_CASE("the overlap of boxes and balls is the shortest way out") {
    CHECK(measure(unit_cube, {0, 0, 0}, upright, unit_cube, {0.3, 0.9, 0.2}, upright) ==
          doctest::Approx(0.1));
    CHECK(measure(unit_cube, {0, 0, 0}, upright, unit_cube, {0, 1.001, 0}, upright) == 0);
    // On its edge, 45 degrees about z: it reaches down by half the diagonal.
    const Rotation on_edge = {0, 0, std::sin(std::acos(-1.0) / 8), std::cos(std::acos(-1.0) / 8)};
    CHECK(measure(unit_cube, {0, 0, 0}, upright, unit_cube, {0, 1.1, 0}, on_edge) ==
          doctest::Approx(0.5 + std::sqrt(0.5) - 1.1));
    // Edge across edge: about z below, about x above, both on edge.
    const Rotation across = {on_edge[2], 0, 0, on_edge[3]};
    CHECK(measure(unit_cube, {0, 0, 0}, on_edge, unit_cube, {0, 1.4, 0}, across) ==
          doctest::Approx(2 * std::sqrt(0.5) - 1.4));
    CHECK(measure(ball, {0, 0, 0}, upright, ball, {0.6, 0, 0.8}, upright) == doctest::Approx(0.0));
    CHECK(measure(ball, {0, 0, 0}, upright, ball, {0, 0.9, 0}, upright) == doctest::Approx(0.1));
    CHECK(measure(unit_cube, {0, 0, 0}, upright, ball, {0, 0.95, 0}, upright) ==
          doctest::Approx(0.05));
    CHECK(measure(ball, {0.8, 0.8, 0.5}, upright, unit_cube, {0, 0, 0}, upright) ==
          doctest::Approx(0.5 - std::sqrt(0.18)));
    CHECK(measure(unit_cube, {0, 0, 0}, upright, ball, {0.1, 0.2, 0}, upright) ==
          doctest::Approx(0.5 + 0.3));
}

TEST_CASE("the ruler and the library agree on how deep boxes overlap") {
    SplitMix64 random(1);
    int overlapping = 0;
    for (int i = 0; i < 2000; ++i) {
        BenchScene scene;
        Vector away = {};
        for (double& x : away) x = random.draw_between(-0.7, 0.7);
        const Vector size = {random.draw_between(0.2, 0.5), random.draw_between(0.2, 0.5),
                             random.draw_between(0.2, 0.5)};
        add_box(scene, {0, 0, 0}, cube(0.5), 1000, random.draw_rotation());
        add_box(scene, away, size, 1000, random.draw_rotation());
        const Quality quality = measure_quality(scene, list_starts(scene));

        cairn::World world;
        for (const SceneBody& body : scene.bodies) {
            const Vector& h = scene.parts[body.first_part].half_extents;
            const Rotation& q = body.rotation;
            cairn::BodyDef def{.position = {body.position[0], body.position[1], body.position[2]},
                               .rotation = {static_cast<float>(q[0]), static_cast<float>(q[1]),
                                            static_cast<float>(q[2]), static_cast<float>(q[3])}};
            def.shapes.push_back(
                {.geometry = cairn::Box{{static_cast<float>(h[0]), static_cast<float>(h[1]),
                                         static_cast<float>(h[2])}}});
            REQUIRE(world.create_body(def));
        }
        const double deepest = cairn::World::penetration(world.contacts()).deepest;
        CHECK(quality.deepest_penetration == doctest::Approx(deepest).epsilon(0.02));
        if (quality.deepest_penetration > 0) ++overlapping;
    }
    CHECK(overlapping > 1000);
}

TEST_CASE("a capsule overlaps balls, capsules and boxes by what its core and radius say") {
    const Part rod{.form = Form::Capsule, .radius = 0.2, .half_height = 1};
    const double half = std::sqrt(0.5);
    const Rotation level = {0, 0, half, half};
    CHECK(measure(rod, {0, 0, 0}, upright, ball, {0.6, 0.7, 0}, upright) == doctest::Approx(0.1));
    CHECK(measure(ball, {0, 1.6, 0}, upright, rod, {0, 0, 0}, upright) == doctest::Approx(0.1));
    CHECK(measure(rod, {0, 0, 0}, upright, rod, {0.3, 1.5, 0}, upright) == doctest::Approx(0.1));
    CHECK(measure(rod, {0, 0, 0}, upright, rod, {0.5, 0.5, 0.35}, level) == doctest::Approx(0.05));
    // Lying on a cube's face, beside it, and through it.
    CHECK(measure(unit_cube, {0, 0, 0}, upright, rod, {0, 0.65, 0}, level) ==
          doctest::Approx(0.05));
    CHECK(measure(rod, {0, 0.75, 0}, level, unit_cube, {0, 0, 0}, upright) == 0);
    CHECK(measure(unit_cube, {0, 0, 0}, upright, rod, {0.1, 0, 0}, upright) ==
          doctest::Approx(0.4 + 0.2));
    CHECK(measure(unit_cube, {0, 0, 0}, upright, rod, {0, 1.6, 0}, upright) ==
          doctest::Approx(0.1));
}

TEST_CASE("the sweep finds every overlapping pair of a heap") {
    BenchScene scene;
    SplitMix64 random(2);
    for (int i = 0; i < 300; ++i) {
        const Vector at = {random.draw_between(0, 6), random.draw_between(0, 6),
                           random.draw_between(0, 6)};
        if (i % 3 == 0) add_static_box(scene, at, cube(0.4));
        if (i % 3 == 1) add_box(scene, at, cube(0.4), 1000, random.draw_rotation());
        if (i % 6 == 2) add_sphere(scene, at, 0.4, 1000);
        if (i % 6 == 5) add_capsule(scene, at, 0.3, 0.3, 1000, random.draw_rotation());
    }
    std::size_t count = 0;
    double sum = 0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const SceneBody& a = scene.bodies[i];
            const SceneBody& b = scene.bodies[j];
            if (a.mobility == Mobility::Static && b.mobility == Mobility::Static) continue;
            const double depth = measure(scene.parts[a.first_part], a.position, a.rotation,
                                         scene.parts[b.first_part], b.position, b.rotation);
            count += depth > 0 ? 1 : 0;
            sum += depth;
        }
    }
    const Quality quality = measure_quality(scene, list_starts(scene));
    CHECK(quality.overlapping_pairs == count);
    CHECK(quality.mean_penetration == doctest::Approx(sum / static_cast<double>(count)));
    CHECK(count > 100);
}

TEST_CASE("a rolling ball, a tumbling box and a tumbling capsule have the energy of the textbook") {
    BenchScene scene;
    add_sphere(scene, {0, 5, 0}, 0.5, 1000);
    add_box(scene, {9, 5, 0}, {0.5, 1, 1.5}, 100);
    add_capsule(scene, {-9, 5, 0}, 1, 0.5, 1);
    const double ball_mass = 4.0 / 3 * std::acos(-1.0) * 125;
    std::vector<BodyMotion> motions = list_starts(scene);
    motions[0].linear_velocity = {2, 0, 0};
    motions[0].angular_velocity = {0, 0, -4};
    motions[1].angular_velocity = {0, 3, 0};
    motions[2].angular_velocity = {2, 3, 0};
    const double capsule_mass = 2.0943951;
    // 7/10 m v^2, and 1/24 m (w^2 + d^2) omega^2.
    CHECK(measure_quality(scene, motions).kinetic_energy ==
          doctest::Approx(0.7 * ball_mass * 4 + 600.0 / 24 * (1 + 9) * 9 +
                          0.5 * capsule_mass * (0.665625 * 4 + 0.11875 * 9)));
}

TEST_CASE("what fell through the ground, or is not a number, is lost") {
    BenchScene scene;
    for (int i = 0; i < 3; ++i) add_sphere(scene, {3.0 * i, 1, 0}, 0.5, 1000);
    expect_standing(scene, 2);
    std::vector<BodyMotion> motions = list_starts(scene);
    motions[0].position[1] = -1;
    motions[1].linear_velocity[2] = std::nan("");
    motions[2].position[0] += 0.25;
    const Quality quality = measure_quality(scene, motions);
    CHECK(quality.lost_bodies == 2);
    CHECK(quality.drift == doctest::Approx(0.25));
}

TEST_CASE("the scenes have the bodies that they are known for, and none starts inside another") {
    struct Known {
        const char* name;
        std::ptrdiff_t moving;
        double overlap;  // m, at most, at the start
    };
    // The shapes of the mixed heap are dropped closer than the largest are wide.
    constexpr Known known[] = {{"pyramid20", 210, 1e-9},      {"pyramid40", 820, 1e-9},
                               {"large-pyramid", 5050, 1e-9}, {"many-pyramids", 10780, 1e-9},
                               {"pyramids-30k", 31680, 1e-9}, {"wide-pyramid", 1240, 0.026},
                               {"grid1000", 1000, 1e-9},      {"tower", 50, 1e-9},
                               {"tower-heavy", 20, 1e-9},     {"seesaw", 4, 1e-9},
                               {"spheres5000", 5000, 1e-9},   {"spheres10000", 10000, 1e-9},
                               {"mixed4096", 4096, 0.2},      {"washer", 8000, 1e-9},
                               {"capsules1000", 1000, 1e-9},  {"field", 12006, 1e-9},
                               {"field-one", 6, 1e-9},        {"moving-boxes", 10000, 1e-9}};
    for (const Known& scene : known) {
        CAPTURE(scene.name);
        const SceneEntry* const entry = find_scene(scene.name);
        REQUIRE(entry != nullptr);
        const BenchScene made = entry->make();
        CHECK(count_moving(made) == scene.moving);
        const Quality quality = measure_quality(made, list_starts(made));
        CHECK(quality.deepest_penetration <= scene.overlap);
        CHECK(quality.lost_bodies == 0);
        CHECK(quality.kinetic_energy == 0);
    }
}

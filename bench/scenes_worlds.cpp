// Scenes that are large and mostly still, and the two from which bytes a body are read.

#include "scene_parts.h"
#include "scenes.h"

namespace cairn::bench {

namespace {

constexpr double turntable_speed = 0.5;  // rad/s: slow enough to stand on, never asleep

// A pyramid of six cubes on a table that turns below it, so that it never sleeps.
void add_awake_pyramid(BenchScene& scene) {
    scene.bodies.push_back({.mobility = Mobility::Kinematic,
                            .first_part = static_cast<std::uint32_t>(scene.parts.size()),
                            .position = {0, 0.25, 0},
                            .angular_velocity = {0, static_cast<float>(turntable_speed), 0}});
    scene.parts.push_back({.form = Form::Box, .half_extents = {2.5, 0.25, 2.5}});
    add_pyramid(scene, 3, 0.5, 1.05, 1000, {0, 0.5, 0});
}

BenchScene make_field_scene() {
    BenchScene scene;
    scene.may_sleep = true;
    scene.settle_steps = 300;
    add_ground(scene, 200);
    add_awake_pyramid(scene);
    return scene;
}

}  // namespace

BenchScene make_large_world() {
    constexpr int side = 1000;
    constexpr double cell = 10;
    constexpr int spheres = 99;
    BenchScene scene;
    scene.may_sleep = true;
    scene.lost_below = -1;
    scene.bodies.reserve(side * side + spheres);
    for (int i = 0; i < side * side; ++i) {
        const double x = cell * (i / side - 0.5 * (side - 1));
        const double z = cell * (i % side - 0.5 * (side - 1));
        add_static_box(scene, {x, 0, z}, {0.5 * cell, 0.25, 0.5 * cell});
    }
    scene.initial_bodies = scene.bodies.size();
    scene.spawn_every = 5;
    // Each on a box of its own, all over the inner part.
    for (int i = 0; i < spheres; ++i) {
        add_sphere(scene, {800.0 * (i % 10) - 3595, 1.5, 800.0 * (i / 10) - 3595}, 0.5, 1000);
    }
    return scene;
}

BenchScene make_field() {
    BenchScene scene = make_field_scene();
    for (int i = 0; i < 45 * 45 && scene.standing.size() < 2000; ++i) {
        // The middle is the turntable's.
        const int column = i % 45 - 22;
        const int row = i / 45 - 22;
        if (column == 0 && row == 0) continue;
        expect_standing(scene,
                        add_pyramid(scene, 3, 0.5, 1.05, 1000, {8.0 * column, 0, 8.0 * row}));
    }
    return scene;
}

BenchScene make_field_one() { return make_field_scene(); }

BenchScene make_static_boxes() {
    BenchScene scene;
    scene.bodies.reserve(100'000);
    for (int i = 0; i < 100'000; ++i) {
        add_static_box(scene, {2.0 * (i % 400), 0, 2.0 * (i / 400)}, cube(0.5));
    }
    return scene;
}

BenchScene make_moving_boxes() {
    BenchScene scene;
    scene.bodies.reserve(10'000);
    for (int i = 0; i < 10'000; ++i) {
        add_box(scene, {2.0 * (i % 100), 10, 2.0 * (i / 100)}, cube(0.5), 1000);
    }
    return scene;
}

}  // namespace cairn::bench

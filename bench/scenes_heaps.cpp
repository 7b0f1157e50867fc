// Scenes of what falls into a heap: nothing in them should stand, but nothing should overlap or get
// lost either.

#include <cmath>

#include "scene_parts.h"
#include "scenes.h"
#include "splitmix64.h"

namespace cairn::bench {

namespace {

BenchScene make_spheres(int count, double pit_height) {
    constexpr int side = 16;
    constexpr double pitch = 0.95;
    constexpr double jitter = 0.05;
    BenchScene scene;
    scene.gravity = 9.81;
    scene.friction = 0.5;
    add_ground(scene, 100);
    add_pit(scene, 8, pit_height);
    SplitMix64 random(5000);
    for (int i = 0; i < count; ++i) {
        const int layer = i / (side * side);
        const double x =
            pitch * (i % side - 0.5 * (side - 1)) + random.draw_between(-jitter, jitter);
        const double z =
            pitch * (i / side % side - 0.5 * (side - 1)) + random.draw_between(-jitter, jitter);
        add_sphere(scene, {x, layer + 0.5 + random.draw_between(-jitter, jitter), z}, 0.4, 1000);
    }
    return scene;
}

}  // namespace

BenchScene make_spheres5000() { return make_spheres(5000, 20); }

BenchScene make_spheres10000() { return make_spheres(10'000, 40); }

BenchScene make_mixed4096() {
    constexpr int side = 12;
    constexpr double pitch = 1.6;
    BenchScene scene;
    scene.gravity = 9.81;
    scene.friction = 0.5;
    add_ground(scene, 100);
    add_pit(scene, 10, 30);
    SplitMix64 random(4096);
    // 96 shapes, in turn a box, a ball and a capsule.
    std::vector<Vector> sizes(96);
    for (Vector& size : sizes) {
        for (double& length : size) length = random.draw_between(0.2, 0.5);
    }
    for (std::size_t i = 0; i < 4096; ++i) {
        const auto place = static_cast<int>(i % (side * side));
        const auto layer = static_cast<double>(i / (side * side));
        const Vector position = {pitch * (place % side - 0.5 * (side - 1)), 1 + 1.5 * layer,
                                 pitch * (place / side - 0.5 * (side - 1))};
        const std::size_t turn = i % sizes.size();
        const Vector& size = sizes[turn];
        const Rotation rotation = random.draw_rotation();
        if (turn % 3 == 0) add_box(scene, position, size, 1000, rotation);
        if (turn % 3 == 1) add_sphere(scene, position, size[0], 1000);
        if (turn % 3 == 2) add_capsule(scene, position, size[1], size[0], 1000, rotation);
    }
    return scene;
}

BenchScene make_capsules1000() {
    constexpr int side = 10;
    constexpr double pitch = 1;
    BenchScene scene;
    scene.gravity = 9.81;
    scene.friction = 0.5;
    add_ground(scene, 100);
    add_pit(scene, 5, 20);
    SplitMix64 random(1000);
    for (int i = 0; i < 1000; ++i) {
        const int layer = i / (side * side);
        const Vector position = {pitch * (i % side - 0.5 * (side - 1)), 0.6 + layer,
                                 pitch * (i / side % side - 0.5 * (side - 1))};
        add_capsule(scene, position, 0.3, 0.2, 1000, random.draw_rotation());
    }
    return scene;
}

BenchScene make_washer() {
    constexpr double pi = 3.14159265358979323846;
    constexpr int segments = 36;
    constexpr double inner = 16;
    constexpr double outer = 18;
    const double half_angle = pi / segments;
    const Vector axle = {0, 21, 0};
    BenchScene scene;
    add_ground(scene, 60);

    // Each box is placed along a spoke: x outward, y along the rim, z along the axle. At the rim
    // neighbours meet outside and overlap inside, so there is no gap.
    SceneBody drum{.mobility = Mobility::Kinematic,
                   .first_part = static_cast<std::uint32_t>(scene.parts.size()),
                   .part_count = segments + 4,
                   .position = axle,
                   .angular_velocity = {0, 0, static_cast<float>(25 * pi / 180)}};
    const auto add_spoke = [&](double angle, double from, double to) {
        const double middle = 0.5 * (from + to);
        scene.parts.push_back({.form = Form::Box,
                               .half_extents = {0.5 * (to - from), to * std::tan(half_angle), 10},
                               .position = {middle * std::cos(angle), middle * std::sin(angle), 0},
                               .rotation = {0, 0, std::sin(0.5 * angle), std::cos(0.5 * angle)}});
    };
    for (int i = 0; i < segments; ++i) add_spoke((2 * i + 1) * half_angle, inner, outer);
    for (int i = 0; i < 4; ++i) add_spoke((18 * i + 1) * half_angle, inner - 2, inner);
    scene.bodies.push_back(drum);

    constexpr int side = 20;
    constexpr double pitch = 0.8;
    for (int i = 0; i < side * side * side; ++i) {
        const Vector cell = {static_cast<double>(i / (side * side)),
                             static_cast<double>(i / side % side), static_cast<double>(i % side)};
        Vector position = axle;
        for (std::size_t k = 0; k < 3; ++k) position[k] += pitch * (cell[k] - 0.5 * (side - 1));
        add_box(scene, position, cube(0.2), 1000);
    }
    return scene;
}

}  // namespace cairn::bench

// Built-in scenes without gravity: billiards, the cradle, the T-handle.

#include <fmt/format.h>

#include <cmath>

#include "scene/builtin_parts.h"

namespace cairn::scene {

Scene make_billiards(std::span<const double> values) {
    const double radius = 0.028575, gap = 0.0001, pitch = 2 * radius + gap;
    Scene scene;
    scene.name = "Billiards";
    scene.description = "Balls of 0.17 kg and restitution 0.95, without friction or gravity.";
    scene.duration = 4;
    scene.dt = 1.0 / 240;
    scene.world.gravity = {0, 0, 0};
    scene.world.restitution_threshold = 0.01f;
    scene.camera = {{0, 1.5f, 1.1f}, {0, 0, 0}};
    const Material ivory = {.friction = 0, .restitution = 0.95f};
    const Material rubber = {.friction = 0, .restitution = 0.8f};
    if (values[1] > 0) {
        // The bed is for the eye: a millimetre below the balls, which never fall.
        scene.bodies.push_back(
            make_block("bed", {0, -radius - 0.051, 0}, {1.1f, 0.05f, 0.6f}, rubber));
        scene.bodies.push_back(
            make_block("cushion[-x]", {-1.05, 0, 0}, {0.05f, 0.03f, 0.6f}, rubber));
        scene.bodies.push_back(
            make_block("cushion[+x]", {1.05, 0, 0}, {0.05f, 0.03f, 0.6f}, rubber));
        scene.bodies.push_back(make_block("cushion[-z]", {0, 0, -0.55}, {1, 0.03f, 0.05f}, rubber));
        scene.bodies.push_back(make_block("cushion[+z]", {0, 0, 0.55}, {1, 0.03f, 0.05f}, rubber));
    }
    const double foot = 0.4;
    SceneBody cue = make_ball("cue", {foot - 0.3, 0, 0}, radius, ivory);
    cue.def.mass = 0.17f;
    cue.def.linear_velocity = {narrow(values[0]), 0, 0};
    scene.bodies.push_back(cue);
    const double row_pitch = pitch * std::sqrt(0.75);
    int number = 1;
    for (int row = 0; row < 5; ++row) {
        for (int i = 0; i <= row; ++i) {
            SceneBody ball =
                make_ball(fmt::format("ball[{}]", number++),
                          {foot + row * row_pitch, 0, (i - 0.5 * row) * pitch}, radius, ivory);
            ball.def.mass = 0.17f;
            scene.bodies.push_back(ball);
        }
    }
    return scene;
}

Scene make_cradle(std::span<const double> values) {
    const int balls = static_cast<int>(values[0]), moving = static_cast<int>(values[1]);
    const double radius = 0.1, gap = 0.02, pitch = 2 * radius + gap, speed = 1.5, run = 0.8;
    Scene scene;
    scene.name = "Cradle";
    scene.description =
        "A row of balls between two walls, restitution 1, without friction or gravity.";
    scene.duration = 10;
    scene.dt = 1.0 / 240;
    scene.world.gravity = {0, 0, 0};
    scene.world.restitution_threshold = 0.01f;
    const double end = 0.5 * (balls - 1) * pitch + radius + run;
    scene.camera = {{0, narrow(0.5 * end), narrow(1.6 * end)}, {0, 0, 0}};
    const Material steel = {.friction = 0, .restitution = 1};
    scene.bodies.push_back(make_block("wall[-x]", {-end - 0.1, 0, 0}, {0.1f, 0.3f, 0.3f}, steel));
    scene.bodies.push_back(make_block("wall[+x]", {end + 0.1, 0, 0}, {0.1f, 0.3f, 0.3f}, steel));
    // The gap is wider than a ball's way in a step, so that blows pass on one after the other.
    for (int i = 0; i < balls; ++i) {
        double x = (i - 0.5 * (balls - 1)) * pitch;
        if (i < moving) x -= 0.5 * run;
        SceneBody ball = make_ball(fmt::format("ball[{}]", i), {x, 0, 0}, radius, steel, 7800);
        if (i < moving) ball.def.linear_velocity = {narrow(speed), 0, 0};
        scene.bodies.push_back(ball);
    }
    return scene;
}

Scene make_t_handle(std::span<const double> values) {
    Scene scene;
    scene.name = "T-handle";
    scene.description = "A T that spins about its stem, whose moment of inertia is the middle one.";
    scene.duration = 20;
    scene.dt = 1.0 / 240;
    scene.world.gravity = {0, 0, 0};
    scene.camera = {{0.6f, 0.5f, 1.5f}, {0, 0, 0}};
    SceneBody handle;
    handle.name = "handle";
    // The bar has 6 kg, the stem 3 kg: their common center of mass is the body's origin.
    ShapeDef bar;
    bar.geometry = Box{{0.3f, 0.05f, 0.05f}};
    bar.local_pose.position = {0, narrow(0.2 / 3), 0};
    ShapeDef stem;
    stem.geometry = Box{{0.05f, 0.15f, 0.05f}};
    stem.local_pose.position = {0, narrow(-0.4 / 3), 0};
    handle.def.shapes = {bar, stem};
    handle.def.angular_velocity = {narrow(0.005 * values[0]), narrow(values[0]), 0};
    scene.bodies.push_back(handle);
    return scene;
}

}  // namespace cairn::scene

// Built-in scenes in which bodies meet the ground or a belt one by one: falling, bouncing, sliding,
// rolling.

#include <fmt/format.h>

#include "scene/builtin_parts.h"

namespace cairn::scene {

Scene make_drop(std::span<const double> values) {
    const double height = values[0];
    Scene scene;
    scene.name = "Drop";
    scene.description = "A box, a ball and a bar fall on the floor.";
    scene.duration = 6;
    scene.camera = {{4, 3, 7}, {0, narrow(0.2 * height), 0}};
    scene.bodies.push_back(make_ground());
    SceneBody box = make_box("box", {0, height, 0}, {0.5f, 0.5f, 0.5f});
    box.def.rotation = turn_about_z(to_radians(35)) * turn_about_x(to_radians(25));
    scene.bodies.push_back(box);
    scene.bodies.push_back(make_ball("ball", {-1.6, height, 0}, 0.4, {.restitution = 0.5f}));
    SceneBody bar = make_box("bar", {1.6, height + 0.5, 0}, {0.15f, 0.8f, 0.15f});
    bar.def.rotation = turn_about_z(to_radians(20));
    bar.def.angular_velocity = {1, 2, 0};
    scene.bodies.push_back(bar);
    return scene;
}

Scene make_bounce(std::span<const double> values) {
    const double height = values[0], radius = 0.3;
    Scene scene;
    scene.name = "Bounce";
    scene.description = "Balls of restitution 0, 0.2, 0.4, 0.6, 0.8 and 1 fall side by side.";
    scene.duration = 8;
    scene.dt = 1.0 / 240;
    scene.world.restitution_threshold = 0.05f;
    scene.camera = {{0, narrow(0.6 * height), narrow(4 + 1.2 * height)},
                    {0, narrow(0.45 * height), 0}};
    scene.bodies.push_back(make_ground({.friction = 0}));
    for (int i = 0; i <= 5; ++i) {
        const Material material = {.friction = 0, .restitution = narrow(i / 5.0)};
        scene.bodies.push_back(make_ball(fmt::format("e={:.1f}", i / 5.0),
                                         {i - 2.5, radius + height, 0}, radius, material));
    }
    return scene;
}

Scene make_incline(std::span<const double> values) {
    const double slope = to_radians(values[0]);
    Scene scene;
    scene.name = "Blocks on an incline";
    scene.description = "Blocks whose friction against the ramp is 0.1, 0.2, 0.3, 0.4 and 0.5.";
    scene.duration = 4;
    scene.camera = {{5, 5, 9}, {0, 2, 0}};
    scene.bodies.push_back(make_ground());

    // The ramp's upper face falls towards +x and passes through (0, 2.6, 0).
    const double along[2] = {cosine(slope), -sine(slope)};
    const double normal[2] = {sine(slope), cosine(slope)};
    const double half_length = 4, half_thickness = 0.2, middle = 2.6;
    SceneBody ramp =
        make_block("ramp", {-half_thickness * normal[0], middle - half_thickness * normal[1], 0},
                   {narrow(half_length), narrow(half_thickness), 2.5f}, {.friction = 1});
    ramp.def.rotation = turn_about_z(-slope);
    scene.bodies.push_back(ramp);

    // Two materials meet with the geometric mean: mu^2 on the ramp's 1 gives mu.
    for (int i = 1; i <= 5; ++i) {
        const double mu = i / 10.0, half_height = 0.1, place = -3;
        const Position center = {place * along[0] + half_height * normal[0],
                                 middle + place * along[1] + half_height * normal[1],
                                 i * 0.8 - 2.4};
        SceneBody block = make_box(fmt::format("mu={:.1f}", mu), center, {0.25f, 0.1f, 0.25f},
                                   {.friction = narrow(mu * mu)});
        block.def.rotation = turn_about_z(-slope);
        scene.bodies.push_back(block);
    }
    return scene;
}

Scene make_roll(std::span<const double> values) {
    const double speed = values[0], radius = 0.3;
    Scene scene;
    scene.name = "Sliding into rolling";
    scene.description =
        "Balls start without spin; friction takes speed and gives spin until they roll.";
    scene.duration = 4;
    scene.dt = 1.0 / 120;
    scene.camera = {{2, 6, 14}, {6, 0, 0}};
    scene.bodies.push_back(make_ground({.friction = 1}));
    constexpr double frictions[] = {0.05, 0.1, 0.2, 0.3, 0.5};
    for (int i = 0; i < 5; ++i) {
        const double mu = frictions[i];
        SceneBody ball = make_ball(fmt::format("mu={}", mu), {-2, radius, (i - 2) * 1.2}, radius,
                                   {.friction = narrow(mu * mu)});
        ball.def.linear_velocity = {narrow(speed), 0, 0};
        scene.bodies.push_back(ball);
    }
    return scene;
}

Scene make_conveyor(std::span<const double> values) {
    const float speed = narrow(values[0]);
    const int count = static_cast<int>(values[1]);
    Scene scene;
    scene.name = "Conveyor";
    scene.description = "Parcels ride three belts, down a level at each end.";
    scene.duration = 16;
    scene.camera = {{1, 6, 12}, {0, 1.5f, 0}};
    scene.bodies.push_back(make_ground());
    // Each belt ends short of the one below, rails keep the parcels on, and walls stop them at the
    // turns.
    const double heights[] = {3.2, 2.0, 0.8}, shifts[] = {-0.6, 0.6, -0.6};
    const Material slippery = {.friction = 0};
    for (int i = 0; i < 3; ++i) {
        const float way = i % 2 == 0 ? speed : -speed;
        scene.bodies.push_back(make_block(fmt::format("belt[{}]", i), {shifts[i], heights[i], 0},
                                          {3, 0.1f, 0.8f},
                                          {.friction = 0.5f, .surface_velocity = {way, 0, 0}}));
        for (const double side : {-1.0, 1.0}) {
            scene.bodies.push_back(make_block(fmt::format("rail[{},{}]", i, side < 0 ? "-z" : "+z"),
                                              {0, heights[i] + 0.1, side * 0.86},
                                              {3.65f, 0.2f, 0.05f}, slippery));
        }
    }
    scene.bodies.push_back(make_block("wall[0]", {3.75, 3.0, 0}, {0.1f, 1.2f, 0.9f}, slippery));
    scene.bodies.push_back(make_block("wall[1]", {-3.75, 1.8, 0}, {0.1f, 1.2f, 0.9f}, slippery));
    // Parcels fall on the highest belt, six abreast, one layer after the other.
    for (int i = 0; i < count; ++i) {
        const Position p = {-3 + 0.8 * (i % 6), 3.55 + 0.6 * (i / 6), 0.25 * (i % 3 - 1)};
        const float half = narrow(0.14 + 0.03 * (i % 3));
        scene.bodies.push_back(make_box(fmt::format("parcel[{}]", i), p, {1.3f * half, half, half},
                                        {.friction = 0.5f}, 300));
    }
    return scene;
}

}  // namespace cairn::scene

// The scene that `./run` shows: a chain of causes. Small dominoes round a bend push ever larger
// ones, the last sets a ball rolling, the ball runs down a ramp into a pyramid.
//
// The way goes along +x. The dominoes stand on a deck four metres up; the ramp leads from its edge
// at x = -4 down to the ground at x = 4; the pyramid stands beyond.

#include <fmt/format.h>

#include "scene/builtin_parts.h"

namespace cairn::scene {

namespace {

constexpr double deck = 4;

// A domino of the given height whose middle stands at (x, z) on the deck, facing along `heading`.
SceneBody make_domino(int number, double x, double z, double height, double heading) {
    SceneBody domino = make_box(fmt::format("domino[{}]", number), {x, deck + height / 2, z},
                                {narrow(height / 16), narrow(height / 2), narrow(height / 4)},
                                {.friction = 0.4f}, 700);
    domino.def.rotation = turn_about_y(heading);
    return domino;
}

void add_dominoes(Scene& scene) {
    constexpr double small = 0.5, gap = 0.22, bend_radius = 2.2;
    int number = 0;
    // Out along -x, round half a circle, and back along +x.
    for (int i = 0; i < 26; ++i) {
        SceneBody domino = make_domino(number++, -10.2 - i * gap, -2 * bend_radius, small, 0);
        if (i == 0) {
            // The push: 3 rad/s about the lower edge that lies ahead.
            domino.def.angular_velocity = {0, 0, 3};
            domino.def.linear_velocity = {narrow(-3 * small / 2), narrow(3 * small / 16), 0};
        }
        scene.bodies.push_back(domino);
    }
    const double end = -10.2 - 25 * gap - gap;
    constexpr int bend_count = 31;
    for (int i = 0; i < bend_count; ++i) {
        const double turn = pi * i / (bend_count - 1);
        scene.bodies.push_back(make_domino(number++, end - bend_radius * sine(turn),
                                           -bend_radius - bend_radius * cosine(turn), small, turn));
    }
    // Each is larger than the one before, up to the ball.
    double x = end, height = small;
    while (x < -7.6) {
        x += 0.44 * height;
        height *= 1.06;
        scene.bodies.push_back(make_domino(number++, x, 0, height, 0));
    }
    const double radius = 0.7;
    scene.bodies.push_back(make_ball("ball",
                                     {x + height / 16 + 0.25 * height + radius, deck + radius, 0},
                                     radius, {.friction = 0.8f}, 1500));
}

void add_square_pyramid(Scene& scene, int base, double x) {
    constexpr double size = 0.6, pitch = 0.61;
    for (int layer = 0; layer < base; ++layer) {
        const int count = base - layer;
        for (int i = 0; i < count * count; ++i) {
            const Position p = {x + (i % count - 0.5 * (count - 1)) * pitch, (layer + 0.5) * size,
                                (i / count - 0.5 * (count - 1)) * pitch};
            scene.bodies.push_back(
                make_box(fmt::format("stone[{},{}]", layer, i), p, {0.3f, 0.3f, 0.3f}, {}, 250));
        }
    }
}

}  // namespace

Scene make_showcase(std::span<const double> values) {
    const int base = static_cast<int>(values[0]);
    Scene scene;
    scene.name = "Chain of causes";
    scene.description = "Dominoes, a ball, a ramp and a pyramid.";
    scene.duration = 12;
    scene.dt = 1.0 / 120;
    scene.camera = {{3, 11, 19}, {-3, 2, -1}};
    scene.bodies.push_back(make_ground());
    scene.bodies.push_back(make_block("deck", {-12, deck / 2, -2.5}, {8, narrow(deck / 2), 5}));

    // From (-4, 4) to (4, 0): the slope's sine and cosine are 1 and 2 over the root of five.
    const double sine_of_slope = 0.4472135954999579, cosine_of_slope = 0.8944271909999159;
    SceneBody ramp = make_block("ramp", {-0.2 * sine_of_slope, 2 - 0.2 * cosine_of_slope, 0},
                                {4.4721360f, 0.2f, 1.5f});
    ramp.def.rotation = turn_about_z(-arc_tangent2(1, 2));
    scene.bodies.push_back(ramp);
    add_dominoes(scene);
    add_square_pyramid(scene, base, 8);
    // Four towers at the corners wait for what flies off.
    for (int tower = 0; tower < 4; ++tower) {
        for (int i = 0; i < 10; ++i) {
            const Position p = {8 + (tower % 2 == 0 ? -3.2 : 3.2), 0.25 + 0.5 * i,
                                tower / 2 == 0 ? -3.6 : 3.6};
            scene.bodies.push_back(
                make_box(fmt::format("tower[{},{}]", tower, i), p, {0.25f, 0.25f, 0.25f}, {}, 250));
        }
    }
    return scene;
}

}  // namespace cairn::scene

// The scene that `./run` shows: a chain of causes. Small dominoes round a bend push ever larger
// ones, the last sets a ball rolling, the ball runs down a ramp through four pyramids, each one
// stone deep.
//
// The way goes along +x. The dominoes stand on a deck four metres up; the ramp leads from its edge
// at x = -4 down to the ground at x = 4; the pyramids stand beyond.

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
    constexpr double small = 0.7, gap = 0.3, bend_radius = 1.9, growth = 1.09;
    constexpr int straight_count = 5, bend_count = 19, growing_count = 11;
    constexpr double ball_radius = 0.7, ball_x = -4.06;

    // From the ball backwards: how long the growing row is, and so where the bend ends.
    double row = ball_radius + 0.02, height = small;
    for (int i = 0; i < growing_count; ++i) {
        row += 0.44 * height;
        height *= growth;
    }
    row += 0.3 * height;
    const double end = ball_x - row;

    // Out along -x, round half a circle, and back along +x.
    int number = 0;
    for (int i = 0; i < straight_count; ++i) {
        const double x = end + (straight_count - i) * gap;
        SceneBody domino = make_domino(number++, x, -2 * bend_radius, small, 0);
        if (i == 0) {
            // The push: 5 rad/s about the lower edge that lies ahead.
            domino.def.angular_velocity = {0, 0, 5};
            domino.def.linear_velocity = {narrow(-5 * small / 2), narrow(5 * small / 16), 0};
        }
        scene.bodies.push_back(domino);
    }
    for (int i = 0; i < bend_count; ++i) {
        const double turn = pi * i / (bend_count - 1);
        scene.bodies.push_back(make_domino(number++, end - bend_radius * sine(turn),
                                           -bend_radius - bend_radius * cosine(turn), small, turn));
    }
    // Each is larger than the one before, up to the ball.
    double x = end;
    height = small;
    for (int i = 0; i < growing_count; ++i) {
        x += 0.44 * height;
        height *= growth;
        scene.bodies.push_back(make_domino(number++, x, 0, height, 0));
    }
    scene.bodies.push_back(
        make_ball("ball", {ball_x, deck + ball_radius, 0}, ball_radius, {.friction = 0.8f}, 1500));
}

// A pyramid one stone deep that stands across the way.
void add_wall(Scene& scene, int wall, int base, double x) {
    constexpr double size = 0.6, pitch = 0.61;
    for (int row = 0; row < base; ++row) {
        const int count = base - row;
        for (int i = 0; i < count; ++i) {
            const Position p = {x, (row + 0.5) * size, (i - 0.5 * (count - 1)) * pitch};
            scene.bodies.push_back(make_box(fmt::format("stone[{},{},{}]", wall, row, i), p,
                                            {0.3f, 0.3f, 0.3f}, {.friction = 0.5f}, 75));
        }
    }
}

}  // namespace

Scene make_showcase(std::span<const double> values) {
    const int base = static_cast<int>(values[0]);
    Scene scene;
    scene.name = "Chain of causes";
    scene.description = "Dominoes, a ball, a ramp and a row of pyramids.";
    scene.duration = 11;
    scene.dt = 1.0 / 120;
    scene.camera = {{20, 10.5f, 18}, {0.5f, 0.5f, -1.5f}};
    scene.bodies.push_back(make_ground());
    scene.bodies.push_back(make_block("deck", {-12, deck / 2, -2.5}, {8, narrow(deck / 2), 5}));

    // From (-4, 4) to (4, 0): the slope's sine and cosine are 1 and 2 over the root of five.
    const double sine_of_slope = 0.4472135954999579, cosine_of_slope = 0.8944271909999159;
    SceneBody ramp = make_block("ramp", {-0.2 * sine_of_slope, 2 - 0.2 * cosine_of_slope, 0},
                                {4.4721360f, 0.2f, 1.5f});
    ramp.def.rotation = turn_about_z(-arc_tangent2(1, 2));
    scene.bodies.push_back(ramp);
    add_dominoes(scene);
    for (int wall = 0; wall < 4; ++wall) add_wall(scene, wall, base, 6.5 + 1.8 * wall);
    // Four towers beside them wait for what flies off.
    for (int tower = 0; tower < 4; ++tower) {
        for (int i = 0; i < 10; ++i) {
            const Position p = {tower % 2 == 0 ? 8.4 : 12.0, 0.25 + 0.5 * i,
                                tower / 2 == 0 ? -4.0 : 4.0};
            scene.bodies.push_back(
                make_box(fmt::format("tower[{},{}]", tower, i), p, {0.25f, 0.25f, 0.25f}, {}, 250));
        }
    }
    return scene;
}

}  // namespace cairn::scene

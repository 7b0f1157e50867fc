// Built-in scenes of many contacts: pyramid, tower, dominoes, card house, mass ratio, pit,
// logs.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/builtin_parts.h"
#include "scene/pcg32.h"

namespace cairn::scene {

Scene make_pyramid(std::span<const double> values) {
    const int base = static_cast<int>(values[0]);
    Scene scene;
    scene.name = "Pyramid";
    scene.description =
        fmt::format("{} unit boxes, {} in the lowest row.", base * (base + 1) / 2, base);
    scene.duration = 10;
    const float far = narrow(4 + 1.1 * base);
    scene.camera = {{0.45f * far, 0.45f * far, far}, {0, narrow(0.4 * base), 0}};
    scene.bodies.push_back(make_ground());
    add_pyramid(scene, base, {0, 0, 0}, 1, 1.01, {}, 1000);
    return scene;
}

Scene make_tower(std::span<const double> values) {
    const int height = static_cast<int>(values[0]);
    Scene scene;
    scene.name = "Tower";
    scene.description =
        fmt::format("{} unit boxes; the top one is {} times as dense.", height, values[1]);
    scene.duration = 10;
    const float far = narrow(4 + 1.2 * height);
    scene.camera = {{0.7f * far, 0.5f * far, 0.7f * far}, {0, narrow(0.45 * height), 0}};
    scene.bodies.push_back(make_ground());
    for (int i = 0; i < height; ++i) {
        const float density = i == height - 1 ? narrow(1000 * values[1]) : 1000.0f;
        scene.bodies.push_back(
            make_box(fmt::format("box[{}]", i), {0, i + 0.5, 0}, {0.5f, 0.5f, 0.5f}, {}, density));
    }
    return scene;
}

Scene make_dominoes(std::span<const double> values) {
    const int count = static_cast<int>(values[0]);
    const double spacing = values[1];
    Scene scene;
    scene.name = "Dominoes";
    scene.description =
        "A row of dominoes of 20 x 160 x 80 mm; the first turns about its far edge.";
    scene.duration = 2 + std::ceil(count * spacing);
    scene.dt = 1.0 / 240;
    const double length = (count - 1) * spacing;
    scene.camera = {{narrow(0.2 * length), narrow(0.3 + 0.25 * length), narrow(0.5 + 0.6 * length)},
                    {narrow(0.5 * length), 0.05f, 0}};
    const Material ivory = {.friction = 0.3f};
    scene.bodies.push_back(make_ground(ivory));
    for (int i = 0; i < count; ++i) {
        SceneBody domino = make_box(fmt::format("domino[{}]", i), {i * spacing, 0.08, 0},
                                    {0.01f, 0.08f, 0.04f}, ivory);
        if (i == 0) {
            // 4 rad/s about the edge at (0.01, 0): the centre, at (-0.01, 0.08) from it, moves
            // along.
            domino.def.angular_velocity = {0, 0, -4};
            domino.def.linear_velocity = {0.32f, 0.04f, 0};
        }
        scene.bodies.push_back(domino);
    }
    return scene;
}

Scene make_card_house(std::span<const double> values) {
    const int storeys = static_cast<int>(values[0]);
    Scene scene;
    scene.name = "Card house";
    scene.description = "Cards of 400 x 200 x 2 mm that lean together 25 degrees off upright.";
    scene.duration = 10;
    scene.dt = 1.0 / 240;
    scene.camera = {
        {narrow(0.175 * storeys + 0.8), narrow(0.3 * storeys), narrow(0.8 + 0.5 * storeys)},
        {narrow(0.175 * storeys - 0.1), narrow(0.17 * storeys), 0}};
    const Material paper = {.friction = 0.7f};
    scene.bodies.push_back(make_ground(paper));
    const auto add_card = [&](int storey, const std::string& name, double x, double y,
                              double degrees) {
        SceneBody card = make_box(fmt::format("card[{},{}]", storey, name), {x, y, 0},
                                  {0.001f, 0.2f, 0.1f}, paper);
        card.def.rotation = turn_about_z(to_radians(degrees));
        scene.bodies.push_back(card);
    };
    for (int storey = 0; storey < storeys; ++storey) {
        const double y = 0.18 + 0.37 * storey;
        for (int i = 0; i < storeys - storey; ++i) {
            const double x = 0.175 * storey + 0.35 * i;
            add_card(storey, fmt::format("{}a", i), x, y, -25);
            add_card(storey, fmt::format("{}b", i), x + 0.175, y, 25);
            if (i + 1 < storeys - storey)
                add_card(storey, fmt::format("{}c", i), x + 0.25, y + 0.185, 90);
        }
    }
    return scene;
}

Scene make_mass_ratio(std::span<const double> values) {
    const double ratio = values[0];
    Scene scene;
    scene.name = "Mass ratio";
    scene.description =
        fmt::format("On the left equal cubes; on the right one {} times as dense on top.", ratio);
    scene.duration = 10;
    scene.camera = {{3, 2.5f, 6}, {0, 1, 0}};
    scene.bodies.push_back(make_ground());
    const Vec3 half = {0.5f, 0.5f, 0.5f};
    scene.bodies.push_back(make_box("light below light", {-1, 0.5, 0}, half, {}, 100));
    scene.bodies.push_back(make_box("light", {-1, 1.5, 0}, half, {}, 100));
    scene.bodies.push_back(make_box("light below heavy", {1, 0.5, 0}, half, {}, 100));
    scene.bodies.push_back(make_box("heavy", {1, 1.5, 0}, half, {}, narrow(100 * ratio)));
    return scene;
}

Scene make_pit(std::span<const double> values) {
    const int count = static_cast<int>(values[0]);
    Pcg32 random(static_cast<std::uint64_t>(values[1]));
    Scene scene;
    scene.name = "Pit";
    scene.description = fmt::format("{} boxes and spheres by turns pour into a walled pit.", count);
    scene.duration = 10;
    // The pit grows with what it has to hold: about eight layers when the heap has settled.
    const int across = std::max(3, static_cast<int>(std::ceil(std::sqrt(count / 8.0))));
    const double pitch = 0.76, inner = 0.5 * across * pitch + 0.2,
                 wall_half_height = 0.5 * inner + 1.5;
    const float reach = narrow(inner + 0.5), high = narrow(wall_half_height);
    scene.camera = {{narrow(1.6 * inner + 3), narrow(2.4 * inner + 5), narrow(2.2 * inner + 4)},
                    {0, narrow(0.35 * inner), 0}};
    scene.bodies.push_back(make_ground());
    scene.bodies.push_back(
        make_block("wall[-x]", {-inner - 0.25, wall_half_height, 0}, {0.25f, high, reach}));
    scene.bodies.push_back(
        make_block("wall[+x]", {inner + 0.25, wall_half_height, 0}, {0.25f, high, reach}));
    scene.bodies.push_back(
        make_block("wall[-z]", {0, wall_half_height, -inner - 0.25}, {reach, high, 0.25f}));
    scene.bodies.push_back(
        make_block("wall[+z]", {0, wall_half_height, inner + 0.25}, {reach, high, 0.25f}));
    for (int i = 0; i < count; ++i) {
        const int layer = i / (across * across), cell = i % (across * across);
        const Position p = {(cell % across - 0.5 * (across - 1)) * pitch + random.symmetric(0.03),
                            0.6 + layer * pitch,
                            (cell / across - 0.5 * (across - 1)) * pitch + random.symmetric(0.03)};
        const std::string name = fmt::format("{}[{}]", i % 2 == 0 ? "box" : "ball", i);
        if (i % 2 == 1) {
            scene.bodies.push_back(make_ball(name, p, random.between(0.18, 0.3)));
            continue;
        }
        const float x = narrow(random.between(0.13, 0.22)), y = narrow(random.between(0.13, 0.22)),
                    z = narrow(random.between(0.13, 0.22));
        SceneBody box = make_box(name, p, {x, y, z});
        const double yaw = random.between(0, 2 * pi), roll = random.between(0, 2 * pi);
        box.def.rotation = turn_about_y(yaw) * turn_about_x(roll);
        scene.bodies.push_back(box);
    }
    return scene;
}

Scene make_logs(std::span<const double> values) {
    const int base = static_cast<int>(values[0]);
    const double radius = 0.25, post_radius = 0.1,
                 height = radius * (2 + (base - 1) * std::sqrt(3.0));
    Scene scene;
    scene.name = "Logs";
    scene.description = fmt::format("{} logs, {} in the lowest row, each on the two below it.",
                                    base * (base + 1) / 2, base);
    scene.duration = 10;
    const float far = narrow(3 + 0.6 * base);
    scene.camera = {{0.55f * far, 0.5f * far, far}, {0, narrow(0.4 * height), 0}};
    const Material bark = {.friction = narrow(values[2])};
    scene.bodies.push_back(make_ground(bark));
    if (values[1] > 0) {
        const double beside = radius * base + post_radius;
        for (const double x : {-beside, beside}) {
            for (const double z : {-0.8, 0.8}) {
                const Geometry post = Capsule{narrow(post_radius), narrow(height)};
                const std::string name =
                    fmt::format("post[{}x,{}z]", x < 0 ? '-' : '+', z < 0 ? '-' : '+');
                scene.bodies.push_back(
                    make_body(name, BodyKind::Static, {x, 0.4 * height, z}, post, bark));
            }
        }
    }
    for (int row = 0; row < base; ++row) {
        for (int i = 0; i < base - row; ++i) {
            const double x = 2 * radius * (i - 0.5 * (base - row - 1));
            const double y = radius * (1 + row * std::sqrt(3.0));
            SceneBody log = make_body(fmt::format("log[{},{}]", row, i), BodyKind::Dynamic,
                                      {x, y, 0}, Capsule{narrow(radius), 2.5f}, bark, 700);
            log.def.rotation = turn_about_x(pi / 2);
            scene.bodies.push_back(log);
        }
    }
    return scene;
}

}  // namespace cairn::scene

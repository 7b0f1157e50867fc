// Scenes of what should stand: pyramids, columns, towers. Each names the bodies whose places tell
// whether it did.

#include "scene_parts.h"
#include "scenes.h"

namespace cairn::bench {

namespace {

// The six scenes on a small ground share their constants.
BenchScene make_small_scene() {
    BenchScene scene;
    scene.gravity = 9.81;
    scene.friction = 0.5;
    add_ground(scene, 100);
    return scene;
}

// A square of `rows` by `rows` pyramids of 55 cubes.
BenchScene make_pyramids(int rows) {
    constexpr double spacing = 11;
    BenchScene scene;
    add_ground(scene, 0.5 * spacing * (rows + 1));
    for (int i = 0; i < rows * rows; ++i) {
        const double x = spacing * (i % rows - 0.5 * (rows - 1));
        const double z = spacing * (i / rows - 0.5 * (rows - 1));
        expect_standing(scene, add_pyramid(scene, 10, 0.5, 1, 100, {x, 0, z}));
    }
    return scene;
}

}  // namespace

BenchScene make_pyramid20() {
    BenchScene scene;
    scene.gravity = 9.81;
    add_ground(scene, 100);
    expect_standing(scene, add_pyramid(scene, 20, 0.5, 1.01, 1000, {0, 0, 0}));
    return scene;
}

BenchScene make_pyramid40() {
    BenchScene scene = make_small_scene();
    expect_standing(scene, add_pyramid(scene, 40, 0.5, 1.05, 1000, {0, 0, 0}));
    return scene;
}

BenchScene make_large_pyramid() {
    BenchScene scene;
    add_ground(scene, 400);
    expect_standing(scene, add_pyramid(scene, 100, 0.5, 1, 100, {0, 0, 0}));
    return scene;
}

BenchScene make_many_pyramids() { return make_pyramids(14); }

BenchScene make_pyramids_30k() { return make_pyramids(24); }

BenchScene make_pyramids_100k() { return make_pyramids(43); }

BenchScene make_wide_pyramid() {
    constexpr int layers = 15;
    constexpr double half = 0.975;
    BenchScene scene;
    scene.may_sleep = true;
    add_ground(scene, 100);
    std::size_t top = 0;
    for (int layer = 0; layer < layers; ++layer) {
        const double shift = layer % 2 - layers;
        for (int i = layer / 2; i < layers - (layer + 1) / 2; ++i) {
            for (int j = layer / 2; j < layers - (layer + 1) / 2; ++j) {
                // The layers fall half a metre each, onto one another.
                top = add_box(scene, {2 * i + shift, 1 + 2.5 * layer, 2 * j + shift}, cube(half),
                              1000);
            }
        }
    }
    scene.standing.push_back({top, scene.bodies[top].position});
    scene.standing.back().place[1] = (2 * layers - 1) * half;
    return scene;
}

BenchScene make_grid1000() {
    BenchScene scene = make_small_scene();
    for (int column = 0; column < 100; ++column) {
        const double x = 1.1 * (column % 10 - 4.5);
        const double z = 1.1 * (column / 10 - 4.5);
        for (int level = 0; level < 10; ++level) {
            add_box(scene, {x, 1.5 + 1.25 * level, z}, cube(0.5), 1000);
        }
        scene.standing.push_back({scene.bodies.size() - 1, {x, 9.5, z}});
    }
    return scene;
}

BenchScene make_tower() {
    BenchScene scene = make_small_scene();
    for (int level = 0; level < 50; ++level) add_box(scene, {0, level + 0.5, 0}, cube(0.5), 1000);
    expect_standing(scene, scene.bodies.size() - 1);
    scene.is_tower = true;
    return scene;
}

BenchScene make_tower_heavy() {
    BenchScene scene = make_small_scene();
    for (int level = 0; level < 20; ++level) {
        add_box(scene, {0, level + 0.5, 0}, cube(0.5), level == 19 ? 400'000 : 1000);
    }
    expect_standing(scene, scene.bodies.size() - 1);
    scene.is_tower = true;
    return scene;
}

BenchScene make_seesaw() {
    BenchScene scene = make_small_scene();
    double density = 100;
    for (int level = 0; level < 4; ++level, density *= 10) {
        add_box(scene, {0, level + 0.5, 0}, cube(0.5), density);
    }
    expect_standing(scene, scene.bodies.size() - 1);
    scene.is_tower = true;
    return scene;
}

}  // namespace cairn::bench

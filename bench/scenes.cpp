// The table of scenes, and the parts that their makers share.

#include "scenes.h"

#include "scene_parts.h"

namespace cairn::bench {

namespace {

constexpr SceneEntry entries[] = {
    {"pyramid20", "210 unit cubes, base 20, pitch 1.01", 300, make_pyramid20},
    {"pyramid40", "820 unit cubes, base 40, pitch 1.05", 600, make_pyramid40},
    {"large-pyramid", "5050 cubes, base 100, side by side", 200, make_large_pyramid},
    {"many-pyramids", "14 x 14 pyramids of 55 cubes", 100, make_many_pyramids},
    {"pyramids-30k", "24 x 24 pyramids of 55 cubes, for the cost a body", 60, make_pyramids_30k},
    {"pyramids-100k", "43 x 43 pyramids of 55 cubes, for the cost a body", 60, make_pyramids_100k},
    {"wide-pyramid", "1240 cubes in 15 square layers", 300, make_wide_pyramid},
    {"grid1000", "100 columns of 10 cubes", 600, make_grid1000},
    {"tower", "50 unit cubes, for a minute", 3600, make_tower},
    {"tower-heavy", "20 unit cubes, the top 400 times as dense, for a minute", 3600,
     make_tower_heavy},
    {"seesaw", "four cubes of mass 1, 10, 100, 1000, heaviest on top", 600, make_seesaw},
    {"spheres5000", "5000 spheres into a pit", 600, make_spheres5000},
    {"spheres10000", "10000 spheres into a pit", 600, make_spheres10000},
    {"mixed4096", "4096 boxes, spheres and capsules into a pit", 600, make_mixed4096},
    {"capsules1000", "1000 capsules into a pit", 600, make_capsules1000},
    {"washer", "8000 cubes in a turning drum", 1000, make_washer},
    {"large-world", "a million static boxes, a sphere every 5 steps", 500, make_large_world},
    {"field", "2000 pyramids of six asleep, one kept awake by a turntable", 600, make_field},
    {"field-one", "the one pyramid on its turntable alone", 600, make_field_one},
    {"static-boxes", "100,000 static boxes apart, for bytes a body", 2, make_static_boxes, true},
    {"moving-boxes", "10,000 falling boxes apart, for bytes a body", 2, make_moving_boxes, true},
};

std::uint32_t add_part(BenchScene& scene, const Part& part) {
    // Most scenes have one part for all; in the others neighbours rarely share one.
    const std::size_t count = scene.parts.size();
    for (std::size_t i = count; i > 0 && count - i < 4; --i) {
        if (scene.parts[i - 1] == part) return static_cast<std::uint32_t>(i - 1);
    }
    scene.parts.push_back(part);
    return static_cast<std::uint32_t>(count);
}

std::size_t add_body(BenchScene& scene, const Part& part, const SceneBody& body) {
    scene.bodies.push_back(body);
    scene.bodies.back().first_part = add_part(scene, part);
    return scene.bodies.size() - 1;
}

}  // namespace

std::span<const SceneEntry> scene_entries() { return entries; }

const SceneEntry* find_scene(std::string_view name) {
    for (const SceneEntry& entry : entries) {
        if (entry.name == name) return &entry;
    }
    return nullptr;
}

Vector cube(double half) { return {half, half, half}; }

std::size_t add_box(BenchScene& scene, const Vector& position, const Vector& half_extents,
                    double density, const Rotation& rotation) {
    return add_body(scene, {.form = Form::Box, .half_extents = half_extents},
                    {.mobility = Mobility::Dynamic,
                     .density = static_cast<float>(density),
                     .position = position,
                     .rotation = rotation});
}

std::size_t add_sphere(BenchScene& scene, const Vector& position, double radius, double density) {
    return add_body(scene, {.form = Form::Sphere, .radius = radius},
                    {.mobility = Mobility::Dynamic,
                     .density = static_cast<float>(density),
                     .position = position});
}

std::size_t add_capsule(BenchScene& scene, const Vector& position, double half_height,
                        double radius, double density, const Rotation& rotation) {
    return add_body(scene, {.form = Form::Capsule, .radius = radius, .half_height = half_height},
                    {.mobility = Mobility::Dynamic,
                     .density = static_cast<float>(density),
                     .position = position,
                     .rotation = rotation});
}

std::size_t add_static_box(BenchScene& scene, const Vector& position, const Vector& half_extents) {
    return add_body(scene, {.form = Form::Box, .half_extents = half_extents},
                    {.mobility = Mobility::Static, .position = position});
}

void add_ground(BenchScene& scene, double half_width) {
    add_static_box(scene, {0, -1, 0}, {half_width, 1, half_width});
}

void add_pit(BenchScene& scene, double half_width, double height) {
    const double middle = half_width + 0.5;
    for (const double side : {-1.0, 1.0}) {
        add_static_box(scene, {side * middle, 0.5 * height, 0},
                       {0.5, 0.5 * height, half_width + 1});
        add_static_box(scene, {0, 0.5 * height, side * middle}, {half_width, 0.5 * height, 0.5});
    }
}

std::size_t add_pyramid(BenchScene& scene, int base, double half, double pitch, double density,
                        const Vector& center) {
    std::size_t top = 0;
    for (int row = 0; row < base; ++row) {
        const int count = base - row;
        for (int i = 0; i < count; ++i) {
            const double x = center[0] + pitch * (i - 0.5 * (count - 1));
            const double y = center[1] + (2 * row + 1) * half;
            top = add_box(scene, {x, y, center[2]}, cube(half), density);
        }
    }
    return top;
}

void expect_standing(BenchScene& scene, std::size_t body) {
    scene.standing.push_back({body, scene.bodies[body].position});
}

}  // namespace cairn::bench

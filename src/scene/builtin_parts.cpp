// Parts that the built-in scenes are put together from.

#include "scene/builtin_parts.h"

#include <fmt/format.h>

namespace cairn::scene {

SceneBody make_body(std::string name, BodyKind kind, Position position, Geometry geometry,
                    Material material, float density) {
    SceneBody body;
    body.name = std::move(name);
    body.def.kind = kind;
    body.def.position = position;
    ShapeDef shape;
    shape.geometry = geometry;
    shape.material = material;
    shape.density = density;
    body.def.shapes.push_back(shape);
    return body;
}

SceneBody make_box(std::string name, Position position, Vec3 half_extents, Material material,
                   float density) {
    return make_body(std::move(name), BodyKind::Dynamic, position, Box{half_extents}, material,
                     density);
}

SceneBody make_ball(std::string name, Position position, double radius, Material material,
                    float density) {
    return make_body(std::move(name), BodyKind::Dynamic, position, Sphere{narrow(radius)}, material,
                     density);
}

SceneBody make_block(std::string name, Position position, Vec3 half_extents, Material material) {
    return make_body(std::move(name), BodyKind::Static, position, Box{half_extents}, material);
}

SceneBody make_ground(Material material) {
    return make_body("ground", BodyKind::Static, {}, Plane{{0, 1, 0}, 0}, material);
}

void add_pyramid(Scene& scene, int base, Position foot, double size, double pitch,
                 Material material, float density) {
    const float half = narrow(size / 2);
    for (int row = 0; row < base; ++row) {
        const int count = base - row;
        for (int i = 0; i < count; ++i) {
            const double x = foot.x + (i - 0.5 * (count - 1)) * pitch;
            const double y = foot.y + (row + 0.5) * size;
            scene.bodies.push_back(make_box(fmt::format("box[{},{}]", row, i), {x, y, foot.z},
                                            {half, half, half}, material, density));
        }
    }
}

Quat turn_about_x(double radians) { return rotation_about({1, 0, 0}, radians); }
Quat turn_about_y(double radians) { return rotation_about({0, 1, 0}, radians); }
Quat turn_about_z(double radians) { return rotation_about({0, 0, 1}, radians); }

}  // namespace cairn::scene

#pragma once
// Parts that the built-in scenes are put together from, and the functions that make them.

#include <string>

#include "cairn/math.h"
#include "scene/builtin.h"

namespace cairn::scene {

inline constexpr double pi = 3.14159265358979323846;

inline float narrow(double number) { return static_cast<float>(number); }
inline double to_radians(double degrees) { return degrees * (pi / 180); }

SceneBody make_body(std::string name, BodyKind kind, Position position, Geometry geometry,
                    Material material = {}, float density = 1000);
SceneBody make_box(std::string name, Position position, Vec3 half_extents, Material material = {},
                   float density = 1000);
SceneBody make_ball(std::string name, Position position, double radius, Material material = {},
                    float density = 1000);
SceneBody make_block(std::string name, Position position, Vec3 half_extents,
                     Material material = {});
/// The floor: solid below y = 0.
SceneBody make_ground(Material material = {});
/// A pyramid of boxes, one deep: `base` boxes in the lowest row, standing along x.
void add_pyramid(Scene& scene, int base, Position foot, double size, double pitch,
                 Material material, float density);
Quat turn_about_x(double radians);
Quat turn_about_y(double radians);
Quat turn_about_z(double radians);

Scene make_drop(std::span<const double> values);
Scene make_bounce(std::span<const double> values);
Scene make_incline(std::span<const double> values);
Scene make_roll(std::span<const double> values);
Scene make_conveyor(std::span<const double> values);
Scene make_pyramid(std::span<const double> values);
Scene make_tower(std::span<const double> values);
Scene make_dominoes(std::span<const double> values);
Scene make_card_house(std::span<const double> values);
Scene make_mass_ratio(std::span<const double> values);
Scene make_pit(std::span<const double> values);
Scene make_logs(std::span<const double> values);
Scene make_billiards(std::span<const double> values);
Scene make_cradle(std::span<const double> values);
Scene make_t_handle(std::span<const double> values);
Scene make_showcase(std::span<const double> values);

}  // namespace cairn::scene

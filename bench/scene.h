#pragma once
// A benchmark's scene as plain data, described once and built by every engine's adapter: bodies
// made of boxes, spheres and capsules, what is asked of the whole, which bodies ought to stand, and
// when a body comes in later. SI units, y up, rotations [x, y, z, w].
//
// Parts are kept in a pool, and equal ones share an entry, so that an adapter can share its shapes
// as a user of that engine would.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cairn::bench {

using Vector = std::array<double, 3>;
using Rotation = std::array<double, 4>;

enum class Form : std::uint8_t { Box, Sphere, Capsule };

/// A convex piece of a body, in the body's frame.
struct Part {
    Form form = Form::Box;
    Vector half_extents = {};  // m, of a box
    double radius = 0;         // m, of a sphere or capsule
    double half_height = 0;    // m, of a capsule's cylindrical part, along its y
    Vector position = {};
    Rotation rotation = {0, 0, 0, 1};
    friend bool operator==(const Part&, const Part&) = default;
};

enum class Mobility : std::uint8_t { Static, Kinematic, Dynamic };

/// A body. A dynamic one has a single part about its origin, so that its origin is its center of
/// mass in every engine.
struct SceneBody {
    Mobility mobility = Mobility::Static;
    std::uint32_t first_part = 0;
    std::uint32_t part_count = 1;
    float density = 1000;  // kg/m^3, of a dynamic body
    Vector position = {};
    Rotation rotation = {0, 0, 0, 1};
    std::array<float, 3> angular_velocity = {};  // rad/s, constant, of a kinematic body
};

/// A body that ought to be at `place` once all is at rest.
struct Standing {
    std::size_t body = 0;
    Vector place = {};
};

struct BenchScene {
    std::string name;
    std::vector<Part> parts;
    std::vector<SceneBody> bodies;
    std::vector<Standing> standing;
    bool is_tower = false;           // how far its standing body sinks is watched at every step
    double gravity = 10;             // m/s^2, downward
    double friction = 0.6;           // of every pair; restitution is 0
    double dt = 1.0 / 60;            // s
    int settle_steps = 0;            // taken before the clock counts
    bool may_sleep = false;          // whether what rests may fall asleep
    double lost_below = 0;           // m: a dynamic body lower than this is lost
    std::size_t initial_bodies = 0;  // the rest of `bodies` come later
    int spawn_every = 0;             // steps between two of the rest
};

}  // namespace cairn::bench

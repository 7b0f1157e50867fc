#pragma once
// How the cases build their scenes and read them: z up, SI, full sizes, binary64 in the readings.
//
// A world that refuses something, or freezes a body, ends the case with an exception that says
// what; the table shows it as a row that is not met.

#include "case.h"

namespace cairn::physics {

inline constexpr double gravity = 9.81;
inline constexpr double pi = 3.14159265358979323846;
inline constexpr double radians(double degrees) { return degrees * pi / 180; }
inline constexpr double degrees(double radians) { return radians * 180 / pi; }

struct Vec {
    double x = 0, y = 0, z = 0;
};
inline Vec from(const Vec3& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
inline Vec from(const Position& p) { return {p.x, p.y, p.z}; }
inline Vec3 to_vec3(const Vec& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline Position to_position(const Vec& v) { return {v.x, v.y, v.z}; }
inline Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(double s, const Vec& v) { return {s * v.x, s * v.y, s * v.z}; }
inline double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(const Vec& a, const Vec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec& v) { return std::sqrt(dot(v, v)); }

// A unit quaternion in binary64, for closed forms.
struct Turn {
    double x = 0, y = 0, z = 0, w = 1;
};
Turn turn_about(const Vec& axis, double angle);
Turn from(const Quat& q);
Quat to_quat(const Turn& q);
Turn operator*(const Turn& a, const Turn& b);
Turn inverse(const Turn& q);
Vec rotate(const Turn& q, const Vec& v);
// The angle of the rotation between two, radians, 0 to pi.
double angle_between(const Turn& a, const Turn& b);

// PCG32: the same numbers wherever the table runs.
class Random {
public:
    explicit Random(std::uint64_t seed)
        : state_(seed * 6364136223846793005u + 1442695040888963407u) {}
    double uniform(double low, double high);
    Vec in_cube(double half);
    Turn turn();

private:
    std::uint32_t next();
    std::uint64_t state_;
};

struct WorldOptions {
    double gravity = physics::gravity;
    double restitution_threshold = 1;
    int substeps = 0;  // 0: the solver's own default
};
World make_world(const Setup& setup, const WorldOptions& options = {});

Material rough(double friction, double restitution = 0);
ShapeDef ball(double radius, const Material& material, double density = 1000);
// Along y; `height` is that of the cylindrical part.
ShapeDef capsule(double radius, double height, const Material& material, double density = 1000);
ShapeDef block(const Vec& full_size, const Material& material, double density = 1000);

BodyId add(World& world, const BodyDef& def);
BodyId add_static(World& world, const ShapeDef& shape, const Vec& at, const Turn& turn = {});
BodyId add_plane(World& world, const Vec& normal, double offset, const Material& material);

// Ground through the origin, falling away toward +x by `tilt` radians.
enum class Ground { Plane, Box };
const char* name(Ground ground);
BodyId add_ground(World& world, Ground ground, const Material& material, double tilt = 0);
struct Slope {
    Vec downhill, across, normal;
    Turn turn;
};
Slope slope_of(double tilt);

void set_pose(World& world, BodyId body, const Vec& at, const Turn& turn);
// One step, or an exception that says what was refused or which body went wrong.
void advance(World& world, double dt);
void run(World& world, const Setup& setup, double seconds);

Vec center_of(const World& world, BodyId body);
Vec velocity_of(const World& world, BodyId body);
Vec spin_of(const World& world, BodyId body);
Turn turn_of(const World& world, BodyId body);
// The fastest that any point of a body within `reach` of its center moves.
double speed_of(const World& world, BodyId body, double reach = 0);
// Kinetic plus m g (z - h v_z / 2): what the step itself conserves in free flight.
double flight_energy(const World& world, const Setup& setup);
// The sum of the normal impulses between two bodies in the last step, N s.
double normal_impulse(const World& world, BodyId one, BodyId other);

}  // namespace cairn::physics

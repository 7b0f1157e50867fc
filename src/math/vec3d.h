#pragma once
// Vectors in binary64: for rays and distances, which are long where shapes are small, and for what
// is rounded once at the end.
//
// A ray from a kilometre away that meets a marble keeps seven digits of the kilometre in binary32,
// and none of the marble. Directions are turned by rotations made from unit quaternions that are
// normalised once more, so that nothing grows with the length of an arm.

#include "math/quat.h"

namespace cairn {

struct Vec3d {
    double x = 0, y = 0, z = 0;
};

// A rotation: its columns are the turned axes.
struct Mat3d {
    Vec3d x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
};

inline namespace kernel {

constexpr Vec3d widen(Vec3 v) { return {double(v.x), double(v.y), double(v.z)}; }
constexpr Vec3 narrow(Vec3d v) { return {float(v.x), float(v.y), float(v.z)}; }
constexpr Vec3d operator+(Vec3d a, Vec3d b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3d operator-(Vec3d a, Vec3d b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3d operator-(Vec3d v) { return {-v.x, -v.y, -v.z}; }
constexpr Vec3d operator*(double s, Vec3d v) { return {s * v.x, s * v.y, s * v.z}; }
constexpr double dot(Vec3d a, Vec3d b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3d cross(Vec3d a, Vec3d b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr double length_squared(Vec3d v) { return dot(v, v); }
inline double length(Vec3d v) { return square_root(dot(v, v)); }

constexpr Position operator+(Position p, Vec3d v) { return {p.x + v.x, p.y + v.y, p.z + v.z}; }
constexpr Vec3d difference(Position p, Position q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }

constexpr Vec3d operator*(const Mat3d& m, Vec3d v) { return v.x * m.x + v.y * m.y + v.z * m.z; }
constexpr Vec3d multiply_transposed(const Mat3d& m, Vec3d v) {
    return {dot(m.x, v), dot(m.y, v), dot(m.z, v)};
}

/// The rotation of q / |q|.
inline Mat3d to_exact_matrix(Quat q) {
    const double x = q.x, y = q.y, z = q.z, w = q.w;
    const double s = 2 / (x * x + y * y + z * z + w * w);
    const double xx = s * x * x, yy = s * y * y, zz = s * z * z;
    const double xy = s * x * y, xz = s * x * z, yz = s * y * z;
    const double wx = s * w * x, wy = s * w * y, wz = s * w * z;
    return {{1 - (yy + zz), xy + wz, xz - wy},
            {xy - wz, 1 - (xx + zz), yz + wx},
            {xz + wy, yz - wx, 1 - (xx + yy)}};
}

}  // namespace kernel
}  // namespace cairn

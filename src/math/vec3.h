#pragma once
// Vectors and world positions: the inlined arithmetic of the kernels. Not to be included together
// with the public cairn/math.h, which offers the same names compiled in the library.

#include "cairn/types.h"
#include "math/scalar.h"

namespace cairn {
inline namespace kernel {

constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(Vec3 v) { return {-v.x, -v.y, -v.z}; }
constexpr Vec3 operator*(float s, Vec3 v) { return {s * v.x, s * v.y, s * v.z}; }
constexpr Vec3 operator*(Vec3 v, float s) { return {v.x * s, v.y * s, v.z * s}; }
constexpr Vec3& operator+=(Vec3& a, Vec3 b) { return a = a + b; }
constexpr Vec3& operator-=(Vec3& a, Vec3 b) { return a = a - b; }

constexpr float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr Vec3 multiply(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
constexpr Vec3 absolute(Vec3 v) { return {absolute(v.x), absolute(v.y), absolute(v.z)}; }
constexpr Vec3 min(Vec3 a, Vec3 b) { return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)}; }
constexpr Vec3 max(Vec3 a, Vec3 b) { return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)}; }
constexpr float length_squared(Vec3 v) { return dot(v, v); }
inline float length(Vec3 v) { return square_root(dot(v, v)); }
inline bool is_finite(Vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

/// v / |v|; `fallback` where |v| is too small to divide by.
inline Vec3 normalize_or(Vec3 v, Vec3 fallback) {
    const float squared = dot(v, v);
    return squared > 1e-36f ? (1.0f / square_root(squared)) * v : fallback;
}

constexpr float component(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
constexpr void set_component(Vec3& v, int axis, float value) {
    (axis == 0 ? v.x : axis == 1 ? v.y : v.z) = value;
}
constexpr Vec3 unit_axis(int axis) {
    return {axis == 0 ? 1.0f : 0.0f, axis == 1 ? 1.0f : 0.0f, axis == 2 ? 1.0f : 0.0f};
}

/// Some unit vector across the unit vector n, a continuous function of n but for one seam.
inline Vec3 any_perpendicular(Vec3 n) {
    const Vec3 p = absolute(n.x) > 0.57735f ? Vec3{n.y, -n.x, 0} : Vec3{0, n.z, -n.y};
    return normalize_or(p, {1, 0, 0});
}

constexpr Position operator+(Position p, Vec3 v) {
    return {p.x + double(v.x), p.y + double(v.y), p.z + double(v.z)};
}
constexpr Position operator-(Position p, Vec3 v) {
    return {p.x - double(v.x), p.y - double(v.y), p.z - double(v.z)};
}
/// The vector from q to p, rounded once.
constexpr Vec3 operator-(Position p, Position q) {
    return {float(p.x - q.x), float(p.y - q.y), float(p.z - q.z)};
}
inline bool is_finite(Position p) { return is_finite(p.x) && is_finite(p.y) && is_finite(p.z); }

}  // namespace kernel
}  // namespace cairn

#pragma once
// 3x3 matrices: rotations (columns are the turned axes) and symmetric tensors.

#include "math/vec3.h"

namespace cairn {

struct Mat3 {
    Vec3 x = {1, 0, 0};  // columns
    Vec3 y = {0, 1, 0};
    Vec3 z = {0, 0, 1};
};

inline namespace kernel {

constexpr Vec3 operator*(const Mat3& m, Vec3 v) { return v.x * m.x + v.y * m.y + v.z * m.z; }
constexpr Vec3 multiply_transposed(const Mat3& m, Vec3 v) {
    return {dot(m.x, v), dot(m.y, v), dot(m.z, v)};
}
constexpr Mat3 operator*(const Mat3& a, const Mat3& b) { return {a * b.x, a * b.y, a * b.z}; }
constexpr Mat3 absolute(const Mat3& m) { return {absolute(m.x), absolute(m.y), absolute(m.z)}; }

constexpr Vec3 operator*(const SymmetricMat3& m, Vec3 v) {
    return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
            m.xz * v.x + m.yz * v.y + m.zz * v.z};
}
constexpr SymmetricMat3 operator+(const SymmetricMat3& a, const SymmetricMat3& b) {
    return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}

/// R m R^T: the tensor m seen from the frame that R turns it into.
constexpr SymmetricMat3 rotate(const Mat3& r, const SymmetricMat3& m) {
    const Mat3 rm = {r * Vec3{m.xx, m.xy, m.xz}, r * Vec3{m.xy, m.yy, m.yz},
                     r * Vec3{m.xz, m.yz, m.zz}};
    // Rows of the product: entry (i, j) = sum over k of rm(i, k) r(j, k).
    auto entry = [&](auto i, auto j) {
        return i(rm.x) * j(r.x) + i(rm.y) * j(r.y) + i(rm.z) * j(r.z);
    };
    constexpr auto px = [](Vec3 v) { return v.x; };
    constexpr auto py = [](Vec3 v) { return v.y; };
    constexpr auto pz = [](Vec3 v) { return v.z; };
    return {entry(px, px), entry(py, py), entry(pz, pz),
            entry(px, py), entry(px, pz), entry(py, pz)};
}

/// The solution x of m x = b by Cramer's rule; zero where m is singular.
constexpr Vec3 solve(const Mat3& m, Vec3 b) {
    const Vec3 yz = cross(m.y, m.z);
    const float determinant = dot(m.x, yz);
    if (determinant == 0) return {};
    const float scale = 1.0f / determinant;
    return scale * Vec3{dot(b, yz), dot(b, cross(m.z, m.x)), dot(b, cross(m.x, m.y))};
}

/// The inverse of a symmetric matrix, worked in binary64; zero where it is singular.
constexpr SymmetricMat3 inverse(const SymmetricMat3& m) {
    const double xx = m.xx, yy = m.yy, zz = m.zz, xy = m.xy, xz = m.xz, yz = m.yz;
    const double c_xx = yy * zz - yz * yz, c_xy = xz * yz - xy * zz, c_xz = xy * yz - xz * yy;
    const double determinant = xx * c_xx + xy * c_xy + xz * c_xz;
    if (!(determinant > 0)) return {};
    const double s = 1.0 / determinant;
    return {float(s * c_xx),
            float(s * (xx * zz - xz * xz)),
            float(s * (xx * yy - xy * xy)),
            float(s * c_xy),
            float(s * c_xz),
            float(s * (xy * xz - xx * yz))};
}

}  // namespace kernel
}  // namespace cairn

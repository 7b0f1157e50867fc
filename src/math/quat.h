#pragma once
// Unit quaternions and poses.

#include "math/mat3.h"

namespace cairn {
inline namespace kernel {

/// First b's rotation, then a's.
constexpr Quat operator*(Quat a, Quat b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
            a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
constexpr Quat conjugate(Quat q) { return {-q.x, -q.y, -q.z, q.w}; }
inline bool is_finite(Quat q) {
    return is_finite(q.x) && is_finite(q.y) && is_finite(q.z) && is_finite(q.w);
}
/// q / |q|; the identity where |q| is 0.
inline Quat normalize(Quat q) {
    const double n = double(q.x) * double(q.x) + double(q.y) * double(q.y) +
                     double(q.z) * double(q.z) + double(q.w) * double(q.w);
    if (!(n > 0)) return {};
    const double s = 1.0 / square_root(n);
    return {float(s * double(q.x)), float(s * double(q.y)), float(s * double(q.z)),
            float(s * double(q.w))};
}
constexpr Vec3 rotate(Quat q, Vec3 v) {
    const Vec3 u = {q.x, q.y, q.z};
    const Vec3 t = 2.0f * cross(u, v);
    return v + q.w * t + cross(u, t);
}
constexpr Vec3 rotate_inverse(Quat q, Vec3 v) { return rotate(conjugate(q), v); }

constexpr Mat3 to_matrix(Quat q) {
    const float x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z;
    const float xx = q.x * x2, yy = q.y * y2, zz = q.z * z2;
    const float xy = q.x * y2, xz = q.x * z2, yz = q.y * z2;
    const float wx = q.w * x2, wy = q.w * y2, wz = q.w * z2;
    return {{1 - (yy + zz), xy + wz, xz - wy},
            {xy - wz, 1 - (xx + zz), yz + wx},
            {xz + wy, yz - wx, 1 - (xx + yy)}};
}

/// exp(theta / 2): the turn by |theta| radians about theta. Exact to rounding at every angle.
inline Quat exponential_map(Vec3 theta) {
    const double x = theta.x, y = theta.y, z = theta.z;
    const double squared = x * x + y * y + z * z;
    double s, c;  // sin(|theta|/2) / |theta| and cos(|theta|/2)
    if (squared < 0.25) {
        // Series in (|theta|/2)^2 <= 1/16: the neglected terms are below 1e-15.
        const double u = squared * 0.25;
        s = 0.5 * (1 - u * (1.0 / 6 - u * (1.0 / 120 -
                                           u * (1.0 / 5040 - u * (1.0 / 362880 - u / 39916800)))));
        c = 1 - u * (0.5 - u * (1.0 / 24 - u * (1.0 / 720 - u * (1.0 / 40320 - u / 3628800))));
    } else {
        const double angle = square_root(squared);
        const SineCosine half = sine_cosine(0.5 * angle);
        s = half.sine / angle;
        c = half.cosine;
    }
    return {float(s * x), float(s * y), float(s * z), float(c)};
}

/// The shorter rotation vector whose exponential the unit quaternion is.
inline Vec3 logarithm(Quat q) {
    const double x = q.x, y = q.y, z = q.z;
    const double sine = square_root(x * x + y * y + z * z);
    if (sine == 0) return {};
    const double sign = q.w < 0 ? -1 : 1;
    const double scale = sign * 2 * exact_arc_tangent2(sine, sign * double(q.w)) / sine;
    return {float(scale * x), float(scale * y), float(scale * z)};
}

/// a's frame, then b within it.
constexpr Pose operator*(const Pose& a, const Pose& b) {
    return {a.position + rotate(a.rotation, b.position), a.rotation * b.rotation};
}
constexpr Pose inverse(const Pose& pose) {
    return {-rotate_inverse(pose.rotation, pose.position), conjugate(pose.rotation)};
}

}  // namespace kernel
}  // namespace cairn

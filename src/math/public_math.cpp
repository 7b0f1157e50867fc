// The out-of-line twins that cairn/math.h offers to users: each forwards to the kernels' own.

#include "math/quat.h"

namespace cairn {

namespace k = kernel;

// Declared here exactly as in cairn/math.h, which cannot be included beside the kernels.
Vec3 operator+(Vec3 a, Vec3 b);
Vec3 operator-(Vec3 a, Vec3 b);
Vec3 operator-(Vec3 v);
Vec3 operator*(float s, Vec3 v);
Vec3 operator*(Vec3 v, float s);
float dot(Vec3 a, Vec3 b);
Vec3 cross(Vec3 a, Vec3 b);
float length(Vec3 v);
Vec3 normalize(Vec3 v);
Position operator+(Position p, Vec3 v);
Position operator-(Position p, Vec3 v);
Vec3 operator-(Position p, Position q);
Quat operator*(Quat a, Quat b);
Quat conjugate(Quat q);
Quat normalize(Quat q);
Vec3 rotate(Quat q, Vec3 v);
Vec3 rotate_inverse(Quat q, Vec3 v);
double sine(double radians);
double cosine(double radians);
double arc_tangent2(double y, double x);
Quat rotation_about(Vec3 axis, double radians);

Vec3 operator+(Vec3 a, Vec3 b) { return k::operator+(a, b); }
Vec3 operator-(Vec3 a, Vec3 b) { return k::operator-(a, b); }
Vec3 operator-(Vec3 v) { return k::operator-(v); }
Vec3 operator*(float s, Vec3 v) { return k::operator*(s, v); }
Vec3 operator*(Vec3 v, float s) { return k::operator*(v, s); }
float dot(Vec3 a, Vec3 b) { return k::dot(a, b); }
Vec3 cross(Vec3 a, Vec3 b) { return k::cross(a, b); }
float length(Vec3 v) { return k::length(v); }
Vec3 normalize(Vec3 v) { return k::normalize_or(v, {}); }
Position operator+(Position p, Vec3 v) { return k::operator+(p, v); }
Position operator-(Position p, Vec3 v) { return k::operator-(p, v); }
Vec3 operator-(Position p, Position q) { return k::operator-(p, q); }
Quat operator*(Quat a, Quat b) { return k::operator*(a, b); }
Quat conjugate(Quat q) { return k::conjugate(q); }
Quat normalize(Quat q) { return k::normalize(q); }
Vec3 rotate(Quat q, Vec3 v) { return k::rotate(q, v); }
Vec3 rotate_inverse(Quat q, Vec3 v) { return k::rotate_inverse(q, v); }
double sine(double radians) { return k::sine_cosine(radians).sine; }
double cosine(double radians) { return k::sine_cosine(radians).cosine; }
double arc_tangent2(double y, double x) { return k::exact_arc_tangent2(y, x); }

Quat rotation_about(Vec3 axis, double radians) {
    const double x = axis.x, y = axis.y, z = axis.z;
    const double squared = x * x + y * y + z * z;
    if (!(squared > 0)) return {};
    const k::SineCosine half = k::sine_cosine(0.5 * radians);
    const double s = half.sine / k::square_root(squared);
    return {float(s * x), float(s * y), float(s * z), float(half.cosine)};
}

}  // namespace cairn

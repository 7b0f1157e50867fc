#pragma once
// Arithmetic on the public types, for the user's convenience.
//
// All of it is compiled inside the library, with the library's floating-point flags: a program
// built with -ffast-math or fused multiply-add gets the same bits from these functions as any
// other, on every machine. Cairn's own kernels use inlined twins of them.

#include "cairn/types.h"

namespace cairn {

Vec3 operator+(Vec3 a, Vec3 b);
Vec3 operator-(Vec3 a, Vec3 b);
Vec3 operator-(Vec3 v);
Vec3 operator*(float s, Vec3 v);
Vec3 operator*(Vec3 v, float s);
float dot(Vec3 a, Vec3 b);
Vec3 cross(Vec3 a, Vec3 b);
float length(Vec3 v);
/// v / |v|; the zero vector where |v| is 0.
Vec3 normalize(Vec3 v);

Position operator+(Position p, Vec3 v);
Position operator-(Position p, Vec3 v);
/// The vector from q to p, rounded once to binary32.
Vec3 operator-(Position p, Position q);

/// First b's rotation, then a's.
Quat operator*(Quat a, Quat b);
Quat conjugate(Quat q);
Quat normalize(Quat q);
Vec3 rotate(Quat q, Vec3 v);
Vec3 rotate_inverse(Quat q, Vec3 v);

/// Sine, cosine and arc tangent that give the same bits on every machine (error below 2 ulp).
double sine(double radians);
double cosine(double radians);
double arc_tangent2(double y, double x);

/// The rotation by `radians` about `axis` (any length but 0; the identity for 0).
Quat rotation_about(Vec3 axis, double radians);

}  // namespace cairn

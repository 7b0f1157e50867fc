#pragma once
// The plain values that cross Cairn's public face: no arithmetic, so nothing here can be changed by
// the flags of the program that includes it. `cairn/math.h` adds the operations.
//
// SI units, right-handed axes. A quaternion rotates a vector from the frame of the thing it belongs
// to into the world (or the parent) frame.

#include <array>

namespace cairn {

/// Three binary32 components: a direction, a velocity, a force, a length in a local frame.
struct Vec3 {
    float x = 0;
    float y = 0;
    float z = 0;
    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

/// A point in the world, metres, binary64: a scene may lie far from the origin and lose nothing.
struct Position {
    double x = 0;
    double y = 0;
    double z = 0;
    friend constexpr bool operator==(const Position&, const Position&) = default;
};

/// A unit quaternion [x, y, z, w], the order of glTF.
struct Quat {
    float x = 0;
    float y = 0;
    float z = 0;
    float w = 1;
    friend constexpr bool operator==(const Quat&, const Quat&) = default;
};

/// A rigid placement within a parent frame: rotate, then translate.
struct Pose {
    Vec3 position = {};
    Quat rotation = {};
    friend constexpr bool operator==(const Pose&, const Pose&) = default;
};

/// A symmetric 3x3 matrix: an inertia tensor with its signed entries (xy is minus the integral of
/// x y dm), kg m^2.
struct SymmetricMat3 {
    float xx = 0;
    float yy = 0;
    float zz = 0;
    float xy = 0;
    float xz = 0;
    float yz = 0;
    friend constexpr bool operator==(const SymmetricMat3&, const SymmetricMat3&) = default;
};

}  // namespace cairn

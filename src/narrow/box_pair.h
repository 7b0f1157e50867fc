#pragma once
// Two boxes as SAT, GJK and EPA see them, and the measures they share.
//
// Everything along A's axes, in which A's own axes are the unit vectors. Symbols: h_a, h_b half
// extents, t from A's centre to B's, u_j = axes_b column j.

#include "cairn/shape.h"
#include "math/quat.h"
#include "narrow/axis.h"

namespace cairn {

struct BoxPair {
    Vec3 h_a;
    Vec3 h_b;
    Vec3 t;
    Mat3 axes_b;
};

inline BoxPair make_box_pair(const Box& a, const Box& b, const Pose& b_in_a) {
    return {a.half_extents, b.half_extents, b_in_a.position, to_matrix(b_in_a.rotation)};
}

// The same pair as B sees it: B's axes are the common ones, and A comes second.
constexpr BoxPair seen_from_b(const BoxPair& pair) {
    const auto& [x, y, z] = pair.axes_b;
    return {pair.h_b,
            pair.h_a,
            -multiply_transposed(pair.axes_b, pair.t),
            {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
}

// The box's axis k.
constexpr Vec3 column(const Mat3& axes, int k) {
    return k == 0 ? axes.x : k == 1 ? axes.y : axes.z;
}

// The axis whose faces look most along a direction, given along the box's axes. A trifle of favour
// for the first axes, so that ties do not hang on rounding.
constexpr int steepest_axis(Vec3 slope) {
    constexpr float clearly = 1.0f + 1e-3f;
    const Vec3 s = absolute(slope);
    const int axis = s.y > clearly * s.x ? 1 : 0;
    return s.z > clearly * (axis == 0 ? s.x : s.y) ? 2 : axis;
}

// What AxisHint::kind says for two boxes; index_a and index_b number the axes, 0 to 2.
enum class BoxAxisKind : std::uint8_t {
    Unknown,
    FaceA,     // normal of A's faces across axis index_a
    FaceB,     // normal of B's faces across axis index_b
    EdgePair,  // across A's edges along index_a and B's along index_b
};

inline bool is_same(const AxisHint& p, const AxisHint& q) {
    return p.kind == q.kind && p.index_a == q.index_a && p.index_b == q.index_b;
}

// The smallest half extent of either: what tolerances are measured by.
inline float smallest_half_extent(const BoxPair& pair) {
    const Vec3 smallest = min(pair.h_a, pair.h_b);
    return min(smallest.x, min(smallest.y, smallest.z));
}

// How far the two are apart along the unit vector n, which points from A to B.
inline float separation_along(const BoxPair& pair, Vec3 n) {
    const Vec3 m = multiply_transposed(pair.axes_b, n);
    return dot(n, pair.t) - dot(absolute(n), pair.h_a) - dot(absolute(m), pair.h_b);
}

}  // namespace cairn

#pragma once
// Two boxes as SAT, GJK and EPA see them, and the measures they share.
//
// Unless said otherwise everything is along A's axes, in which A's own are the unit vectors.
// Symbols: h_a, h_b half extents, t from A's centre to B's, u_j = axes_b[j] B's axis j.

#include "cairn/shape.h"
#include "math/quat.h"
#include "narrow/axis.h"
#include "narrow/three.h"

namespace cairn {

struct BoxPair {
    Three h_a;
    Three h_b;
    Three t;
    Three axes_b[3];  // B's axes along A's
    Three axes_a[3];  // A's axes along B's
};

inline BoxPair make_box_pair(const Box& a, const Box& b, const Pose& b_in_a) {
    const auto& [x, y, z] = to_matrix(b_in_a.rotation);
    return {three(a.half_extents),
            three(b.half_extents),
            three(b_in_a.position),
            {three(x), three(y), three(z)},
            {three({x.x, y.x, z.x}), three({x.y, y.y, z.y}), three({x.z, y.z, z.z})}};
}

// A vector given along B's axes, along A's, and the other way round.
inline Three along_a(const BoxPair& pair, Three v) {
    return v[0] * pair.axes_b[0] + v[1] * pair.axes_b[1] + v[2] * pair.axes_b[2];
}
inline Three along_b(const BoxPair& pair, Three v) {
    return v[0] * pair.axes_a[0] + v[1] * pair.axes_a[1] + v[2] * pair.axes_a[2];
}

// The same pair as B sees it: B comes first.
inline BoxPair seen_from_b(const BoxPair& pair) {
    const auto& u = pair.axes_b;
    const auto& e = pair.axes_a;
    return {pair.h_b, pair.h_a, -along_b(pair, pair.t), {e[0], e[1], e[2]}, {u[0], u[1], u[2]}};
}

// The axis whose faces look most along a direction, given along the box's axes. A trifle of favour
// for the first axes, so that ties do not hang on rounding.
inline int steepest_axis(Three slope) {
    constexpr float clearly = 1.0f + 1e-3f;
    const Three s = absolute(slope);
    const int axis = s[1] > clearly * s[0] ? 1 : 0;
    return s[2] > clearly * (axis == 0 ? s[0] : s[1]) ? 2 : axis;
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

}  // namespace cairn

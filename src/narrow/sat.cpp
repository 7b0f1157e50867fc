// The separating axis test for two boxes; see sat.h.
//
// Symbols: c_ij = component i of B's axis j, seen along A's axes. For A's face i the boxes reach
// h_a[i] and sum_j |c_ij| h_b[j]; for B's face j the other way round. The edge axis n = e_i x u_j
// has no component i, and its square is 1 - c_ij^2, taken as the sum of the two other squares: no
// cancellation.

#include "narrow/sat.h"

#include <limits>

#include "shape/placed_box.h"

namespace cairn {
namespace {

constexpr float lowest = std::numeric_limits<float>::lowest();

// Edges closer to parallel than this, in radians, span no axis of their own: their faces stand for
// it.
constexpr float parallel_edges = 1e-4f;
// Below this angle the scaled form of an edge axis would lose digits: it is normalised first.
constexpr float nearly_parallel_edges = 0.1f;

AxisHint feature(BoxAxisKind kind, int index_a, int index_b) {
    return {std::uint8_t(kind), std::uint8_t(index_a), std::uint8_t(index_b)};
}

Vec3 toward_b(Vec3 axis, float t_along) { return t_along < 0 ? -axis : axis; }

// Keeps the best of what it is shown; of equals, the first.
struct Best {
    float separation = lowest;
    AxisHint feature = {};
    void offer(float candidate, AxisHint candidate_feature) {
        if (candidate > separation) separation = candidate, feature = candidate_feature;
    }
};

Best best_face(const BoxPair& pair) {
    const Mat3 reach = absolute(pair.axes_b);
    const Vec3 a = absolute(pair.t) - (pair.h_a + reach * pair.h_b);
    const Vec3 t_in_b = absolute(multiply_transposed(pair.axes_b, pair.t));
    const Vec3 b = t_in_b - (pair.h_b + multiply_transposed(reach, pair.h_a));
    Best best;
    best.offer(a.x, feature(BoxAxisKind::FaceA, 0, 0));
    best.offer(a.y, feature(BoxAxisKind::FaceA, 1, 0));
    best.offer(a.z, feature(BoxAxisKind::FaceA, 2, 0));
    best.offer(b.x, feature(BoxAxisKind::FaceB, 0, 0));
    best.offer(b.y, feature(BoxAxisKind::FaceB, 0, 1));
    best.offer(b.z, feature(BoxAxisKind::FaceB, 0, 2));
    return best;
}

// The separation along e_i x u_j; `lowest` where the edges are parallel.
float edge_separation(const BoxPair& pair, const Mat3& reach, int i, int j) {
    const Vec3 u = column(pair.axes_b, j);
    const int i1 = i == 2 ? 0 : i + 1, i2 = i == 0 ? 2 : i - 1;
    const float u1 = component(u, i1), u2 = component(u, i2);
    const float squared = u1 * u1 + u2 * u2;
    if (squared < nearly_parallel_edges * nearly_parallel_edges) {
        return measure_axis(pair, feature(BoxAxisKind::EdgePair, i, j)).separation;
    }
    // e_i x u_j has components -u2 along i1 and u1 along i2; |u_k . (e_i x u_j)| is |c_i,other|.
    const float t_along = absolute(u1 * component(pair.t, i2) - u2 * component(pair.t, i1));
    const float reach_a =
        absolute(u2) * component(pair.h_a, i1) + absolute(u1) * component(pair.h_a, i2);
    const int j1 = j == 2 ? 0 : j + 1, j2 = j == 0 ? 2 : j - 1;
    const float c1 = component(column(reach, j1), i);
    const float c2 = component(column(reach, j2), i);
    const float reach_b = c2 * component(pair.h_b, j1) + c1 * component(pair.h_b, j2);
    return (t_along - (reach_a + reach_b)) / square_root(squared);
}

Best best_edge_pair(const BoxPair& pair) {
    const Mat3 reach = absolute(pair.axes_b);
    Best best;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            best.offer(edge_separation(pair, reach, i, j), feature(BoxAxisKind::EdgePair, i, j));
        }
    }
    return best;
}

// The last step's axis if it is within reach of the best; else the best.
SeparatingAxis keep_last(const BoxPair& pair, Best best, AxisHint last) {
    if (last.kind != 0) {
        const SeparatingAxis kept = measure_axis(pair, last);
        if (kept.separation >= best.separation - axis_preference(pair).new_over_last) return kept;
    }
    return measure_axis(pair, best.feature);
}

}  // namespace

AxisPreference axis_preference(const BoxPair& pair) {
    // Rounding grows with the larger box, what may be seen of it with the smaller.
    const Vec3 sizes = pair.h_a + pair.h_b + absolute(pair.t);
    const float rounding = 4 * float_epsilon * max(sizes.x, max(sizes.y, sizes.z));
    const float smallest = smallest_half_extent(pair);
    return {rounding + 2e-5f * smallest, rounding + 1e-3f * smallest};
}

SeparatingAxis measure_axis(const BoxPair& pair, AxisHint f) {
    const int i = f.index_a, j = f.index_b;
    Vec3 axis;
    switch (BoxAxisKind(f.kind)) {
        case BoxAxisKind::FaceA: axis = unit_axis(i); break;
        case BoxAxisKind::FaceB: axis = column(pair.axes_b, j); break;
        default: {
            axis = cross(unit_axis(i), column(pair.axes_b, j));
            const float length = square_root(length_squared(axis));
            if (length < parallel_edges) return {unit_axis(i), lowest, f};
            axis = (1.0f / length) * axis;
        }
    }
    const Vec3 n = toward_b(axis, dot(axis, pair.t));
    return {n, separation_along(pair, n), f};
}

SeparatingAxis find_separating_face(const BoxPair& pair, AxisHint last) {
    const bool last_was_face = BoxAxisKind(last.kind) == BoxAxisKind::FaceA ||
                               BoxAxisKind(last.kind) == BoxAxisKind::FaceB;
    return keep_last(pair, best_face(pair), last_was_face ? last : AxisHint{});
}

SeparatingAxis find_separating_axis(const BoxPair& pair, AxisHint last) {
    Best best = best_face(pair);
    const Best edges = best_edge_pair(pair);
    if (edges.separation > best.separation + axis_preference(pair).edge_over_face) best = edges;
    return keep_last(pair, best, last);
}

}  // namespace cairn

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

// The best of the nine edge pairs that are better than `threshold`, if any.
Best best_edge_pair(const BoxPair& pair, float threshold) {
    const Vec3 u[3] = {pair.axes_b.x, pair.axes_b.y, pair.axes_b.z};
    const float c[3][3] = {
        {u[0].x, u[1].x, u[2].x}, {u[0].y, u[1].y, u[2].y}, {u[0].z, u[1].z, u[2].z}};
    const float t[3] = {pair.t.x, pair.t.y, pair.t.z};
    const float h_a[3] = {pair.h_a.x, pair.h_a.y, pair.h_a.z};
    const float h_b[3] = {pair.h_b.x, pair.h_b.y, pair.h_b.z};
    constexpr int next[3] = {1, 2, 0}, last[3] = {2, 0, 1};
    Best best = {threshold, {}};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            // n = e_i x u_j before it is normalised: -c_2j along i1, c_1j along i2, nothing along
            // i. What it sees of B's axis u_k is |e_i . (u_j x u_k)|, the component i of the third.
            const int i1 = next[i], i2 = last[i], j1 = next[j], j2 = last[j];
            const float c1 = c[i1][j], c2 = c[i2][j];
            const float t_along = absolute(c1 * t[i2] - c2 * t[i1]);
            const float reach_a = absolute(c2) * h_a[i1] + absolute(c1) * h_a[i2];
            const float reach_b = absolute(c[i][j2]) * h_b[j1] + absolute(c[i][j1]) * h_b[j2];
            const float scaled = t_along - (reach_a + reach_b);
            const float squared = c1 * c1 + c2 * c2;
            const AxisHint edges = feature(BoxAxisKind::EdgePair, i, j);
            if (squared < nearly_parallel_edges * nearly_parallel_edges) {
                if (squared < parallel_edges * parallel_edges) continue;
                best.offer(measure_axis(pair, edges).separation, edges);
                continue;
            }
            // Normalised, a negative separation only falls: most need no square root.
            if (scaled <= min(best.separation, 0)) continue;
            best.offer(scaled / square_root(squared), edges);
        }
    }
    return best;
}

// The last step's axis if it is nearly as good as the best; else the best.
SeparatingAxis keep_last(const BoxPair& pair, const Best& best, AxisHint last, float yielding) {
    if (last.kind != 0 && !is_same(last, best.feature)) {
        const SeparatingAxis kept = measure_axis(pair, last);
        if (kept.separation >= best.separation - yielding) return kept;
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

SeparatingAxis find_separating_face(const BoxPair& pair) {
    return measure_axis(pair, best_face(pair).feature);
}

SeparatingAxis find_separating_axis(const BoxPair& pair, AxisHint last) {
    const AxisPreference preference = axis_preference(pair);
    Best best = best_face(pair);
    const Best edges = best_edge_pair(pair, best.separation + preference.edge_over_face);
    if (edges.feature.kind != 0) best = edges;
    return keep_last(pair, best, last, preference.new_over_last);
}

}  // namespace cairn

// The separating axis test for two boxes; see sat.h.
//
// Symbols: c_ij = component i of B's axis j, seen along A's axes. For A's face i the boxes reach
// h_a[i] and sum_j |c_ij| h_b[j]; for B's face j the other way round. The edge axis n = e_i x u_j
// has the components -c_2j along i1 and c_1j along i2, where i, i1, i2 are in turn; it sees of B's
// axis u_k the cofactor n . u_k = c_1j c_2k - c_2j c_1k.
//
// Three axes are measured at once, one a lane.

#include "narrow/sat.h"

#include <limits>

namespace cairn {
namespace {

constexpr float lowest = std::numeric_limits<float>::lowest();

// Edges closer to parallel than this, in radians, span no axis of their own: their faces stand for
// it.
constexpr float parallel_edges = 1e-4f;

AxisHint feature(BoxAxisKind kind, int index_a, int index_b) {
    return {std::uint8_t(kind), std::uint8_t(index_a), std::uint8_t(index_b)};
}

struct Best {
    float separation = lowest;
    AxisHint feature = {};
};

// Of equals, the first.
Best best_face(const BoxPair& pair) {
    const auto &e = pair.axes_a, &u = pair.axes_b;
    const Three h_a = pair.h_a, h_b = pair.h_b;
    const Three reach_b =
        absolute(u[0]) * h_b[0] + absolute(u[1]) * h_b[1] + absolute(u[2]) * h_b[2];
    const Three reach_a =
        absolute(e[0]) * h_a[0] + absolute(e[1]) * h_a[1] + absolute(e[2]) * h_a[2];
    const Three a = absolute(pair.t) - h_a - reach_b;
    const Three b = absolute(along_b(pair, pair.t)) - h_b - reach_a;
    Best best = {a[0], feature(BoxAxisKind::FaceA, 0, 0)};
    for (int i = 1; i < 3; ++i) {
        if (a[i] > best.separation) best = {a[i], feature(BoxAxisKind::FaceA, i, 0)};
    }
    for (int j = 0; j < 3; ++j) {
        if (b[j] > best.separation) best = {b[j], feature(BoxAxisKind::FaceB, 0, j)};
    }
    return best;
}

// The three axes across A's edges along i, one for each of B's, before they are normalised.
struct EdgeAxes {
    Three separation;
    Three squared_length;
};

EdgeAxes measure_edges(const BoxPair& pair, int i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    const Three c1 = pair.axes_a[i1], c2 = pair.axes_a[i2];
    // Lane k: what the axes across u_k's two neighbours see of each other.
    const Three cofactor = absolute(cross(c1, c2));
    const Three reach_a = absolute(c2) * pair.h_a[i1] + absolute(c1) * pair.h_a[i2];
    const Three reach_b = last(cofactor) * next(pair.h_b) + next(cofactor) * last(pair.h_b);
    return {absolute(c1 * pair.t[i2] - c2 * pair.t[i1]) - (reach_a + reach_b), c1 * c1 + c2 * c2};
}

// The best of the nine edge pairs that are better than `threshold`, if any.
Best best_edge_pair(const BoxPair& pair, float threshold) {
    Best best = {threshold, {}};
    for (int i = 0; i < 3; ++i) {
        const EdgeAxes edges = measure_edges(pair, i);
        // s / length > bar, squared with its sign: most need no square root.
        const Three s = edges.separation;
        const float bar = best.separation * absolute(best.separation);
        const Choice is_better = (s * absolute(s) > bar * edges.squared_length) &
                                 (edges.squared_length > parallel_edges * parallel_edges);
        if (!any(is_better)) continue;
        for (int j = 0; j < 3; ++j) {
            if (!is_better[j]) continue;
            const float separation = s[j] / square_root(edges.squared_length[j]);
            if (separation <= best.separation) continue;
            best = {separation, feature(BoxAxisKind::EdgePair, i, j)};
        }
    }
    return best;
}

}  // namespace

AxisPreference axis_preference(const BoxPair& pair) {
    // Rounding grows with the larger box, what may be seen of it with the smaller.
    const float rounding = 4 * float_epsilon * largest(pair.h_a + pair.h_b + absolute(pair.t));
    const float size = smallest(min(pair.h_a, pair.h_b));
    return {rounding + 2e-5f * size, rounding + 1e-3f * size};
}

SeparatingAxis measure_axis(const BoxPair& pair, AxisHint f) {
    const int i = f.index_a, j = f.index_b;
    Three axis;  // along A's axes
    switch (BoxAxisKind(f.kind)) {
        case BoxAxisKind::FaceA: axis = unit_three(i); break;
        case BoxAxisKind::FaceB: axis = pair.axes_b[j]; break;
        default: {
            const Three across = cross(unit_three(i), pair.axes_b[j]);
            const float length = square_root(dot(across, across));
            if (length < parallel_edges) return {unit_three(i), lowest, f};
            axis = (1.0f / length) * across;
        }
    }
    const float t_along = dot(axis, pair.t);
    const float reach_a = dot(absolute(axis), pair.h_a);
    const float reach_b = dot(absolute(along_b(pair, axis)), pair.h_b);
    return {t_along < 0 ? -axis : axis, absolute(t_along) - reach_a - reach_b, f};
}

SeparatingAxis find_separating_face(const BoxPair& pair) {
    return measure_axis(pair, best_face(pair).feature);
}

SeparatingAxis find_separating_axis(const BoxPair& pair, const SeparatingAxis& last,
                                    const AxisPreference& preference, const Reach& reach) {
    Best best = best_face(pair);
    if (best.separation > reach.distance) {
        const SeparatingAxis face = measure_axis(pair, best.feature);
        if (face.separation > reach.along(vec3(face.normal))) return face;
    }
    const Best edges = best_edge_pair(pair, best.separation + preference.edge_over_face);
    if (edges.feature.kind != 0) best = edges;
    // The last step's axis if it is nearly as good as the best.
    const bool is_kept =
        last.feature.kind != 0 && last.separation >= best.separation - preference.new_over_last;
    return is_kept ? last : measure_axis(pair, best.feature);
}

}  // namespace cairn

// The separating axis test for two boxes; see sat.h.
//
// Symbols: c_ij = component i of B's axis j, seen along A's axes; row i holds c_i0, c_i1, c_i2,
// column j B's axis j. For A's face i the boxes reach h_a[i] and sum_j |c_ij| h_b[j]; for B's face
// j the other way round. The edge axis n = e_i x u_j has the components -c_2j along i1 and c_1j
// along i2, where i, i1, i2 are in turn; it sees of B's axis u_k the cofactor
// n . u_k = c_1j c_2k - c_2j c_1k.
//
// Three axes are measured at once, one a lane; the fourth lane is 0. Each lane does what a single
// float would.

#include "narrow/sat.h"

#include <limits>

namespace cairn {
namespace {

constexpr float lowest = std::numeric_limits<float>::lowest();

// Edges closer to parallel than this, in radians, span no axis of their own: their faces stand for
// it.
constexpr float parallel_edges = 1e-4f;

typedef float Three __attribute__((vector_size(16)));
typedef std::int32_t Choice __attribute__((vector_size(16)));

Three in_lanes(Vec3 v) { return Three{v.x, v.y, v.z, 0}; }
using kernel::absolute;
Three absolute(Three v) { return Three(Choice(v) & 0x7fffffff); }
// The lanes of the next axis, and of the one after.
Three next(Three v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); }
Three last(Three v) { return __builtin_shufflevector(v, v, 2, 0, 1, 3); }

struct Rows {
    Three at[3];
};

Rows rows_of(const Mat3& axes) {
    return {{Three{axes.x.x, axes.y.x, axes.z.x, 0}, Three{axes.x.y, axes.y.y, axes.z.y, 0},
             Three{axes.x.z, axes.y.z, axes.z.z, 0}}};
}

AxisHint feature(BoxAxisKind kind, int index_a, int index_b) {
    return {std::uint8_t(kind), std::uint8_t(index_a), std::uint8_t(index_b)};
}

Vec3 toward_b(Vec3 axis, float t_along) { return t_along < 0 ? -axis : axis; }

struct Best {
    float separation = lowest;
    AxisHint feature = {};
};

// Of equals, the first.
Best best_face(const BoxPair& pair, const Rows& c) {
    const Vec3 t = pair.t, h_a = pair.h_a, h_b = pair.h_b;
    const Three reach_b = absolute(in_lanes(pair.axes_b.x)) * h_b.x +
                          absolute(in_lanes(pair.axes_b.y)) * h_b.y +
                          absolute(in_lanes(pair.axes_b.z)) * h_b.z;
    const Three reach_a =
        absolute(c.at[0]) * h_a.x + absolute(c.at[1]) * h_a.y + absolute(c.at[2]) * h_a.z;
    const Three t_in_b = absolute(c.at[0] * t.x + c.at[1] * t.y + c.at[2] * t.z);
    const Three a = absolute(in_lanes(t)) - in_lanes(h_a) - reach_b;
    const Three b = t_in_b - in_lanes(h_b) - reach_a;
    Best best = {a[0], feature(BoxAxisKind::FaceA, 0, 0)};
    for (int i = 1; i < 3; ++i) {
        if (a[i] > best.separation) best = {a[i], feature(BoxAxisKind::FaceA, i, 0)};
    }
    for (int j = 0; j < 3; ++j) {
        if (b[j] > best.separation) best = {b[j], feature(BoxAxisKind::FaceB, 0, j)};
    }
    return best;
}

// The three axes across A's edges along i, before they are normalised.
struct EdgeAxes {
    Three separation;
    Three squared_length;
};

EdgeAxes measure_edges(const Rows& c, int i, const float (&t)[3], const float (&h_a)[3],
                       Three h_b) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    const Three c1 = c.at[i1], c2 = c.at[i2];
    // Lane k: the cofactor that the axes of u_k's two neighbours see of each other.
    const Three cofactor = absolute(next(c1) * last(c2) - last(c1) * next(c2));
    const Three reach_a = absolute(c2) * h_a[i1] + absolute(c1) * h_a[i2];
    const Three reach_b = last(cofactor) * next(h_b) + next(cofactor) * last(h_b);
    return {absolute(c1 * t[i2] - c2 * t[i1]) - (reach_a + reach_b), c1 * c1 + c2 * c2};
}

bool any(Choice choice) {
    const Choice half = choice | __builtin_shufflevector(choice, choice, 2, 3, 0, 1);
    return (half[0] | half[1]) != 0;
}

// The best of the nine edge pairs that are better than `threshold`, if any.
Best best_edge_pair(const BoxPair& pair, const Rows& c, float threshold) {
    const float t[3] = {pair.t.x, pair.t.y, pair.t.z};
    const float h_a[3] = {pair.h_a.x, pair.h_a.y, pair.h_a.z};
    const Three h_b = in_lanes(pair.h_b);
    Best best = {threshold, {}};
    for (int i = 0; i < 3; ++i) {
        const EdgeAxes edges = measure_edges(c, i, t, h_a, h_b);
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
    return measure_axis(pair, best_face(pair, rows_of(pair.axes_b)).feature);
}

SeparatingAxis find_separating_axis(const BoxPair& pair, const SeparatingAxis& last,
                                    const Reach& reach) {
    const Rows c = rows_of(pair.axes_b);
    Best best = best_face(pair, c);
    if (best.separation > reach.distance) {
        const SeparatingAxis face = measure_axis(pair, best.feature);
        if (face.separation > reach.along(face.normal)) return face;
    }
    const AxisPreference preference = axis_preference(pair);
    const Best edges = best_edge_pair(pair, c, best.separation + preference.edge_over_face);
    if (edges.feature.kind != 0) best = edges;
    // The last step's axis if it is nearly as good as the best.
    const bool is_kept =
        last.feature.kind != 0 && last.separation >= best.separation - preference.new_over_last;
    return is_kept ? last : measure_axis(pair, best.feature);
}

}  // namespace cairn

// Where two boxes meet along one of SAT's axes; see box_witness.h.

#include "narrow/box_witness.h"

#include <limits>

namespace cairn {
namespace {

// A point this part of the box's size outside its face still lies on it.
constexpr float relative_border = 1e-6f;

// The corner of a box farthest along a direction, from its centre; both along the box's axes.
Three farthest_corner(Three slope, Three h) { return slope < Three{} ? -h : h; }

// The first box's face across its axis k, on the side of `sign`, against the second box's point
// farthest down. Where a whole edge or face of the second is level, rising by no more than
// `yielding`, any point of it will do, and one over the face is sought.
BoxWitness meet_face(const BoxPair& pair, int k, float sign, float yielding) {
    const Three slope = -sign * pair.axes_a[k];
    const Three rise = 2.0f * absolute(slope) * pair.h_b;
    const Choice is_level = rise <= yielding;
    const Three corner = farthest_corner(slope, pair.h_b);
    Three local = is_level ? Three{} : corner;
    constexpr float unbounded = std::numeric_limits<float>::max();
    const Three border = pair.h_a + relative_border * pair.h_a;
    const Three within = lane(k) ? Three{} + unbounded : border;

    Three on_other, on_face;
    bool is_inside = false;
    // Alternating projections: onto the face's prism, back onto the level edge or face.
    for (int round = 0; round < 4; ++round) {
        on_other = along_a(pair, local);
        on_face = pair.t + on_other;
        const Three clamped = max(min(on_face, within), -within);
        is_inside = !any(clamped != on_face);
        if (is_inside) break;
        const Three back = along_b(pair, clamped - on_face);
        const Three moved = max(min(local + back, pair.h_b), -pair.h_b);
        const Three next_local = is_level ? moved : corner;
        if (!any(next_local != local)) break;
        local = next_local;
    }
    // Straight down onto the face.
    return {lane(k) ? sign * pair.h_a : on_face, on_other, is_inside};
}

// The nearest points of the two edges that face each other along n.
BoxWitness meet_edges(const BoxPair& pair, int i, int j, Three n) {
    const Three center_a = lane(i) ? Three{} : farthest_corner(n, pair.h_a);
    const Three corner_b = farthest_corner(-along_b(pair, n), pair.h_b);
    const Three center_b = along_a(pair, lane(j) ? Three{} : corner_b);
    const Three u = pair.axes_b[j];
    // Minimise |d + r u - s e|^2 over s and r; e is A's axis i.
    const Three d = pair.t + center_b - center_a;
    const float c = u[i], d_e = d[i], d_u = dot(d, u);
    const Three across = lane(i) ? Three{} : u;
    const float squared_sine = dot(across, across);
    const float s = (d_e - c * d_u) / squared_sine, r = (c * d_e - d_u) / squared_sine;
    const float half_a = pair.h_a[i], half_b = pair.h_b[j];
    return {center_a + clamp(s, -half_a, half_a) * unit_three(i),
            center_b + clamp(r, -half_b, half_b) * u,
            absolute(s) <= half_a && absolute(r) <= half_b};
}

}  // namespace

BoxWitness find_witness(const BoxPair& pair, const SeparatingAxis& axis, float yielding) {
    const int i = axis.feature.index_a, j = axis.feature.index_b;
    switch (BoxAxisKind(axis.feature.kind)) {
        case BoxAxisKind::FaceA: {
            return meet_face(pair, i, axis.normal[i] < 0 ? -1.0f : 1.0f, 0.5f * yielding);
        }
        case BoxAxisKind::FaceB: {
            const float sign = dot(axis.normal, pair.axes_b[j]) < 0 ? 1.0f : -1.0f;
            const BoxWitness seen = meet_face(seen_from_b(pair), j, sign, 0.5f * yielding);
            return {along_a(pair, seen.point_b), along_a(pair, seen.point_a), seen.is_on_both};
        }
        default: return meet_edges(pair, i, j, axis.normal);
    }
}

}  // namespace cairn

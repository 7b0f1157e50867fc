// The axis between two boxes; see axis_box_box.h.
//
// Both methods end at the same place. SAT's best axis is the answer for boxes that overlap, and for
// those apart wherever it is the true distance; a vertex that faces a vertex or an edge's end has
// no axis among the 15, and there GJK measures. GJK and EPA give a direction, and where one of the
// 15 is as good, it is taken instead: its normal is exact, and the manifold that stands on it does
// not shiver.

#include "narrow/axis_box_box.h"

#include "narrow/box_witness.h"
#include "narrow/gjk_epa.h"

namespace cairn {
namespace {

Axis axis_along(const BoxPair& pair, const SeparatingAxis& best, AxisHint& hint) {
    const BoxWitness witness = find_witness(pair, best);
    hint = best.feature;
    return {best.normal, best.separation, witness.point_a, witness.point_b};
}

// The edge pair whose axis is the given normal, to 1e-3 radians; an unknown kind where there is
// none.
SeparatingAxis edge_pair_along(const BoxPair& pair, Vec3 normal) {
    constexpr float cosine = 1 - 5e-7f;
    SeparatingAxis nearest;
    float nearest_cosine = cosine;
    for (std::uint8_t i = 0; i < 3; ++i) {
        for (std::uint8_t j = 0; j < 3; ++j) {
            const AxisHint feature = {std::uint8_t(BoxAxisKind::EdgePair), i, j};
            const SeparatingAxis candidate = measure_axis(pair, feature);
            const float alignment = dot(candidate.normal, normal);
            if (alignment <= nearest_cosine) continue;
            nearest_cosine = alignment;
            nearest = candidate;
        }
    }
    return nearest;
}

// The axis that GJK or EPA found, on the face or the edge pair that it stands for.
Axis on_nearest_feature(const BoxPair& pair, const Axis& found, AxisHint& hint) {
    const AxisPreference preference = axis_preference(pair);
    const bool knows_last = hint.kind != 0;
    // The last axis, while it is as good; the best face, if it is; the edge pair that it is.
    if (knows_last) {
        const SeparatingAxis last = measure_axis(pair, hint);
        if (last.separation >= found.separation - preference.new_over_last) {
            const BoxWitness witness = find_witness(pair, last);
            if (found.separation <= 0 || witness.is_on_both) return axis_along(pair, last, hint);
        }
    }
    const SeparatingAxis face = find_separating_face(pair, {});
    if (face.separation >= found.separation - preference.edge_over_face) {
        return axis_along(pair, face, hint);
    }
    const SeparatingAxis edges = edge_pair_along(pair, found.normal);
    if (edges.feature.kind != 0 &&
        edges.separation >= found.separation - preference.edge_over_face) {
        return axis_along(pair, edges, hint);
    }
    hint = {};
    return found;
}

}  // namespace

Axis find_axis_box_box(const Box& a, const Box& b, const Pose& b_in_a, NarrowPhase method,
                       AxisHint& hint) {
    const BoxPair pair = make_box_pair(a, b, b_in_a);
    if (method == NarrowPhase::GjkEpa) {
        const Vec3 toward_b = pair.t == Vec3{} ? Vec3{0, 1, 0} : pair.t;
        const Axis found = find_axis_convex(convex_shape(a), convex_shape(b), b_in_a, toward_b);
        return on_nearest_feature(pair, found, hint);
    }
    const SeparatingAxis best = find_separating_axis(pair, hint);
    const BoxWitness witness = find_witness(pair, best);
    if (best.separation <= 0 || witness.is_on_both) {
        hint = best.feature;
        return {best.normal, best.separation, witness.point_a, witness.point_b};
    }
    const Axis found = find_axis_convex(convex_shape(a), convex_shape(b), b_in_a, best.normal);
    return on_nearest_feature(pair, found, hint);
}

}  // namespace cairn

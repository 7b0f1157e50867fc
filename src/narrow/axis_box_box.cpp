// The axis between two boxes; see axis_box_box.h.
//
// Both methods end at the same place. SAT's best axis is the answer for boxes that overlap, and for
// those apart wherever it is the true distance; a vertex that faces a vertex or an edge's end has
// no axis among the 15, and there GJK measures. GJK and EPA give a direction, and where one of the
// 15 is as good, it is taken instead: its normal is exact, and the manifold that stands on it does
// not shiver.

#include "narrow/axis_box_box.h"

#include <optional>

#include "narrow/box_witness.h"
#include "narrow/gjk_epa.h"

namespace cairn {
namespace {

// The answer along one of the 15 axes; nothing where the boxes are apart by more than that axis
// shows and `yielding` forgives.
std::optional<Axis> axis_along(const BoxPair& pair, const SeparatingAxis& along, float yielding) {
    const BoxWitness witness = find_witness(pair, along, yielding);
    if (along.separation > 0 && !witness.is_on_both) return std::nullopt;
    return Axis{vec3(along.normal), along.separation, vec3(witness.point_a), vec3(witness.point_b),
                true};
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
            const float alignment = dot(vec3(candidate.normal), normal);
            if (alignment <= nearest_cosine) continue;
            nearest_cosine = alignment;
            nearest = candidate;
        }
    }
    return nearest;
}

// The axis that GJK or EPA found, put on the one of the 15 that it stands for: the last step's
// while it is nearly as good, the best face if that is, the edge pair that lies along it. `hint`
// says which it was.
Axis on_nearest_feature(const BoxPair& pair, const Axis& found, const SeparatingAxis& last,
                        AxisHint& hint) {
    const AxisPreference preference = axis_preference(pair);
    struct Candidate {
        SeparatingAxis axis;
        float yielding;  // how much worse than what was found it may be
    };
    const Candidate candidates[] = {
        {last, preference.new_over_last},
        {find_separating_face(pair), preference.edge_over_face},
        {edge_pair_along(pair, found.normal), preference.edge_over_face},
    };
    for (const auto& [candidate, yielding] : candidates) {
        if (candidate.feature.kind == 0) continue;
        if (candidate.separation < found.separation - yielding) continue;
        if (const std::optional<Axis> axis = axis_along(pair, candidate, yielding)) {
            hint = candidate.feature;
            return *axis;
        }
    }
    // None is: the next step may do with the face if it is nearly as good.
    const SeparatingAxis& face = candidates[1].axis;
    const bool is_near = face.separation >= found.separation - preference.new_over_last;
    hint = is_near ? face.feature : AxisHint{};
    return found;
}

}  // namespace

bool find_axis_box_box(const BoxPair& pair, NarrowPhase method, const Reach& reach, AxisHint& hint,
                       Axis& axis) {
    const auto is_beyond = [&](const SeparatingAxis& along) {
        const Vec3 n = vec3(along.normal);
        if (!(along.separation > reach.along(n))) return false;
        axis.normal = n, axis.separation = along.separation;
        hint = along.feature;
        return true;
    };
    const SeparatingAxis last = hint.kind != 0 ? measure_axis(pair, hint) : SeparatingAxis{};
    if (hint.kind != 0 && is_beyond(last)) return false;
    const Vec3 t = vec3(pair.t);
    Vec3 toward_b = t == Vec3{} ? Vec3{0, 1, 0} : t;
    if (method == NarrowPhase::Sat) {
        const AxisPreference preference = axis_preference(pair);
        const SeparatingAxis best = find_separating_axis(pair, last, preference, reach);
        if (is_beyond(best)) return false;
        const float yielding =
            is_same(best.feature, hint) ? preference.new_over_last : preference.edge_over_face;
        if (const std::optional<Axis> found = axis_along(pair, best, yielding)) {
            hint = best.feature;
            axis = *found;
            return axis.separation <= reach.along(axis.normal);
        }
        toward_b = vec3(best.normal);
    }
    const Box a = {vec3(pair.h_a)}, b = {vec3(pair.h_b)};
    const auto& u = pair.axes_b;
    const Axis found = find_axis_convex(
        {convex_shape(a), convex_shape(b), t, {vec3(u[0]), vec3(u[1]), vec3(u[2])}}, toward_b);
    axis = on_nearest_feature(pair, found, last, hint);
    return axis.separation <= reach.along(axis.normal);
}

}  // namespace cairn

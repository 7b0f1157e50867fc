// Where two boxes meet along one of SAT's axes; see box_witness.h.

#include "narrow/box_witness.h"

#include <limits>

namespace cairn {
namespace {

// A point this part of the box's size outside its face still lies on it.
constexpr float relative_border = 1e-6f;

float toward(float slope, float half) { return slope < 0 ? -half : half; }

// The corner of a box farthest along a direction, from its centre; both along the box's axes.
Vec3 farthest_corner(Vec3 slope, Vec3 h) {
    return {toward(slope.x, h.x), toward(slope.y, h.y), toward(slope.z, h.z)};
}

// The first box's face across its axis k, on the side of `sign`, against the second box's point
// farthest down. Where a whole edge or face of the second is level, rising by no more than
// `yielding`, any point of it will do, and one over the face is sought.
BoxWitness meet_face(const BoxPair& pair, int k, float sign, float yielding) {
    const Vec3 down = -sign * unit_axis(k);
    const Vec3 slope = multiply_transposed(pair.axes_b, down);
    const Vec3 rise = 2.0f * multiply(absolute(slope), pair.h_b);
    const bool is_level[3] = {rise.x <= yielding, rise.y <= yielding, rise.z <= yielding};
    const bool any_level = is_level[0] || is_level[1] || is_level[2];
    const Vec3 corner = farthest_corner(slope, pair.h_b);
    const auto where_level = [&](Vec3 level, Vec3 other) {
        return Vec3{is_level[0] ? level.x : other.x, is_level[1] ? level.y : other.y,
                    is_level[2] ? level.z : other.z};
    };
    Vec3 local = where_level({}, corner);
    Vec3 within = pair.h_a + relative_border * pair.h_a;
    set_component(within, k, std::numeric_limits<float>::max());

    BoxWitness witness;
    // Alternating projections: onto the face's prism, back onto the level edge or face.
    for (int round = 0; round < 4; ++round) {
        witness.point_b = pair.axes_b * local;
        witness.point_a = pair.t + witness.point_b;
        const Vec3 clamped = max(min(witness.point_a, within), -within);
        witness.is_on_both = clamped == witness.point_a;
        if (witness.is_on_both || !any_level) break;
        const Vec3 back = multiply_transposed(pair.axes_b, clamped - witness.point_a);
        local = where_level(max(min(local + back, pair.h_b), -pair.h_b), corner);
    }
    // Straight down onto the face.
    set_component(witness.point_a, k, sign * component(pair.h_a, k));
    return witness;
}

// The nearest points of the two edges that face each other along n.
BoxWitness meet_edges(const BoxPair& pair, int i, int j, Vec3 n) {
    Vec3 center_a = farthest_corner(n, pair.h_a);
    set_component(center_a, i, 0);
    Vec3 local_b = farthest_corner(-multiply_transposed(pair.axes_b, n), pair.h_b);
    set_component(local_b, j, 0);
    const Vec3 center_b = pair.axes_b * local_b;
    const Vec3 e = unit_axis(i), u = column(pair.axes_b, j);
    // Minimise |d + r u - s e|^2 over s and r.
    const Vec3 d = pair.t + center_b - center_a;
    const float c = dot(e, u), d_e = dot(d, e), d_u = dot(d, u);
    const float squared_sine = length_squared(cross(e, u));
    const float s = (d_e - c * d_u) / squared_sine, r = (c * d_e - d_u) / squared_sine;
    const float half_a = component(pair.h_a, i), half_b = component(pair.h_b, j);
    return {center_a + clamp(s, -half_a, half_a) * e, center_b + clamp(r, -half_b, half_b) * u,
            absolute(s) <= half_a && absolute(r) <= half_b};
}

}  // namespace

BoxWitness find_witness(const BoxPair& pair, const SeparatingAxis& axis, float yielding) {
    const int i = axis.feature.index_a, j = axis.feature.index_b;
    switch (BoxAxisKind(axis.feature.kind)) {
        case BoxAxisKind::FaceA: {
            const float sign = toward(component(axis.normal, i), 1);
            return meet_face(pair, i, sign, 0.5f * yielding);
        }
        case BoxAxisKind::FaceB: {
            const float sign = toward(-dot(axis.normal, column(pair.axes_b, j)), 1);
            const BoxWitness seen = meet_face(seen_from_b(pair), j, sign, 0.5f * yielding);
            return {pair.axes_b * seen.point_b, pair.axes_b * seen.point_a, seen.is_on_both};
        }
        default: return meet_edges(pair, i, j, axis.normal);
    }
}

}  // namespace cairn

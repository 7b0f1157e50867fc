// Where two boxes meet along one of SAT's axes; see box_witness.h.

#include "narrow/box_witness.h"

#include <limits>

#include "shape/placed_box.h"

namespace cairn {
namespace {

// A point this part of the box's size outside its face still lies on it.
constexpr float relative_border = 1e-6f;

float toward(float slope, float half) { return slope < 0 ? -half : half; }

// The corner of the box farthest along n, from its centre. An edge that rises by no more than
// `yielding` is level and contributes nothing: any of its points will do.
Vec3 farthest_corner(const PlacedBox& box, Vec3 n, float yielding, bool is_level[3]) {
    const Vec3 slope = multiply_transposed(box.axes, n);
    const Vec3 rise = 2.0f * multiply(absolute(slope), box.half_extents);
    const Vec3 h = box.half_extents;
    is_level[0] = rise.x <= yielding, is_level[1] = rise.y <= yielding,
    is_level[2] = rise.z <= yielding;
    return {is_level[0] ? 0 : toward(slope.x, h.x), is_level[1] ? 0 : toward(slope.y, h.y),
            is_level[2] ? 0 : toward(slope.z, h.z)};
}

struct FaceWitness {
    Vec3 on_face;   // from the centre of the box whose face it is
    Vec3 on_other;  // from the other's
    bool is_inside = false;
};

// The farthest point of `other`, `offset` away, against the face of `owner` across its axis `k`
// with outward normal n. Where a whole edge or face of `other` is level, a point of it over the
// face is sought.
FaceWitness meet_face(const PlacedBox& owner, int k, Vec3 n, const PlacedBox& other, Vec3 offset,
                      float yielding) {
    bool is_level[3];
    Vec3 local = farthest_corner(other, -n, 0.5f * yielding, is_level);
    Vec3 within = owner.half_extents + relative_border * owner.half_extents;
    set_component(within, k, std::numeric_limits<float>::max());
    FaceWitness witness;
    Vec3 in_owner;
    // Alternating projections: onto the face's prism, back onto the level edge or face.
    for (int round = 0; round < 4; ++round) {
        witness.on_other = other.axes * local;
        in_owner = multiply_transposed(owner.axes, offset + witness.on_other);
        const Vec3 clamped = max(min(in_owner, within), -within);
        witness.is_inside = clamped == in_owner;
        if (witness.is_inside || !(is_level[0] || is_level[1] || is_level[2])) break;
        const Vec3 back = multiply_transposed(other.axes, owner.axes * (clamped - in_owner));
        const Vec3 moved = max(min(local + back, other.half_extents), -other.half_extents);
        local = {is_level[0] ? moved.x : local.x, is_level[1] ? moved.y : local.y,
                 is_level[2] ? moved.z : local.z};
    }
    // Straight down onto the face.
    const float side = dot(n, column(owner.axes, k)) < 0 ? -1.0f : 1.0f;
    const float height = side * component(in_owner, k) - component(owner.half_extents, k);
    witness.on_face = offset + witness.on_other - height * n;
    return witness;
}

// The nearest points of the two edges that face each other along n.
BoxWitness meet_edges(const PlacedBox& a, int i, const PlacedBox& b, int j, Vec3 n, Vec3 t) {
    bool unused[3];
    Vec3 local_a = farthest_corner(a, n, 0, unused), local_b = farthest_corner(b, -n, 0, unused);
    set_component(local_a, i, 0), set_component(local_b, j, 0);
    const Vec3 center_a = a.axes * local_a, center_b = b.axes * local_b;
    const Vec3 e = a.axes * unit_axis(i), u = b.axes * unit_axis(j);
    // Minimise |d + r u - s e|^2 over s and r.
    const Vec3 d = t + center_b - center_a;
    const float c = dot(e, u), d_e = dot(d, e), d_u = dot(d, u);
    const float squared_sine = length_squared(cross(e, u));
    const float s = (d_e - c * d_u) / squared_sine, r = (c * d_e - d_u) / squared_sine;
    const float half_a = component(a.half_extents, i), half_b = component(b.half_extents, j);
    BoxWitness witness;
    witness.is_on_both = absolute(s) <= half_a && absolute(r) <= half_b;
    witness.point_a = center_a + clamp(s, -half_a, half_a) * e;
    witness.point_b = center_b + clamp(r, -half_b, half_b) * u;
    return witness;
}

}  // namespace

BoxWitness find_witness(const BoxPair& pair, const SeparatingAxis& axis, float yielding) {
    const PlacedBox a = {pair.h_a, Mat3{}}, b = {pair.h_b, pair.axes_b};
    const int i = axis.feature.index_a, j = axis.feature.index_b;
    switch (BoxAxisKind(axis.feature.kind)) {
        case BoxAxisKind::FaceA: {
            const FaceWitness w = meet_face(a, i, axis.normal, b, pair.t, yielding);
            return {w.on_face, w.on_other, w.is_inside};
        }
        case BoxAxisKind::FaceB: {
            const FaceWitness w = meet_face(b, j, -axis.normal, a, -pair.t, yielding);
            return {w.on_other, w.on_face, w.is_inside};
        }
        default: return meet_edges(a, i, b, j, axis.normal, pair.t);
    }
}

}  // namespace cairn

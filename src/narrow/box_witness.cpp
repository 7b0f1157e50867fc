// Where two boxes meet along one of SAT's axes; see box_witness.h.

#include "narrow/box_witness.h"

#include <limits>

#include "shape/placed_box.h"

namespace cairn {
namespace {

// Below this slope, in radians, an edge counts as lying along the face across from it.
constexpr float level = 1e-5f;
// A point this part of the box's size outside its face still lies on it.
constexpr float relative_border = 1e-6f;

float toward(float slope, float half) { return slope < 0 ? -half : half; }

// The corner of the box farthest along n, from its centre; level edges contribute nothing.
Vec3 farthest_corner(const PlacedBox& box, Vec3 n, bool is_level[3]) {
    const Vec3 slope = multiply_transposed(box.axes, n);
    Vec3 corner;
    for (int k = 0; k < 3; ++k) {
        is_level[k] = absolute(component(slope, k)) < level;
        if (!is_level[k])
            set_component(corner, k, toward(component(slope, k), component(box.half_extents, k)));
    }
    return corner;
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
                      float separation) {
    bool is_level[3];
    Vec3 local = farthest_corner(other, -n, is_level);
    Vec3 within = owner.half_extents + relative_border * owner.half_extents;
    set_component(within, k, std::numeric_limits<float>::max());
    FaceWitness witness;
    // Alternating projections: onto the face's prism, back onto the level edge or face.
    for (int round = 0; round < 4; ++round) {
        const Vec3 point = other.axes * local;
        const Vec3 in_owner = multiply_transposed(owner.axes, offset + point);
        const Vec3 clamped = max(min(in_owner, within), -within);
        witness.on_other = point;
        witness.is_inside = clamped == in_owner;
        if (witness.is_inside) break;
        const Vec3 back = multiply_transposed(other.axes, owner.axes * (clamped - in_owner));
        for (int j = 0; j < 3; ++j) {
            if (!is_level[j]) continue;
            const float half = component(other.half_extents, j);
            set_component(local, j, clamp(component(local, j) + component(back, j), -half, half));
        }
    }
    witness.on_face = offset + witness.on_other - separation * n;
    return witness;
}

// The nearest points of the two edges that face each other along n.
BoxWitness meet_edges(const PlacedBox& a, int i, const PlacedBox& b, int j, Vec3 n, Vec3 t) {
    bool unused[3];
    Vec3 local_a = farthest_corner(a, n, unused), local_b = farthest_corner(b, -n, unused);
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

BoxWitness find_witness(const BoxPair& pair, const SeparatingAxis& axis) {
    const PlacedBox a = {pair.h_a, Mat3{}}, b = {pair.h_b, pair.axes_b};
    const int i = axis.feature.index_a, j = axis.feature.index_b;
    switch (BoxAxisKind(axis.feature.kind)) {
        case BoxAxisKind::FaceA: {
            const FaceWitness w = meet_face(a, i, axis.normal, b, pair.t, axis.separation);
            return {w.on_face, w.on_other, w.is_inside};
        }
        case BoxAxisKind::FaceB: {
            const FaceWitness w = meet_face(b, j, -axis.normal, a, -pair.t, axis.separation);
            return {w.on_other, w.on_face, w.is_inside};
        }
        default: return meet_edges(a, i, b, j, axis.normal, pair.t);
    }
}

}  // namespace cairn

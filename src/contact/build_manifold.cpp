// Contact points from an axis; see build_manifold.h.
//
// What meets along the axis decides: a round shape touches in one point, a plane in the vertices of
// the box's lowest face; two boxes have a file of their own.

#include "contact/build_manifold.h"

#include "contact/feature.h"
#include "contact/manifold_box_box.h"
#include "shape/visit.h"

namespace cairn {
namespace {

// The vertices of the box's lowest face against a plane. The box's axes and centre are given in the
// plane's frame or in the box's own, n points out of the plane, and `lowest` is the separation of
// the lowest vertex.
void push_plane_box(Manifold& manifold, Vec3 half_extents, const Mat3& axes, Vec3 center, Vec3 n,
                    bool plane_is_a, float lowest, float max_separation) {
    const Vec3 slope = multiply_transposed(axes, n);
    const FaceOwner owner = plane_is_a ? FaceOwner::B : FaceOwner::A;
    const int k = steepest_axis(slope), k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    const float sign = component(slope, k) < 0 ? 1.0f : -1.0f;
    const Vec3 middle = sign * component(half_extents, k) * column(axes, k);
    const Vec3 edge_1 = component(half_extents, k1) * column(axes, k1);
    const Vec3 edge_2 = component(half_extents, k2) * column(axes, k2);
    // From the lowest vertex, each edge climbed adds its own rise.
    const float rise_1 = 2 * component(half_extents, k1) * component(slope, k1);
    const float rise_2 = 2 * component(half_extents, k2) * component(slope, k2);
    constexpr float turn[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    for (const auto& [sign_1, sign_2] : turn) {
        const float separation = lowest + max(0, sign_1 * rise_1) + max(0, sign_2 * rise_2);
        if (!(separation <= max_separation)) continue;
        const Vec3 from_box = middle + sign_1 * edge_1 + sign_2 * edge_2 - 0.5f * separation * n;
        const Vec3 from_plane = center + from_box;
        const std::uint32_t vertex =
            face_bit(owner, k, sign) | face_bit(owner, k1, sign_1) | face_bit(owner, k2, sign_2);
        push_point(manifold, {plane_is_a ? from_plane : from_box,
                              plane_is_a ? from_box : from_plane, separation, vertex});
    }
}

}  // namespace

Manifold build_manifold(const Geometry& a, const Geometry& b, const Pose& b_in_a, const Axis& axis,
                        float max_separation) {
    Manifold manifold;
    manifold.normal = axis.normal;
    if (!(axis.separation <= max_separation)) return manifold;
    const Box* box_a = std::get_if<Box>(&a);
    const Box* box_b = std::get_if<Box>(&b);
    if (box_a && box_b) {
        push_box_box(manifold, make_box_pair(*box_a, *box_b, b_in_a), axis, max_separation);
    } else if (box_b && kind_of(a) == ShapeKind::Plane) {
        push_plane_box(manifold, box_b->half_extents, to_matrix(b_in_a.rotation), b_in_a.position,
                       axis.normal, true, axis.separation, max_separation);
    } else if (box_a && kind_of(b) == ShapeKind::Plane) {
        push_plane_box(manifold, box_a->half_extents, Mat3{}, -b_in_a.position, -axis.normal, false,
                       axis.separation, max_separation);
    } else {
        push_witness(manifold, axis, 0);
    }
    return manifold;
}

}  // namespace cairn

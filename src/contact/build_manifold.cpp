// Contact points from an axis; see build_manifold.h.
//
// What meets along the axis decides: a ball touches in one point, a plane in the vertices of the
// box's lowest face; two boxes and capsules have files of their own.

#include "contact/build_manifold.h"

#include "contact/feature.h"
#include "contact/manifold_box_box.h"
#include "contact/manifold_capsule.h"
#include "shape/visit.h"

namespace cairn {
namespace {

// The vertices of the box's lowest face against a plane. `box_axes` and `center`, the box's, are
// along whichever axes the manifold is; n points out of the plane, and `lowest` is the separation
// of the lowest vertex.
void push_plane_box(Manifold& manifold, Three half_extents, const Mat3& box_axes, Three center,
                    Three n, bool plane_is_a, float lowest, float max_separation) {
    const Three axes[3] = {three(box_axes.x), three(box_axes.y), three(box_axes.z)};
    const Three slope = {dot(axes[0], n), dot(axes[1], n), dot(axes[2], n), 0};
    const FaceOwner owner = plane_is_a ? FaceOwner::B : FaceOwner::A;
    const int k = steepest_axis(slope), k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    const float sign = slope[k] < 0 ? 1.0f : -1.0f;
    const Three middle = sign * half_extents[k] * axes[k];
    const Three edge_1 = half_extents[k1] * axes[k1], edge_2 = half_extents[k2] * axes[k2];
    // From the lowest vertex, each edge climbed adds its own rise.
    const float rise_1 = 2 * half_extents[k1] * slope[k1];
    const float rise_2 = 2 * half_extents[k2] * slope[k2];
    constexpr float turn[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    for (const auto& [sign_1, sign_2] : turn) {
        const float separation = lowest + max(0, sign_1 * rise_1) + max(0, sign_2 * rise_2);
        if (!(separation <= max_separation)) continue;
        const Three from_box = middle + sign_1 * edge_1 + sign_2 * edge_2 - 0.5f * separation * n;
        const Vec3 from_plane = vec3(center + from_box);
        const std::uint32_t vertex =
            face_bit(owner, k, sign) | face_bit(owner, k1, sign_1) | face_bit(owner, k2, sign_2);
        push_point(manifold, {plane_is_a ? from_plane : vec3(from_box),
                              plane_is_a ? vec3(from_box) : from_plane, separation, vertex});
    }
}

Segment core_of(const Capsule& capsule, Vec3 center, Vec3 axis) {
    return {center, axis, 0.5f * capsule.height};
}

// A capsule against anything but a ball; the other shape is one of two.
void push_capsule(Manifold& manifold, const Geometry& a, const Geometry& b, const Pose& b_in_a,
                  const Axis& axis, float max_separation) {
    const Mat3 axes_b = to_matrix(b_in_a.rotation);
    const Capsule* capsule_a = std::get_if<Capsule>(&a);
    const Capsule* capsule_b = std::get_if<Capsule>(&b);
    const Vec3 t = b_in_a.position;
    if (capsule_a && capsule_b)
        return push_capsule_capsule(manifold, core_of(*capsule_a, {}, {0, 1, 0}), capsule_a->radius,
                                    core_of(*capsule_b, t, axes_b.y), capsule_b->radius, axis,
                                    max_separation);
    const Capsule& capsule = capsule_a ? *capsule_a : *capsule_b;
    const Geometry& other = capsule_a ? b : a;
    const Segment core =
        capsule_a ? core_of(capsule, -t, {0, 1, 0}) : core_of(capsule, t, axes_b.y);
    if (const Box* box = std::get_if<Box>(&other))
        return push_box_capsule(manifold, box->half_extents, capsule_a ? axes_b : Mat3{}, core,
                                capsule.radius, axis, !capsule_a, max_separation);
    push_plane_capsule(manifold, core, capsule.radius, axis, !capsule_a, max_separation);
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
        push_plane_box(manifold, three(box_b->half_extents), to_matrix(b_in_a.rotation),
                       three(b_in_a.position), three(axis.normal), true, axis.separation,
                       max_separation);
    } else if (box_a && kind_of(b) == ShapeKind::Plane) {
        push_plane_box(manifold, three(box_a->half_extents), Mat3{}, -three(b_in_a.position),
                       -three(axis.normal), false, axis.separation, max_separation);
    } else if (kind_of(a) == ShapeKind::Sphere || kind_of(b) == ShapeKind::Sphere) {
        push_witness(manifold, axis, 0);
    } else {
        push_capsule(manifold, a, b, b_in_a, axis, max_separation);
    }
    return manifold;
}

}  // namespace cairn

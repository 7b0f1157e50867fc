// A half-space and a box: the box's lowest vertex, or the middle of its lowest edge or face.
//
// The box reaches sum of h_k |n . u_k| below its centre, u_k its axes.

#include "narrow/closed_forms.h"

namespace cairn {

Axis find_axis_plane_box(Vec3 normal, float height, Vec3 offset, const Box& box,
                         const Mat3& box_axes) {
    // Below this slope, in radians, an edge counts as level: its middle stands for it.
    constexpr float level = 1e-6f;
    const Vec3 along = multiply_transposed(box_axes, normal);
    const Vec3 h = box.half_extents;
    const auto lowest = [](float slope, float half) {
        return absolute(slope) < level ? 0.0f : slope > 0 ? -half : half;
    };
    const float reach = h.x * absolute(along.x) + h.y * absolute(along.y) + h.z * absolute(along.z);
    const float separation = height - reach;
    const Vec3 point =
        box_axes * Vec3{lowest(along.x, h.x), lowest(along.y, h.y), lowest(along.z, h.z)};
    return {normal, separation, offset + point - separation * normal, point};
}

}  // namespace cairn

// A box and a ball: the point of the box nearest to the ball's centre.
//
// In the box's frame that point is the centre clamped to the half extents, which covers faces,
// edges and corners alike. A centre inside the box leaves by the nearest face. A centre so close to
// the surface that rounding would choose the direction leaves by the face whose slab it is
// outermost of.

#include "narrow/closed_forms.h"

namespace cairn {
namespace {

// The face that is nearest to a centre inside the box or on its surface; ties go to x, then y, then
// +.
Axis leave_by_nearest_face(Vec3 h, Vec3 center, float radius) {
    int nearest = 0;
    float excess = absolute(center.x) - h.x;
    for (int k = 1; k < 3; ++k) {
        const float candidate = absolute(component(center, k)) - component(h, k);
        if (candidate > excess) excess = candidate, nearest = k;
    }
    const float sign = component(center, nearest) < 0 ? -1.0f : 1.0f;
    const Vec3 normal = sign * unit_axis(nearest);
    Vec3 on_box = max(min(center, h), -h);
    set_component(on_box, nearest, sign * component(h, nearest));
    return {normal, excess - radius, on_box, -radius * normal};
}

Axis find_axis_in_box_frame(Vec3 h, Vec3 center, float radius) {
    const Vec3 on_box = max(min(center, h), -h);
    const Vec3 outward = center - on_box;
    const Vec3 size = absolute(center), excess = absolute(outward);
    const float rounding = 4 * float_epsilon * max(size.x, max(size.y, size.z));
    const float scale = max(excess.x, max(excess.y, excess.z));
    if (!(scale > rounding)) return leave_by_nearest_face(h, center, radius);
    const Vec3 scaled = {outward.x / scale, outward.y / scale, outward.z / scale};
    const float scaled_length = length(scaled);
    const Vec3 n = {scaled.x / scaled_length, scaled.y / scaled_length, scaled.z / scaled_length};
    return {n, scale * scaled_length - radius, on_box, -radius * n};
}

}  // namespace

Axis find_axis_box_sphere(const Box& box, const Mat3& box_axes, const Sphere& sphere, Vec3 offset) {
    const Vec3 center = multiply_transposed(box_axes, offset);
    const Axis local = find_axis_in_box_frame(box.half_extents, center, sphere.radius);
    return {box_axes * local.normal, local.separation, box_axes * local.point_a,
            box_axes * local.point_b};
}

}  // namespace cairn

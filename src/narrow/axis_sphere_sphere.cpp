// Two balls: the line through the centres, |d| - r_a - r_b apart.

#include "narrow/closed_forms.h"

namespace cairn {

Axis find_axis_sphere_sphere(const Sphere& first, const Sphere& second, Vec3 offset) {
    // Scaled by the largest component, so that no square over- or underflows.
    const Vec3 size = absolute(offset);
    const float scale = max(size.x, max(size.y, size.z));
    if (!(scale > 0)) {
        const Vec3 n = {0, 1, 0};
        return {n, -(first.radius + second.radius), first.radius * n, -second.radius * n};
    }
    const Vec3 scaled = {offset.x / scale, offset.y / scale, offset.z / scale};
    const float scaled_length = length(scaled);
    const Vec3 n = {scaled.x / scaled_length, scaled.y / scaled_length, scaled.z / scaled_length};
    return {n, scale * scaled_length - (first.radius + second.radius), first.radius * n,
            -second.radius * n};
}

}  // namespace cairn

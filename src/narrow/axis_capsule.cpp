// Capsules against balls, half-spaces and each other: the nearest points of the cores, which are
// points and segments, and the radii around them.
//
// Cores that touch or cross, to rounding, have no direction between them: what is normal to both
// parts them with the least push.

#include "narrow/closed_forms.h"
#include "narrow/segment.h"

namespace cairn {
namespace {

float largest(Vec3 v) {
    const Vec3 size = absolute(v);
    return max(size.x, max(size.y, size.z));
}

// Two balls about points of the cores, each given from its shape's origin. `across` is where they
// part to if the points coincide, `size` how large the numbers were that those came from.
Axis find_axis_between(Vec3 core_a, float radius_a, Vec3 core_b, float radius_b, Vec3 offset,
                       Vec3 across, float size) {
    const Vec3 gap = (offset - core_a) + core_b;
    Axis axis;
    if (largest(gap) > 4 * float_epsilon * size) {
        axis = find_axis_sphere_sphere(Sphere{radius_a}, Sphere{radius_b}, gap);
    } else {
        const Vec3 n = dot(across, gap) < 0 ? -across : across;
        axis = {n, -(radius_a + radius_b), radius_a * n, -radius_b * n};
    }
    axis.point_a += core_a;
    axis.point_b += core_b;
    return axis;
}

}  // namespace

Axis find_axis_capsule_sphere(const Capsule& capsule, Vec3 capsule_axis, const Sphere& sphere,
                              Vec3 offset) {
    const Segment core = {{}, capsule_axis, 0.5f * capsule.height};
    const Vec3 nearest = point_at(core, find_place(core, offset));
    return find_axis_between(nearest, capsule.radius, {}, sphere.radius, offset,
                             any_perpendicular(capsule_axis), max(core.half, largest(offset)));
}

Axis find_axis_capsule_capsule(const Capsule& first, Vec3 first_axis, const Capsule& second,
                               Vec3 second_axis, Vec3 offset) {
    const Segment core_a = {{}, first_axis, 0.5f * first.height};
    const Segment core_b = {offset, second_axis, 0.5f * second.height};
    const SegmentPlaces places = find_closest_places(core_a, core_b);
    const Vec3 across = normalize_or(cross(first_axis, second_axis), any_perpendicular(first_axis));
    return find_axis_between(places.on_a * first_axis, first.radius, places.on_b * second_axis,
                             second.radius, offset, across,
                             max(max(core_a.half, core_b.half), largest(offset)));
}

Axis find_axis_plane_capsule(Vec3 normal, float height, Vec3 offset, const Capsule& capsule,
                             Vec3 capsule_axis) {
    // Below this slope, in radians, it counts as level: its middle stands for it.
    constexpr float level = 1e-6f;
    const float slope = dot(normal, capsule_axis), half = 0.5f * capsule.height;
    const float separation = height - half * absolute(slope) - capsule.radius;
    const float lowest = absolute(slope) < level ? 0 : slope > 0 ? -half : half;
    const Vec3 point = lowest * capsule_axis - capsule.radius * normal;
    return {normal, separation, offset + point - separation * normal, point};
}

}  // namespace cairn

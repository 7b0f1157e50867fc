// A half-space and a ball: its lowest point is what comes closest.

#include "narrow/closed_forms.h"

namespace cairn {

Axis find_axis_plane_sphere(Vec3 normal, float height, Vec3 offset, const Sphere& sphere) {
    return {normal, height - sphere.radius, offset - height * normal, -sphere.radius * normal};
}

}  // namespace cairn

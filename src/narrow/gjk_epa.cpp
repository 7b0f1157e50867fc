// GJK, then EPA where it is needed; see gjk_epa.h.

#include "narrow/gjk_epa.h"

#include "narrow/epa.h"
#include "narrow/gjk.h"

namespace cairn {
namespace {

Axis grow_by_radii(const MinkowskiDifference& difference, Vec3d n, double separation, Vec3d point_a,
                   Vec3d point_b) {
    const double r_a = difference.radius_a(), r_b = difference.radius_b();
    return {narrow(n), float(separation - (r_a + r_b)), narrow(point_a + r_a * n),
            narrow(point_b - r_b * n)};
}

}  // namespace

Axis find_axis_convex(const MinkowskiDifference& difference, Vec3 toward_b) {
    const GjkResult gjk = find_closest_points(difference, widen(toward_b));
    if (!gjk.overlap) {
        const double distance = length(gjk.closest);
        const Vec3d toward = (-1.0 / distance) * gjk.closest;
        return grow_by_radii(difference, toward, distance, gjk.point_a, gjk.point_b);
    }
    const EpaResult epa = find_penetration(difference, gjk.simplex);
    return grow_by_radii(difference, epa.normal, -epa.depth, epa.point_a, epa.point_b);
}

}  // namespace cairn

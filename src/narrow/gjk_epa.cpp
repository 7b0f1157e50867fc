// GJK, then EPA where it is needed; see gjk_epa.h.

#include "narrow/gjk_epa.h"

#include "narrow/epa.h"
#include "narrow/gjk.h"

namespace cairn {
namespace {

// The direction from A to B. Where three points span the nearest face of the Minkowski difference,
// its plane says so more sharply than the difference of two witnesses that nearly meet.
WideVec3 separating_normal(const GjkResult& gjk) {
    const Simplex& s = gjk.simplex;
    WideVec3 n = -gjk.closest;
    if (s.size == 3) {
        const WideVec3 a = s.points[0].w;
        const WideVec3 across = cross(s.points[1].w - a, s.points[2].w - a);
        n = dot(across, n) < 0 ? -across : across;
    }
    return (1.0 / length(n)) * n;
}

Axis grow_by_radii(WideVec3 n, double separation, WideVec3 point_a, WideVec3 point_b,
                   float radius_a, float radius_b) {
    const double r_a = radius_a, r_b = radius_b;
    return {narrow(n), float(separation - (r_a + r_b)), narrow(point_a + r_a * n),
            narrow(point_b - r_b * n)};
}

}  // namespace

Axis find_axis_convex(const ConvexShape& a, const ConvexShape& b, const Pose& b_in_a,
                      Vec3 toward_b) {
    const MinkowskiDifference difference(a, b, b_in_a);
    const GjkResult gjk = find_closest_points(difference, widen(toward_b));
    if (!gjk.overlap) {
        return grow_by_radii(separating_normal(gjk), length(gjk.closest), gjk.point_a, gjk.point_b,
                             a.radius, b.radius);
    }
    const EpaResult epa = find_penetration(difference, gjk.simplex);
    return grow_by_radii(epa.normal, -epa.depth, epa.point_a, epa.point_b, a.radius, b.radius);
}

}  // namespace cairn

// Support points of the Minkowski difference; see minkowski.h.

#include "narrow/minkowski.h"

namespace cairn {
namespace {

// The direction as binary32, scaled to a largest component of 1 so that it neither over- nor
// underflows.
Vec3 as_direction(Vec3d d) {
    const double x = d.x < 0 ? -d.x : d.x, y = d.y < 0 ? -d.y : d.y, z = d.z < 0 ? -d.z : d.z;
    const double largest = x > y ? (x > z ? x : z) : (y > z ? y : z);
    return largest > 0 ? narrow((1.0 / largest) * d) : Vec3{1, 0, 0};
}

}  // namespace

MinkowskiDifference::MinkowskiDifference(const ConvexShape& a, const ConvexShape& b, Vec3 t,
                                         const Mat3& axes_b)
    : a_(a),
      b_(b),
      t_(widen(t)),
      u_x_(widen(axes_b.x)),
      u_y_(widen(axes_b.y)),
      u_z_(widen(axes_b.z)) {}

MinkowskiPoint MinkowskiDifference::support(Vec3d direction) const {
    const Vec3d in_b = {dot(u_x_, direction), dot(u_y_, direction), dot(u_z_, direction)};
    const Vec3d a = widen(a_.support(a_.core, as_direction(direction)));
    const Vec3d local = widen(b_.support(b_.core, as_direction(-in_b)));
    const Vec3d b = local.x * u_x_ + local.y * u_y_ + local.z * u_z_;
    return {a - (t_ + b), a, b};
}

}  // namespace cairn

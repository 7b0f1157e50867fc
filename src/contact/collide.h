#pragma once
// Two shapes and one relative pose in, contact points out: the axis and the manifold at one go.

#include "cairn/settings.h"
#include "cairn/shape.h"
#include "contact/manifold.h"
#include "math/quat.h"

namespace cairn {

// What find_axis and build_manifold say, with `reach` for the largest separation, at less cost: two
// boxes are placed once, and those that are known to be farther apart are left at the first axis
// that shows it. True where there are points. Elsewhere the manifold is empty, and the axis's
// separation no more than a lower bound of the distance. `hint` is read and updated.
bool collide(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase method,
             const Reach& reach, AxisHint& hint, Axis& axis, Manifold& manifold);

}  // namespace cairn

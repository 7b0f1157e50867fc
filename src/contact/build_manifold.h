#pragma once
// From an axis to contact points.

#include "cairn/shape.h"
#include "contact/manifold.h"
#include "math/quat.h"
#include "narrow/axis.h"

namespace cairn {

// The points of contact along `axis` whose separation is at most `max_separation`: one for a
// ball, the ends of what a capsule lies along, the vertices below a plane, the clipped faces or the
// crossed edges of two polyhedra; at most four, the deepest always among them. The same builder
// serves every narrow-phase method.
Manifold build_manifold(const Geometry& a, const Geometry& b, const Pose& b_in_a, const Axis& axis,
                        float max_separation);

}  // namespace cairn

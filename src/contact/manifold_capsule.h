#pragma once
// The contact points of a capsule with a half-space, another capsule or a box.
//
// A capsule touches in one point, unless its core lies along what it meets: along a plane, beside
// another core, over a face or beside an edge of a box. The ends of the stretch that both share are
// then its points, each at its own distance, and named after what ends it: a capsule's end or a
// face of the box. Where the axis's own witness is deeper than both, it takes the place and the
// name of the end that it is at, or comes third.

#include "contact/manifold.h"
#include "math/mat3.h"
#include "narrow/segment.h"

namespace cairn {

// Each adds the points along the axis whose separation is at most `max_separation`. Everything is
// along A's axes.

// The core's centre is given from the plane's origin, whichever of the two is A.
void push_plane_capsule(Manifold& manifold, const Segment& core, float radius, const Axis& axis,
                        bool plane_is_a, float max_separation);

// The first core is about A's origin, the second's centre is given from there.
void push_capsule_capsule(Manifold& manifold, const Segment& core_a, float radius_a,
                          const Segment& core_b, float radius_b, const Axis& axis,
                          float max_separation);

// The core's centre is given from the box's, whichever of the two is A.
void push_box_capsule(Manifold& manifold, Vec3 half_extents, const Mat3& box_axes,
                      const Segment& core, float radius, const Axis& axis, bool box_is_a,
                      float max_separation);

}  // namespace cairn

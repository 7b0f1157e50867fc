#pragma once
// The narrow phase: two shapes and one relative pose in, one axis out.

#include "cairn/settings.h"
#include "cairn/shape.h"
#include "math/quat.h"
#include "narrow/axis.h"

namespace cairn {

// `b_in_a` places B's frame in A's. `hint` is read and updated. Closed forms answer wherever there is one;
// `method` chooses between SAT and GJK with EPA for the pairs of convex polyhedra. At most one of the two
// shapes is a plane. Swapping A and B swaps the answer, to the bit.
Axis find_axis(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase method,
               AxisHint& hint);

}  // namespace cairn

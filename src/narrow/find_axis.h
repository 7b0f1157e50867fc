#pragma once
// The narrow phase: two shapes and one relative pose in, one axis out.

#include "cairn/settings.h"
#include "cairn/shape.h"
#include "math/quat.h"
#include "narrow/axis.h"

namespace cairn {

// `b_in_a` places B's frame in A's. `hint` is read and updated. Closed forms answer wherever there
// is one; `method` chooses between SAT and GJK with EPA for the pairs of convex polyhedra. At most
// one of the two shapes is a plane. Swapping A and B swaps the answer: to the bit where the inverse
// of the pose is exact, to the rounding of the inverse elsewhere; where two axes are equally good,
// A's comes first. `b_in_a.position` is rounded to binary32 along A's axes: where one shape is far
// larger than the other, it should be A, so that a gap across one of its faces keeps all its digits
// wherever the other stands on it.
Axis find_axis(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase method,
               AxisHint& hint);

}  // namespace cairn

#pragma once
// The axis between any two convex shapes, by GJK where their cores are apart and by EPA where they
// touch or overlap. Radii are added at the end: a sphere is exact, whatever the other shape is.

#include "narrow/axis.h"
#include "narrow/minkowski.h"

namespace cairn {

// `toward_b` is a guess at the normal, of any length but 0; a good one saves rounds.
Axis find_axis_convex(const MinkowskiDifference& difference, Vec3 toward_b);

}  // namespace cairn

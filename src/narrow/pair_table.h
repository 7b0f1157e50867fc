#pragma once
// Which function finds the axis of which pair of kinds: the whole narrow phase at a glance.
//
//              sphere          box             plane           capsule
//   sphere     closed form     closed form     closed form     closed form
//   box        closed form     SAT or GJK+EPA  closed form     closed form
//   plane      closed form     closed form     never in touch  closed form
//   capsule    closed form     closed form     closed form     closed form
//
// A new kind of shape adds a row and a column; the table does not compile with a hole in it.

#include <array>

#include "cairn/settings.h"
#include "math/quat.h"
#include "narrow/axis.h"
#include "shape/visit.h"

namespace cairn {

using FindAxis = Axis (*)(const Geometry& a, const Geometry& b, const Pose& b_in_a,
                          NarrowPhase method, AxisHint& hint);

// The entry for a pair of kinds, in either order; never null.
FindAxis axis_finder(ShapeKind a, ShapeKind b);

}  // namespace cairn

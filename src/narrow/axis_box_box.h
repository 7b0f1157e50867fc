#pragma once
// The axis between two boxes, by SAT or by GJK and EPA.

#include "cairn/settings.h"
#include "cairn/shape.h"
#include "math/quat.h"
#include "narrow/axis.h"

namespace cairn {

Axis find_axis_box_box(const Box& a, const Box& b, const Pose& b_in_a, NarrowPhase method,
                       AxisHint& hint);

}  // namespace cairn

#pragma once
// The axis between two boxes, by SAT or by GJK and EPA.

#include "cairn/settings.h"
#include "narrow/box_pair.h"

namespace cairn {

// False where the two are farther apart than `reach`, or are no numbers; the axis is then one that
// shows it, its points not found and its separation no more than a lower bound of the distance. The
// axis of the last step, which `hint` names, is asked first: most pairs that were apart still are
// along it.
bool find_axis_box_box(const BoxPair& pair, NarrowPhase method, const Reach& reach, AxisHint& hint,
                       Axis& axis);

}  // namespace cairn

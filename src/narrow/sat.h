#pragma once
// The separating axis test for two boxes: of the 15 directions in which two boxes can be farthest
// apart or least deep in each other, the best.
//
// The directions are A's three face normals, B's three, and the nine cross products of their edges.
// Two boxes overlap exactly where they overlap along all 15. Where they do, the one with the least
// overlap is the direction of least push; where they do not, the largest separation is a lower
// bound of the distance, and the distance itself unless a vertex faces a vertex or an edge's end.
//
// Source: Gottschalk, Lin, Manocha, OBBTree, SIGGRAPH 1996. Departures: cross products are
// normalised before they compete; a face wins over an edge pair that is no better than rounding and
// a trifle; the axis of the last step is kept while it is nearly as good as the best.

#include "narrow/box_pair.h"

namespace cairn {

struct SeparatingAxis {
    Three normal = {0, 1, 0, 0};  // unit, from A to B
    float separation = 0;
    AxisHint feature;  // which of the 15 it is
};

// How much better an edge pair must be than a face, and a new axis than the last step's; metres.
struct AxisPreference {
    float edge_over_face = 0;
    float new_over_last = 0;
};
AxisPreference axis_preference(const BoxPair& pair);

// The best of all 15, or the first that shows that the two are farther apart than `reach`. `last`
// is the axis of the last step, measured, where there is one.
SeparatingAxis find_separating_axis(const BoxPair& pair, const SeparatingAxis& last,
                                    const AxisPreference& preference, const Reach& reach);

// The best of the six face normals.
SeparatingAxis find_separating_face(const BoxPair& pair);

// One of the 15, measured. For parallel edges, which span no axis, the separation is minus
// infinity.
SeparatingAxis measure_axis(const BoxPair& pair, AxisHint feature);

}  // namespace cairn

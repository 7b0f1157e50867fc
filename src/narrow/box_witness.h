#pragma once
// Where two boxes meet along one of SAT's 15 axes: a point of each, and whether the axis's
// separation is the true distance.

#include "narrow/sat.h"

namespace cairn {

struct BoxWitness {
    Three point_a;  // from A's centre, along A's axes
    Three point_b;  // from B's centre, along A's axes
    // True where both points lie on their boxes, one straight across from the other along the axis.
    // Then the separation is the distance, since no axis can claim more than that.
    bool is_on_both = false;
};

// The points may be farther apart than the axis's separation by `yielding`, metres: edges that rise
// less count as level.
BoxWitness find_witness(const BoxPair& pair, const SeparatingAxis& axis, float yielding);

}  // namespace cairn

#pragma once
// The contact points of two boxes.

#include "contact/manifold.h"
#include "narrow/box_pair.h"

namespace cairn {

// Adds the points along the axis whose separation is at most `max_separation`.
void push_box_box(Manifold& manifold, const BoxPair& pair, const Axis& axis, float max_separation);

}  // namespace cairn

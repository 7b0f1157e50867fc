#pragma once
// What can be asked of a tree beside a box: a ray, and a point with all that is near it.
//
// A probe says of a node's eight boxes which it reaches within its limit, and how far away each
// begins: a lower bound, so that nothing is passed over by rounding. Whoever looks may lower the
// limit as things are found; below 0 it ends the search.
//
// Source: the test of slabs with widened distances, Ize 2013. Departures: an origin in binary64 is
// put between the two binary32 numbers beside it, and where the direction has no component the
// inverse is large instead of infinite, so that no product is NaN.

#include "broad/box_node.h"

namespace cairn {

// `find` fills in `entry` for each slot, whether its bit is set or not.
struct RayProbe {
    RayProbe(Position origin, Vec3 direction, double length);
    std::uint32_t find(const BoxNode& node, float (&entry)[BoxNode::width]) const;

    Vec3 inverse;  // of the unit direction
    // Of the two numbers about the origin the one that makes the way into a slab shorter, and the
    // one that makes the way out longer.
    Vec3 origin_in, origin_out;
    float limit;  // m along the ray
};

struct PointProbe {
    PointProbe(Position position, double reach);
    std::uint32_t find(const BoxNode& node, float (&entry)[BoxNode::width]) const;

    Aabb origin;
    float limit;  // m from the point
};

// Slots that were reached, in the order of their distance: the nearest last, so that it lies
// on top of a stack.
struct ReachedSlots {
    ReachedSlots(std::uint32_t hits, const float (&entry)[BoxNode::width]);
    std::uint8_t slots[BoxNode::width];
    int count = 0;
};

}  // namespace cairn

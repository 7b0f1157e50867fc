#pragma once
// The core of a capsule, a segment about its middle, and where two such come closest.

#include "cairn/shape.h"
#include "math/vec3.h"

namespace cairn {

// From `center`, the points center + s axis with |s| <= half; `axis` is unit.
struct Segment {
    Vec3 center;
    Vec3 axis;
    float half = 0;
};

inline Vec3 point_at(const Segment& segment, float s) { return segment.center + s * segment.axis; }

// The place on the segment that is nearest to a point.
inline float find_place(const Segment& segment, Vec3 point) {
    return clamp(dot(segment.axis, point - segment.center), -segment.half, segment.half);
}

struct SegmentPlaces {
    float on_a = 0, on_b = 0;
};

// Where two segments come closest. Parallel ones that lie beside each other answer with the middle
// of what they share.
SegmentPlaces find_closest_places(const Segment& a, const Segment& b);

}  // namespace cairn

#pragma once
// How deep two convex parts overlap: the shortest way out, which for boxes is one of the fifteen
// separating axes, and for anything round a closed form or a search. binary64 throughout.

#include "scene.h"

namespace cairn::bench {

/// A part in the world: its axes are the columns of its rotation. Of a sphere or capsule the half
/// extents are those of its core, a box of no width, which is grown by the radius.
struct PlacedPart {
    Form form = Form::Box;
    Vector center = {};
    std::array<Vector, 3> axes = {};
    Vector half_extents = {};
    double radius = 0;
};

PlacedPart place_part(const Part& part, const Vector& position, const Rotation& rotation);

/// m; 0 where they do not overlap.
double measure_overlap(const PlacedPart& a, const PlacedPart& b);

/// Half the side lengths of the part's axis-parallel bounding box.
Vector bound_part(const PlacedPart& part);

double dot(const Vector& a, const Vector& b);
Vector cross(const Vector& a, const Vector& b);
/// v turned by q.
Vector turn(const Rotation& q, const Vector& v);

}  // namespace cairn::bench

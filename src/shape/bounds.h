#pragma once
// Bounding boxes of shapes.

#include "cairn/shape.h"
#include "math/mat3.h"

namespace cairn {

// Half extents of the axis-aligned box about a shape turned by `rotation`, centred on its origin.
// Tight up to rounding, which goes outward. A plane's are infinite in the directions into which it
// goes on.
Vec3 bounds_half_extents(const Geometry& geometry, const Mat3& rotation);

// The smallest half thickness of a shape: what slops and margins are measured by. A plane's is
// infinite.
float smallest_half_extent(const Geometry& geometry);

// The largest distance of a point of the shape from its origin. A plane's is infinite.
float bounding_radius(const Geometry& geometry);

}  // namespace cairn

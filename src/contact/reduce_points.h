#pragma once
// Which four of the corners of a contact polygon to keep.
//
// Four points carry whatever a flat contact can: force and torque across it. Kept is always the
// deepest point, and with it the three that make the largest quadrilateral; one that leaves out a
// centre of mass that the whole polygon holds up counts half. All subsets are tried, 35 at most, so
// the best is found. Ties go to the first subset in the order of the corners, and a later one must
// be better by a trifle: rounding does not make points come and go.

#include "contact/clip_faces.h"

namespace cairn {

// Keeps at most four of the corners, in their order.
void reduce_points(ClipPolygon& polygon);

}  // namespace cairn

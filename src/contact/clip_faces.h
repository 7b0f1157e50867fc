#pragma once
// Where two faces of boxes lie over each other: the polygon that they share, seen along the normal,
// with the gap between them at each corner.
//
// One face, the subject, is clipped against the four sides of the other by Sutherland and Hodgman's
// method, in the plane of the other. Its corners are then the subject's vertices, the other's, and
// the points where edges cross; each knows the pair of features that meets there. Everything is
// measured from the subject's centre, so that the smaller box, which is the subject, keeps all of
// its digits even on a ground a thousand times its size.
//
// Source: Sutherland, Hodgman, Reentrant polygon clipping, CACM 17(1), 1974. Departures: both
// planes' heights are linear over the polygon and are evaluated at its corners, rather than carried
// through the cuts; a vertex that lies outside by a trifle is moved to the side and not cut, so
// that flush boxes keep their points' names.

#include <array>

#include "contact/feature.h"
#include "shape/placed_box.h"

namespace cairn {

struct BoxFace {
    int axis = 0;
    float sign = 1;
};

// The face whose outward normal is most along n.
BoxFace face_along(const PlacedBox& box, Vec3 n);

struct ClipPoint {
    Vec3 position;         // halfway between the two faces, from the subject's centre
    float separation = 0;  // along n, from the subject to the other
    float p = 0,
          q = 0;  // the place within the other face's plane, metres, from the subject's centre
    BoxFeature of_subject;
    BoxFeature of_other;
};

struct ClipPolygon {
    static constexpr int max_points = 8;
    std::array<ClipPoint, max_points> points;
    int count = 0;
    // The other box's centre in the same plane.
    float other_p = 0, other_q = 0;
};

// `other_center` is measured from the subject's; `n` is unit, from the subject to the other.
ClipPolygon clip_faces(const PlacedBox& subject, const PlacedBox& other, Vec3 other_center, Vec3 n);

}  // namespace cairn

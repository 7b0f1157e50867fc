#pragma once
// Where two faces of boxes lie over each other: the polygon that they share, seen along the normal,
// with the gap between them at each corner.
//
// One face, the subject's, is clipped against the four sides of the other, the reference's, by
// Sutherland and Hodgman's method, in the plane of the reference. Its corners are then the
// subject's vertices, the reference's, and the points where edges cross; each knows the pair of
// features that meets there. Everything is measured from the subject's centre, so that the smaller
// box, which is the subject, keeps all of its digits even on a ground a thousand times its size.
//
// Source: Sutherland, Hodgman, Reentrant polygon clipping, CACM 17(1), 1974. Departures: both
// planes' heights are linear over the polygon and are evaluated at its corners, rather than carried
// through the cuts; a vertex that lies outside by a trifle is moved to the side and not cut, so
// that flush boxes keep their points' names.

#include "contact/feature.h"
#include "narrow/box_pair.h"

namespace cairn {

struct ClipPolygon {
    static constexpr int max_points = 8;
    int count = 0;
    // Of each corner: its place in the reference's face, metres along the box's two next axes,
    float p[max_points] = {}, q[max_points] = {};
    float separation[max_points] = {};       // the gap there, along the normal,
    std::uint32_t feature[max_points] = {};  // and what meets there.
    // The reference's centre, in the same plane; the subject's is at 0.
    float center_p = 0, center_q = 0;
    int axis = 0;      // which the reference's face lies across
    float height = 0;  // of the reference's face above the subject's centre, along the normal
};

// The pair's first box is the reference, its second the subject. The normal is unit, from the first
// to the second, along the axes of either; `first` and `second` number their features. Corners
// whose gap is larger than `max_separation` are left out.
ClipPolygon clip_faces(const BoxPair& pair, Three n_in_first, Three n_in_second, FaceOwner first,
                       FaceOwner second, float max_separation);

// Puts corner `from` in the place of corner `to`.
inline void move_corner(ClipPolygon& polygon, int from, int to) {
    polygon.p[to] = polygon.p[from], polygon.q[to] = polygon.q[from];
    polygon.separation[to] = polygon.separation[from];
    polygon.feature[to] = polygon.feature[from];
}

}  // namespace cairn

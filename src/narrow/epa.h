#pragma once
// EPA: how deep do two overlapping convex shapes lie in each other, and which way is out?
//
// It grows a polytope inside the Minkowski difference D around the origin. In every round it takes
// the face nearest to the origin and asks D for its farthest point along that face's normal. A
// point that lies beyond the face joins the polytope: all faces that see it are removed and their
// rim is joined to it. Where there is none, the face is D's own: its distance is the depth and its
// normal the way out.
//
// GJK's simplex need not be a tetrahedron (the shapes may just touch): it is grown into one first,
// from a point, a segment or a triangle. A D without any volume has depth 0 across its plane.
//
// Source: van den Bergen, Proximity queries and penetration depth computation on 3D game objects,
// GDC 2001. Departures: the faces that see a point are found by walking over shared edges from the
// nearest face, so that rounding cannot tear the rim; a face in the point's plane counts as seeing
// it, so that no sliver is left; all tolerances are relative.

#include "narrow/minkowski.h"

namespace cairn {

struct EpaResult {
    Vec3d normal = {0, 1, 0};  // unit, from A to B
    double depth = 0;          // >= 0 to rounding; a lower bound where the rounds ran out
    Vec3d point_a;             // the witnesses, each from its shape's origin
    Vec3d point_b;
    int rounds = 0;
};

// `simplex`: where GJK found the origin, 1 to 4 points.
EpaResult find_penetration(const MinkowskiDifference& difference, const Simplex& simplex);

}  // namespace cairn

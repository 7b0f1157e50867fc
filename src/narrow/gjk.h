#pragma once
// GJK: how far apart are two convex shapes, and where are they closest?
//
// It walks through the Minkowski difference D with a simplex of up to four of its points. In every
// round it takes the simplex's point v that is nearest to the origin, keeps the fewest points that
// v is made of, and adds the point of D that lies farthest towards the origin. Where no such point
// brings it nearer, v is D's nearest point and |v| the distance; where the simplex comes to hold
// the origin, the shapes overlap, and EPA goes on from the simplex.
//
// Source: Gilbert, Johnson, Keerthi, A fast procedure for computing the distance between complex
// objects, IEEE J. Robotics and Automation 4(2), 1988; the cases after Ericson, Real-Time Collision
// Detection, 2005. Departures: all tolerances are relative; a round that does not come nearer ends
// it.

#include "narrow/minkowski.h"

namespace cairn {

struct GjkResult {
    bool overlap = false;  // the cores touch or overlap: `simplex` holds the origin, to rounding
    Vec3d closest;         // v, D's point nearest to the origin: from B's witness to A's
    Vec3d point_a;         // the witnesses, each from its shape's origin
    Vec3d point_b;
    Simplex simplex;
    int rounds = 0;
};

// `toward_b` is a guess at the direction from A to B; any but 0 is right.
GjkResult find_closest_points(const MinkowskiDifference& difference, Vec3d toward_b);

// The cases: each keeps the fewest points whose hull holds the simplex's point nearest to the
// origin, and sets their weights. The last answers whether the tetrahedron holds the origin, and
// then keeps all four.
void reduce_segment(Simplex& simplex);
void reduce_triangle(Simplex& simplex);
bool reduce_tetrahedron(Simplex& simplex);

}  // namespace cairn

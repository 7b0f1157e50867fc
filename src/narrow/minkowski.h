#pragma once
// The Minkowski difference of two convex cores: what GJK and EPA walk on.
//
// D = { a - b : a in A, b in B } holds the origin exactly where the shapes overlap; the distance
// from the origin to D is theirs, and the nearest way out of D is the least push that parts them. D
// is known by its support points alone: s(d) = s_A(d) - s_B(-d).
//
// Worked in binary64: the points are binary32 numbers, so that products of two of them are exact,
// and simplices as thin as a needle and as wide as a plain are still told apart. Results are
// rounded once.

#include "math/vec3d.h"
#include "shape/support.h"

namespace cairn {

// A point w = a - b of D, with the points of A and B that it comes from, along A's axes.
struct MinkowskiPoint {
    Vec3d w;
    Vec3d a;  // from A's origin
    Vec3d b;  // from B's origin
};
inline bool is_same_vertex(const MinkowskiPoint& p, const MinkowskiPoint& q) {
    return p.w.x == q.w.x && p.w.y == q.w.y && p.w.z == q.w.z;
}

class MinkowskiDifference {
public:
    MinkowskiDifference(const ConvexShape& a, const ConvexShape& b, Vec3 t, const Mat3& axes_b);
    MinkowskiDifference(const ConvexShape& a, const ConvexShape& b, const Pose& b_in_a)
        : MinkowskiDifference(a, b, b_in_a.position, to_matrix(b_in_a.rotation)) {}

    // The point of D farthest along `direction`, of any length but 0.
    MinkowskiPoint support(Vec3d direction) const;
    // From B's origin to A's: a point of D for shapes that hold their origins.
    Vec3d center() const { return -t_; }
    double radius_a() const { return double(a_.radius); }
    double radius_b() const { return double(b_.radius); }

private:
    ConvexShape a_, b_;
    Vec3d t_, u_x_, u_y_, u_z_;  // B's origin and axes
};

// Up to four points of D and the weights that make the point nearest to the origin of them.
struct Simplex {
    MinkowskiPoint points[4];
    double weights[4] = {};
    int size = 0;
};

}  // namespace cairn

// EPA; see epa.h.

#include "narrow/epa.h"

#include "narrow/gjk.h"
#include "narrow/polytope.h"

namespace cairn {
namespace {

constexpr int max_rounds = 63;
// Done when D reaches beyond the nearest face by no more than this part of its size.
constexpr double relative_gain = 1e-10;
// Points within this part of D's size of a point, line or plane lie on it.
constexpr double relative_flat = 1e-10;

constexpr Vec3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

// The unit vector least along v.
Vec3d axis_across(Vec3d v) {
    const double x = v.x * v.x, y = v.y * v.y, z = v.z * v.z;
    return x <= y && x <= z ? axes[0] : y <= z ? axes[1] : axes[2];
}

void append(Simplex& s, const MinkowskiPoint& p) { s.points[s.size++] = p; }

bool grow_point(const MinkowskiDifference& d, Simplex& s, double flat) {
    for (const Vec3d& axis : axes) {
        for (const Vec3d& direction : {axis, -axis}) {
            const MinkowskiPoint p = d.support(direction);
            if (length(p.w - s.points[0].w) > flat) return append(s, p), true;
        }
    }
    return false;
}

bool grow_segment(const MinkowskiDifference& d, Simplex& s, double flat) {
    const Vec3d ab = s.points[1].w - s.points[0].w;
    const Vec3d u = cross(ab, axis_across(ab)), v = cross(ab, u);
    for (const Vec3d& direction : {u, -u, v, -v}) {
        const MinkowskiPoint p = d.support(direction);
        const Vec3d off = cross(ab, p.w - s.points[0].w);
        if (length(off) > flat * length(ab)) return append(s, p), true;
    }
    return false;
}

bool grow_triangle(const MinkowskiDifference& d, Simplex& s, double flat) {
    const Vec3d a = s.points[0].w, n = cross(s.points[1].w - a, s.points[2].w - a);
    for (const Vec3d& direction : {n, -n}) {
        const MinkowskiPoint p = d.support(direction);
        const double height = dot(n, p.w - a);
        if (height > flat * length(n) || -height > flat * length(n)) return append(s, p), true;
    }
    return false;
}

// Adds points of D until the simplex is a tetrahedron; false where D has no volume, and then the
// simplex spans as much as D does.
bool grow_to_tetrahedron(const MinkowskiDifference& d, Simplex& s) {
    double scale = 0;
    for (const Vec3d& axis : axes) {
        const double extent = dot(axis, d.support(axis).w - d.support(-axis).w);
        if (extent > scale) scale = extent;
    }
    const double flat = relative_flat * scale;
    if (s.size == 1 && !grow_point(d, s, flat)) return false;
    if (s.size == 2 && !grow_segment(d, s, flat)) return false;
    if (s.size == 3 && !grow_triangle(d, s, flat)) return false;
    return true;
}

// The answer for a D without volume: across whatever it spans, depth 0.
EpaResult escape_flat(const Simplex& s) {
    EpaResult result;
    const Vec3d a = s.points[0].w;
    if (s.size == 3) result.normal = cross(s.points[1].w - a, s.points[2].w - a);
    if (s.size == 2) result.normal = cross(s.points[1].w - a, axis_across(s.points[1].w - a));
    result.normal = (1.0 / length(result.normal)) * result.normal;
    result.point_a = s.points[0].a, result.point_b = s.points[0].b;
    return result;
}

}  // namespace

EpaResult find_penetration(const MinkowskiDifference& difference, const Simplex& simplex) {
    Simplex start = simplex;
    if (!grow_to_tetrahedron(difference, start)) return escape_flat(start);

    Polytope polytope(start);
    EpaResult result;
    int nearest = polytope.nearest_face();
    if (nearest < 0) return escape_flat(start);
    Simplex witness;
    for (result.rounds = 1;; ++result.rounds) {
        const Polytope::Face face = polytope.face(nearest);
        result.normal = face.normal;
        result.depth = face.distance;
        const MinkowskiPoint beyond = difference.support(face.normal);
        const double gain = dot(face.normal, beyond.w) - face.distance;
        const double tolerance = relative_gain * polytope.scale();
        if (gain <= tolerance || result.rounds == max_rounds || polytope.has_vertex(beyond)) {
            // D's own face may be several triangles: the witness lies on the one below the origin.
            witness = polytope.nearest_triangle(face.distance, tolerance);
            break;
        }
        witness = polytope.triangle(nearest);
        if (!polytope.add(beyond, nearest)) {
            reduce_triangle(witness);
            break;
        }
        nearest = polytope.nearest_face();
    }
    for (int i = 0; i < witness.size; ++i) {
        result.point_a = result.point_a + witness.weights[i] * witness.points[i].a;
        result.point_b = result.point_b + witness.weights[i] * witness.points[i].b;
    }
    return result;
}

}  // namespace cairn

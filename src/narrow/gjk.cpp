// GJK; see gjk.h. a, b, c, d are the simplex's points, 0 is the origin.

#include "narrow/gjk.h"

namespace cairn {
namespace {

constexpr int max_rounds = 48;
// Stop when D's support says that v is nearest to within this part of |v|^2.
constexpr double relative_gap = 1e-12;
// Nearer than this part of the largest point of D, the origin counts as touched.
constexpr double relative_touch = 1e-11;
// A volume or area below this part of the product of its sides is flat.
constexpr double relative_flat = 1e-12;

Vec3d nearest_point(const Simplex& s) {
    Vec3d v;
    for (int i = 0; i < s.size; ++i) v = v + s.weights[i] * s.points[i].w;
    return v;
}

void keep_vertex(Simplex& s, int i) {
    s.points[0] = s.points[i];
    s.weights[0] = 1;
    s.size = 1;
}

void keep_edge(Simplex& s, int i, int j, double weight_of_j) {
    const MinkowskiPoint p = s.points[i], q = s.points[j];
    s.points[0] = p, s.points[1] = q;
    s.weights[0] = 1 - weight_of_j, s.weights[1] = weight_of_j;
    s.size = 2;
}

// Keeps whichever of two reduced simplices comes nearer.
void keep_nearer(Simplex& s, const Simplex& other) {
    if (length_squared(nearest_point(other)) < length_squared(nearest_point(s))) s = other;
}

Simplex sub_simplex(const Simplex& s, int i, int j, int k = -1) {
    Simplex sub;
    sub.points[0] = s.points[i], sub.points[1] = s.points[j];
    sub.size = 2;
    if (k >= 0) sub.points[2] = s.points[k], sub.size = 3;
    return sub;
}

// A triangle without area: the nearest point lies on one of its edges.
void reduce_flat_triangle(Simplex& s) {
    Simplex best = sub_simplex(s, 0, 1);
    reduce_segment(best);
    for (int i = 0; i < 2; ++i) {
        Simplex edge = sub_simplex(s, i, 2);
        reduce_segment(edge);
        keep_nearer(best, edge);
    }
    s = best;
}

bool reduce(Simplex& s) {
    switch (s.size) {
        case 1: s.weights[0] = 1; return false;
        case 2: reduce_segment(s); return false;
        case 3: reduce_triangle(s); return false;
        default: return reduce_tetrahedron(s);
    }
}

double largest_square(const Simplex& s) {
    double largest = 0;
    for (int i = 0; i < s.size; ++i) {
        const double squared = length_squared(s.points[i].w);
        if (squared > largest) largest = squared;
    }
    return largest;
}

bool has_vertex(const Simplex& s, const MinkowskiPoint& p) {
    for (int i = 0; i < s.size; ++i)
        if (is_same_vertex(s.points[i], p)) return true;
    return false;
}

}  // namespace

void reduce_segment(Simplex& s) {
    const Vec3d a = s.points[0].w, ab = s.points[1].w - a;
    const double along = -dot(a, ab), squared = length_squared(ab);
    if (along <= 0) return keep_vertex(s, 0);        // 0 lies behind a
    if (along >= squared) return keep_vertex(s, 1);  // 0 lies beyond b
    keep_edge(s, 0, 1, along / squared);
}

void reduce_triangle(Simplex& s) {
    const Vec3d a = s.points[0].w, b = s.points[1].w, c = s.points[2].w;
    const Vec3d ab = b - a, ac = c - a, n = cross(ab, ac);
    const double sides = length_squared(ab) * length_squared(ac);
    if (length_squared(n) <= relative_flat * relative_flat * sides) return reduce_flat_triangle(s);

    // Beyond a vertex: 0 lies behind it along both of its edges.
    const double a_b = -dot(a, ab), a_c = -dot(a, ac);
    if (a_b <= 0 && a_c <= 0) return keep_vertex(s, 0);
    const double b_b = -dot(b, ab), b_c = -dot(b, ac);
    if (b_b >= 0 && b_c <= b_b) return keep_vertex(s, 1);
    const double c_b = -dot(c, ab), c_c = -dot(c, ac);
    if (c_c >= 0 && c_b <= c_c) return keep_vertex(s, 2);

    // Outside an edge: the part of the area that the opposite vertex weighs is negative.
    const double area_c = dot(n, cross(a, b)), area_b = dot(n, cross(c, a)),
                 area_a = dot(n, cross(b, c));
    if (area_c <= 0 && a_b >= 0 && b_b <= 0) return keep_edge(s, 0, 1, a_b / (a_b - b_b));
    if (area_b <= 0 && a_c >= 0 && c_c <= 0) return keep_edge(s, 0, 2, a_c / (a_c - c_c));
    if (area_a <= 0 && b_c - b_b >= 0 && c_b - c_c >= 0) {
        return keep_edge(s, 1, 2, (b_c - b_b) / ((b_c - b_b) + (c_b - c_c)));
    }

    // Above or below the face.
    const double sum = area_a + area_b + area_c;
    s.weights[0] = area_a / sum, s.weights[1] = area_b / sum, s.weights[2] = area_c / sum;
}

bool reduce_tetrahedron(Simplex& s) {
    // Each face, and the vertex across from it.
    constexpr int faces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
    Simplex best;
    double signed_parts[4] = {};  // the weight of each vertex, times six volumes
    for (const auto& face : faces) {
        const Vec3d a = s.points[face[0]].w, d = s.points[face[3]].w;
        const Vec3d ab = s.points[face[1]].w - a, ac = s.points[face[2]].w - a;
        const Vec3d n = cross(ab, ac);
        const double of_d = dot(n, d - a), of_origin = -dot(n, a);
        const double flat = relative_flat * length(n) * length(d - a);
        const bool is_flat = of_d <= flat && of_d >= -flat;
        signed_parts[face[3]] = is_flat ? 0 : of_origin / of_d;
        // 0 lies on the side of this face that the fourth vertex does not.
        if (!is_flat && of_origin * of_d >= 0) continue;
        Simplex candidate = sub_simplex(s, face[0], face[1], face[2]);
        reduce_triangle(candidate);
        if (best.size == 0) {
            best = candidate;
        } else {
            keep_nearer(best, candidate);
        }
    }
    if (best.size == 0) {
        for (int i = 0; i < 4; ++i) s.weights[i] = signed_parts[i];
        return true;
    }
    s = best;
    return false;
}

GjkResult find_closest_points(const MinkowskiDifference& difference, Vec3d toward_b) {
    GjkResult result;
    Simplex& simplex = result.simplex;
    simplex.points[0] = difference.support(toward_b);
    simplex.weights[0] = 1;
    simplex.size = 1;
    Vec3d v = simplex.points[0].w;

    for (result.rounds = 1; result.rounds < max_rounds; ++result.rounds) {
        const double squared = length_squared(v);
        if (squared <= relative_touch * relative_touch * largest_square(simplex)) {
            result.overlap = true;
            break;
        }
        // The next point: the farthest of D towards the origin. v is nearest if it is no farther.
        const MinkowskiPoint next = difference.support(-v);
        if (squared - dot(v, next.w) <= relative_gap * squared || has_vertex(simplex, next)) break;

        Simplex grown = simplex;
        grown.points[grown.size++] = next;
        const bool holds_origin = reduce(grown);
        const Vec3d nearer = nearest_point(grown);
        if (!holds_origin && length_squared(nearer) >= squared) break;
        simplex = grown;
        v = nearer;
        if (holds_origin) {
            result.overlap = true;
            break;
        }
    }

    result.closest = v;
    for (int i = 0; i < simplex.size; ++i) {
        result.point_a = result.point_a + simplex.weights[i] * simplex.points[i].a;
        result.point_b = result.point_b + simplex.weights[i] * simplex.points[i].b;
    }
    return result;
}

}  // namespace cairn

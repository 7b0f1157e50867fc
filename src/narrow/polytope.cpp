// The polytope that EPA grows; see polytope.h.

#include "narrow/polytope.h"

#include "narrow/gjk.h"

namespace cairn {
namespace {

// A point this part of the scale below a face's plane still counts as seen.
constexpr double relative_plane = 1e-12;
// A triangle with less area than this part of the product of its sides has no normal.
constexpr double relative_sliver = 1e-13;

}  // namespace

Polytope::Polytope(const Simplex& tetrahedron) {
    for (; vertex_count_ < 4; ++vertex_count_) {
        vertices_[std::size_t(vertex_count_)] = tetrahedron.points[vertex_count_];
        const double distance = length(tetrahedron.points[vertex_count_].w);
        if (distance > scale_) scale_ = distance;
    }
    const Vec3d a = vertex(0).w, b = vertex(1).w, c = vertex(2).w, d = vertex(3).w;
    // Wound so that 0, 1, 2 is counter-clockwise seen from outside, away from the fourth.
    const bool flip = dot(cross(b - a, c - a), d - a) > 0;
    const int p = 0, q = flip ? 2 : 1, r = flip ? 1 : 2, s = 3;
    make_face(p, q, r), make_face(q, p, s), make_face(r, q, s), make_face(p, r, s);
    constexpr int neighbors[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    for (int f = 0; f < 4; ++f)
        for (int k = 0; k < 3; ++k) at(f).neighbors[k] = neighbors[f][k];
}

bool Polytope::has_vertex(const MinkowskiPoint& point) const {
    for (int i = 0; i < vertex_count_; ++i)
        if (is_same_vertex(vertex(i), point)) return true;
    return false;
}

int Polytope::nearest_face() const {
    int nearest = -1;
    for (int f = 0; f < face_count_; ++f) {
        if (!face(f).is_alive) continue;
        if (nearest < 0 || face(f).distance < face(nearest).distance) nearest = f;
    }
    return nearest;
}

Simplex Polytope::triangle(int index) const {
    Simplex corners;
    for (const int v : face(index).vertices) corners.points[corners.size++] = vertex(v);
    return corners;
}

Simplex Polytope::nearest_triangle(double distance, double tolerance) const {
    Simplex best;
    double best_squared = 0;
    for (int f = 0; f < face_count_; ++f) {
        if (!face(f).is_alive || face(f).distance > distance + tolerance) continue;
        Simplex candidate = triangle(f);
        reduce_triangle(candidate);
        Vec3d point;
        for (int k = 0; k < candidate.size; ++k) {
            point = point + candidate.weights[k] * candidate.points[k].w;
        }
        const double squared = length_squared(point);
        if (best.size == 0 || squared < best_squared) best = candidate, best_squared = squared;
    }
    return best;
}

// The new face's index; -1 where it has no normal or there is no room.
int Polytope::make_face(int a, int b, int c) {
    const Vec3d p = vertex(a).w, ab = vertex(b).w - p, ac = vertex(c).w - p;
    const Vec3d n = cross(ab, ac);
    const double area = length(n);
    if (!(area > relative_sliver * length(ab) * length(ac))) return -1;
    int slot = 0;
    while (slot < face_count_ && face(slot).is_alive) ++slot;
    if (slot == max_faces) return -1;
    if (slot == face_count_) ++face_count_;
    Face& made = at(slot);
    made = {{a, b, c}, {-1, -1, -1}, (1.0 / area) * n, 0, true};
    made.distance = dot(made.normal, p);
    return slot;
}

bool Polytope::sees(const Face& f, Vec3d point) const {
    return dot(f.normal, point - vertex(f.vertices[0]).w) > -relative_plane * scale_;
}

// Removes the faces that see the point, walking over shared edges from `start`, which does. The
// edges to the faces that stay are gathered in order around the hole.
void Polytope::remove_seen(int start, Vec3d point) {
    struct Visit {
        int face, entry,
            next;  // the edge it was entered by, and how many edges have been looked at
    };
    std::array<Visit, max_faces> stack;
    int depth = 0;
    rim_count_ = 0;
    at(start).is_alive = false;
    stack[0] = {start, 0, 0};
    while (depth >= 0) {
        Visit& visit = stack[std::size_t(depth)];
        // The first face has three edges to cross, every other two: it was entered by the third.
        const int edges = depth == 0 ? 3 : 2;
        if (visit.next == edges) {
            --depth;
            continue;
        }
        const int k = (visit.entry + (depth == 0 ? 0 : 1) + visit.next++) % 3;
        const Face& from = face(visit.face);
        const int beyond = from.neighbors[k];
        if (!face(beyond).is_alive) continue;
        int back = 0;
        while (back < 2 && face(beyond).vertices[(back + 1) % 3] != from.vertices[k]) ++back;
        if (sees(face(beyond), point)) {
            at(beyond).is_alive = false;
            stack[std::size_t(++depth)] = {beyond, back, 0};
        } else if (rim_count_ < max_faces) {
            rim_[std::size_t(rim_count_++)] = {from.vertices[k], from.vertices[(k + 1) % 3], beyond,
                                               back};
        }
    }
}

// Joins the rim to the apex; false where it is no closed loop or a new face is degenerate.
bool Polytope::close_rim(int apex) {
    if (rim_count_ < 3) return false;
    int first = -1, previous = -1;
    for (int i = 0; i < rim_count_; ++i) {
        const RimEdge& edge = rim_[std::size_t(i)];
        if (edge.to != rim_[std::size_t((i + 1) % rim_count_)].from) return false;
        const int made = make_face(edge.from, edge.to, apex);
        if (made < 0) return false;
        at(made).neighbors[0] = edge.beyond;
        at(edge.beyond).neighbors[edge.slot] = made;
        if (previous >= 0) at(previous).neighbors[1] = made, at(made).neighbors[2] = previous;
        if (first < 0) first = made;
        previous = made;
    }
    at(previous).neighbors[1] = first, at(first).neighbors[2] = previous;
    return true;
}

bool Polytope::add(const MinkowskiPoint& point, int seen_from) {
    if (vertex_count_ == max_vertices) return false;
    const int apex = vertex_count_++;
    vertices_[std::size_t(apex)] = point;
    const double distance = length(point.w);
    if (distance > scale_) scale_ = distance;
    remove_seen(seen_from, point.w);
    return close_rim(apex);
}

}  // namespace cairn

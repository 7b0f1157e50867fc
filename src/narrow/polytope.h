#pragma once
// The polytope that EPA grows: triangles with their neighbours, closed and convex.

#include <array>

#include "narrow/minkowski.h"

namespace cairn {

class Polytope {
public:
    static constexpr int max_vertices = 68;
    static constexpr int max_faces = 2 * max_vertices;  // Euler: a closed surface has 2 V - 4

    // Counter-clockwise from outside; neighbors[k] lies across the edge from vertices[k] to the
    // next.
    struct Face {
        int vertices[3];
        int neighbors[3];
        Vec3d normal;         // unit, outward
        double distance = 0;  // from the origin along the normal
        bool is_alive = false;
    };

    // From a tetrahedron with some volume.
    explicit Polytope(const Simplex& tetrahedron);

    // The index of the face whose plane is nearest to the origin.
    int nearest_face() const;
    // Grows the hull by a point that face `seen_from` sees; false, and no longer to be grown, where
    // rounding leaves no closed rim or there is no more room.
    bool add(const MinkowskiPoint& point, int seen_from);

    const Face& face(int index) const { return faces_[std::size_t(index)]; }
    const MinkowskiPoint& vertex(int index) const { return vertices_[std::size_t(index)]; }
    bool has_vertex(const MinkowskiPoint& point) const;
    // The largest distance of a vertex from the origin: what tolerances are measured by.
    double scale() const { return scale_; }
    // A face's three points, without weights.
    Simplex triangle(int index) const;
    // The point of the faces at `distance`, within `tolerance`, that is nearest to the origin.
    Simplex nearest_triangle(double distance, double tolerance) const;

private:
    struct RimEdge {
        int from, to;  // the edge as the removed face ran it
        int beyond;    // the face that stays
        int slot;      // which of its edges this is
    };

    int make_face(int a, int b, int c);
    bool sees(const Face& face, Vec3d point) const;
    void remove_seen(int start, Vec3d point);
    bool close_rim(int apex);
    Face& at(int index) { return faces_[std::size_t(index)]; }

    std::array<MinkowskiPoint, max_vertices> vertices_;
    std::array<Face, max_faces> faces_;
    std::array<RimEdge, max_faces> rim_;
    int vertex_count_ = 0;
    int face_count_ = 0;  // slots in use, dead ones among them
    int rim_count_ = 0;
    double scale_ = 0;
};

}  // namespace cairn

// Clipping one face of a box against another; see clip_faces.h.
//
// Symbols: n from the subject to the other, c the other's centre from the subject's, m_s and m_o
// the outward normals of the two faces (m_s . n > 0, m_o . n < 0), u and v the edges of the other's
// face. Coordinates (p, q): the point p u + q v + w n, by the dual vectors d_u = v x n / (u . v x
// n) and d_v.

#include "contact/clip_faces.h"

#include <utility>

namespace cairn {
namespace {

// A vertex this part of the smaller face's half width outside a side is moved to it.
constexpr float relative_snap = 5e-3f;

struct Corner {
    float p = 0, q = 0;
    BoxFeature of_subject, of_other;
};

// A convex polygon can gain one corner at each of the four sides.
struct Corners {
    std::array<Corner, ClipPolygon::max_points> at;
    int count = 0;
    void push(const Corner& corner) {
        if (count < ClipPolygon::max_points) at[std::size_t(count++)] = corner;
    }
};

// One side of the other face: the coordinate (p or q) that it bounds and the one along it, the box
// axis that it lies across, its sign and bound.
struct Side {
    float Corner::*coordinate;
    float Corner::*along;
    int axis;
    std::int8_t sign;
    float bound;
};

// Where the polygon's edge from `in` to `out` crosses the side.
Corner cut_edge(const Corner& in, const Corner& out, const Side& side) {
    const float from = in.*side.coordinate, to = out.*side.coordinate;
    const float part = (side.bound - from) / (to - from);
    Corner cut;
    cut.*side.coordinate = side.bound;
    cut.*side.along = in.*side.along + part * (out.*side.along - in.*side.along);
    // What the ends share: an edge of the subject, or the side of the other that was cut before;
    // with this side, a crossing of edges or a vertex of the other over the subject's face.
    cut.of_subject = common_feature(in.of_subject, out.of_subject);
    cut.of_other = common_feature(in.of_other, out.of_other);
    cut.of_other.signs[side.axis] = side.sign;
    return cut;
}

// Cuts the polygon off at the side, into `kept`; false, and nothing done, where all of it is
// inside.
bool clip(Corners& polygon, const Side& side, float snap, Corners& kept) {
    const float sign = float(side.sign), bound = side.bound;
    std::array<bool, ClipPolygon::max_points> is_inside;
    bool all_inside = true;
    for (int i = 0; i < polygon.count; ++i) {
        Corner& corner = polygon.at[std::size_t(i)];
        const float beyond = sign * (corner.*side.coordinate - bound);
        is_inside[std::size_t(i)] = beyond <= snap;
        all_inside &= beyond <= snap;
        if (beyond > 0 && beyond <= snap) corner.*side.coordinate = bound;
    }
    if (all_inside) return false;
    kept.count = 0;
    for (int i = 0; i < polygon.count; ++i) {
        const int next = i + 1 == polygon.count ? 0 : i + 1;
        const Corner &a = polygon.at[std::size_t(i)], &b = polygon.at[std::size_t(next)];
        const bool a_in = is_inside[std::size_t(i)], b_in = is_inside[std::size_t(next)];
        if (a_in) kept.push(a);
        // A corner on the side itself is its own crossing.
        if (a_in && !b_in && a.*side.coordinate != bound) kept.push(cut_edge(a, b, side));
        if (!a_in && b_in && b.*side.coordinate != bound) kept.push(cut_edge(b, a, side));
    }
    return true;
}

BoxFeature feature_of(const BoxFace& face) {
    BoxFeature feature;
    feature.signs[face.axis] = face.sign < 0 ? -1 : 1;
    return feature;
}

// The half width of the face across its narrower direction.
float smallest_half_width(const PlacedBox& box, const BoxFace& face) {
    return min(component(box.half_extents, (face.axis + 1) % 3),
               component(box.half_extents, (face.axis + 2) % 3));
}

// The face's four vertices, in order around it.
Corners corners_of(const PlacedBox& box, const BoxFace& face, Vec3 d_u, Vec3 d_v) {
    const int k1 = (face.axis + 1) % 3, k2 = (face.axis + 2) % 3;
    constexpr std::int8_t turn[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    Corners corners;
    for (const auto& [sign1, sign2] : turn) {
        BoxFeature vertex = feature_of(face);
        vertex.signs[k1] = sign1, vertex.signs[k2] = sign2;
        const Vec3 signs = {float(vertex.signs[0]), float(vertex.signs[1]), float(vertex.signs[2])};
        const Vec3 position = box.axes * multiply(signs, box.half_extents);
        corners.push({dot(d_u, position), dot(d_v, position), vertex, {}});
    }
    return corners;
}

}  // namespace

BoxFace face_along(const PlacedBox& box, Vec3 n) {
    const Vec3 slope = multiply_transposed(box.axes, n);
    // A trifle of favour for the first axes, so that ties do not hang on rounding.
    constexpr float clearly = 1.0f + 1e-3f;
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
        if (absolute(component(slope, k)) > clearly * absolute(component(slope, axis))) axis = k;
    }
    return {axis, component(slope, axis) < 0 ? -1.0f : 1.0f};
}

ClipPolygon clip_faces(const PlacedBox& subject, const PlacedBox& other, Vec3 c, Vec3 n) {
    const BoxFace face_s = face_along(subject, n), face_o = face_along(other, -n);
    const int o1 = (face_o.axis + 1) % 3, o2 = (face_o.axis + 2) % 3;
    const Vec3 u = column(other.axes, o1), v = column(other.axes, o2);
    const float scale = 1.0f / dot(u, cross(v, n));
    const Vec3 d_u = scale * cross(v, n), d_v = scale * cross(n, u);
    const Vec3 m_s = face_s.sign * column(subject.axes, face_s.axis);
    const Vec3 m_o = face_o.sign * column(other.axes, face_o.axis);
    const float h_s = component(subject.half_extents, face_s.axis);
    const float h_o = component(other.half_extents, face_o.axis);

    // The subject's face, cut by the four sides that stand about the middle of the other's.
    Corners both[2] = {corners_of(subject, face_s, d_u, d_v), {}};
    Corners* corners = &both[0];
    Corners* spare = &both[1];
    const Vec3 middle = c + h_o * m_o;
    const float p = dot(d_u, middle), q = dot(d_v, middle);
    const float h1 = component(other.half_extents, o1), h2 = component(other.half_extents, o2);
    const float snap = relative_snap * min(min(h1, h2), smallest_half_width(subject, face_s));
    const BoxFeature face = feature_of(face_o);
    const Side sides[4] = {{&Corner::p, &Corner::q, o1, 1, p + h1},
                           {&Corner::p, &Corner::q, o1, -1, p - h1},
                           {&Corner::q, &Corner::p, o2, 1, q + h2},
                           {&Corner::q, &Corner::p, o2, -1, q - h2}};
    for (int i = 0; i < corners->count; ++i) corners->at[std::size_t(i)].of_other = face;
    for (const Side& side : sides) {
        if (clip(*corners, side, snap, *spare)) std::swap(corners, spare);
    }

    // Both faces' heights along n above the plane through the subject's centre along u and v.
    const float height_o = (dot(m_o, c) + h_o) / dot(m_o, n);
    const float steepness = 1.0f / dot(m_s, n);
    const float slope_p = dot(m_s, u) * steepness, slope_q = dot(m_s, v) * steepness;
    ClipPolygon polygon;
    polygon.other_p = dot(d_u, c), polygon.other_q = dot(d_v, c);
    for (int i = 0; i < corners->count; ++i) {
        const Corner& corner = corners->at[std::size_t(i)];
        const float height_s = h_s * steepness - corner.p * slope_p - corner.q * slope_q;
        ClipPoint& point = polygon.points[std::size_t(polygon.count++)];
        point.position = corner.p * u + corner.q * v + 0.5f * (height_s + height_o) * n;
        point.separation = height_o - height_s;
        point.p = corner.p, point.q = corner.q;
        point.of_subject = corner.of_subject, point.of_other = corner.of_other;
    }
    return polygon;
}

}  // namespace cairn

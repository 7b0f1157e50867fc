// Contact points from an axis; see build_manifold.h.
//
// What meets along the axis decides: a round shape touches in one point, a plane in the vertices of
// the box's lowest face. For two boxes the normal is compared with their edges: an edge across it
// lies along the contact, and two such make a face. A face on either side, or two that nearly face
// each other, gives the clipped polygon; parallel edges give the two ends of what they share; all
// else one point.
//
// A point's arms are worked from each shape's own centre or from the smaller one's, so that the
// smaller one's are exact to its own size.

#include "contact/build_manifold.h"

#include "contact/clip_faces.h"
#include "contact/feature.h"
#include "contact/reduce_points.h"
#include "shape/visit.h"

namespace cairn {
namespace {

// An edge within this angle of the contact plane, in radians, lies along it.
constexpr float along_contact = 1e-3f;
// Two faces whose normals are both within 3.6 degrees of the axis face each other.
constexpr float facing_cosine = 0.998f;
// Edges within this angle, in radians, are parallel.
constexpr float parallel_edges = 1e-2f;
// A box less than this part of the other's size is the smaller, to be measured from.
constexpr float clearly_smaller = 0.9f;

void push(Manifold& manifold, Vec3 from_a, Vec3 from_b, float separation, std::uint32_t feature) {
    manifold.points[std::size_t(manifold.point_count++)] = {from_a, from_b, separation, feature};
}

// The axis's own two witnesses, and the point halfway between them.
void push_witness(Manifold& manifold, const Axis& axis, std::uint32_t feature) {
    const Vec3 half_gap = 0.5f * axis.separation * axis.normal;
    push(manifold, axis.point_a + half_gap, axis.point_b - half_gap, axis.separation, feature);
}

// The vertices of the box's lowest face against a plane; `offset` leads from the plane's origin to
// the box's centre and `n` out of the plane.
void push_plane_box(Manifold& manifold, const PlacedBox& box, Vec3 offset, Vec3 n, bool plane_is_a,
                    float lowest, float max_separation) {
    const BoxFace face = face_along(box, -n);
    const Vec3 h = box.half_extents, slope = multiply_transposed(box.axes, n);
    constexpr std::int8_t turn[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    for (const auto& [sign1, sign2] : turn) {
        BoxFeature vertex;
        vertex.signs[face.axis] = face.sign < 0 ? -1 : 1;
        vertex.signs[(face.axis + 1) % 3] = sign1, vertex.signs[(face.axis + 2) % 3] = sign2;
        // From the lowest vertex, each edge climbed adds its own rise.
        Vec3 corner;
        float separation = lowest;
        for (int k = 0; k < 3; ++k) {
            const float along = float(vertex.signs[k]) * component(h, k);
            set_component(corner, k, along);
            const float rise = component(slope, k) * along;
            if (rise > 0) separation += 2 * rise;
        }
        if (!(separation <= max_separation)) continue;
        const Vec3 from_box = box.axes * corner - 0.5f * separation * n;
        const Vec3 from_plane = offset + from_box;
        const std::uint32_t code = feature_code(vertex);
        push(manifold, plane_is_a ? from_plane : from_box, plane_is_a ? from_box : from_plane,
             separation, plane_is_a ? feature_pair(0, code) : feature_pair(code, 0));
    }
}

// The feature of the box that is farthest along n, and how many of its axes lie along the contact.
struct Extreme {
    BoxFeature feature;
    Vec3 center;  // the feature's middle, from the box's centre
    int level_count = 0;
    int level_axis = 0;  // the one, where there is one
    float facing = 0;    // the cosine between n and the face most along it
};

Extreme find_extreme(const PlacedBox& box, Vec3 n) {
    Extreme extreme;
    const Vec3 slope = multiply_transposed(box.axes, n);
    Vec3 local;
    for (int k = 0; k < 3; ++k) {
        const float s = component(slope, k);
        extreme.facing = max(extreme.facing, absolute(s));
        if (absolute(s) <= along_contact) {
            ++extreme.level_count;
            extreme.level_axis = k;
            continue;
        }
        extreme.feature.signs[k] = s < 0 ? -1 : 1;
        set_component(local, k,
                      s < 0 ? -component(box.half_extents, k) : component(box.half_extents, k));
    }
    extreme.center = box.axes * local;
    return extreme;
}

float size_of(const PlacedBox& box) {
    return box.half_extents.x + box.half_extents.y + box.half_extents.z;
}

// The clipped polygon, its points within reach, at most four of them.
void push_faces(Manifold& manifold, const PlacedBox& a, const PlacedBox& b, Vec3 t,
                float max_separation) {
    const bool a_is_subject = size_of(a) < clearly_smaller * size_of(b);
    const Vec3 n = manifold.normal;
    ClipPolygon polygon = a_is_subject ? clip_faces(a, b, t, n) : clip_faces(b, a, -t, -n);
    int kept = 0;
    for (int i = 0; i < polygon.count; ++i) {
        const ClipPoint point = polygon.points[std::size_t(i)];
        if (point.separation <= max_separation) polygon.points[std::size_t(kept++)] = point;
    }
    polygon.count = kept;
    reduce_points(polygon);
    for (int i = 0; i < polygon.count; ++i) {
        const ClipPoint& point = polygon.points[std::size_t(i)];
        const std::uint32_t subject = feature_code(point.of_subject),
                            other = feature_code(point.of_other);
        if (a_is_subject) {
            push(manifold, point.position, point.position - t, point.separation,
                 feature_pair(subject, other));
        } else {
            push(manifold, point.position + t, point.position, point.separation,
                 feature_pair(other, subject));
        }
    }
}

// Two parallel edges: the ends of the stretch that they share, each named after the vertex there.
// False where they share none.
bool push_parallel_edges(Manifold& manifold, const PlacedBox& a, const Extreme& on_a,
                         const PlacedBox& b, const Extreme& on_b, Vec3 t, float separation) {
    const Vec3 e = a.axes * unit_axis(on_a.level_axis);
    Vec3 u = b.axes * unit_axis(on_b.level_axis);
    if (length_squared(cross(e, u)) > parallel_edges * parallel_edges) return false;
    const float turn = dot(e, u) < 0 ? -1.0f : 1.0f;
    u = turn * u;
    const float half_a = component(a.half_extents, on_a.level_axis);
    const float half_b = component(b.half_extents, on_b.level_axis);
    // Along e, A's edge spans -half_a to half_a and B's middle lies at shift.
    const float shift = dot(e, t + on_b.center - on_a.center);
    if (absolute(shift) >= half_a + half_b) return false;
    const Vec3 half_gap = 0.5f * separation * manifold.normal;
    for (const std::int8_t sign : {std::int8_t(-1), std::int8_t(1)}) {
        const float end_a = float(sign) * half_a, end_b = shift + float(sign) * half_b;
        const bool ends_on_a = sign < 0 ? end_a > end_b : end_a < end_b;
        BoxFeature feature_a = on_a.feature, feature_b = on_b.feature;
        if (ends_on_a) feature_a.signs[on_a.level_axis] = sign;
        if (!ends_on_a) feature_b.signs[on_b.level_axis] = turn < 0 ? std::int8_t(-sign) : sign;
        const float along_a = ends_on_a ? end_a : end_b;
        const float along_b = ends_on_a ? end_a - shift : float(sign) * half_b;
        push(manifold, on_a.center + along_a * e + half_gap, on_b.center + along_b * u - half_gap,
             separation, feature_pair(feature_code(feature_a), feature_code(feature_b)));
    }
    return true;
}

void push_box_box(Manifold& manifold, const PlacedBox& a, const PlacedBox& b, Vec3 t,
                  const Axis& axis, float max_separation) {
    const Extreme on_a = find_extreme(a, axis.normal), on_b = find_extreme(b, -axis.normal);
    const bool has_face = on_a.level_count == 2 || on_b.level_count == 2;
    const bool face_each_other = on_a.facing > facing_cosine && on_b.facing > facing_cosine;
    if (has_face || face_each_other) {
        push_faces(manifold, a, b, t, max_separation);
        if (manifold.point_count > 0) return;
    } else if (on_a.level_count == 1 && on_b.level_count == 1 &&
               push_parallel_edges(manifold, a, on_a, b, on_b, t, axis.separation)) {
        return;
    }
    push_witness(manifold, axis,
                 feature_pair(feature_code(on_a.feature), feature_code(on_b.feature)));
}

}  // namespace

Manifold build_manifold(const Geometry& a, const Geometry& b, const Pose& b_in_a, const Axis& axis,
                        float max_separation) {
    Manifold manifold;
    manifold.normal = axis.normal;
    if (!(axis.separation <= max_separation)) return manifold;
    const Box* box_a = std::get_if<Box>(&a);
    const Box* box_b = std::get_if<Box>(&b);
    const Vec3 t = b_in_a.position;
    if (box_a && box_b) {
        push_box_box(manifold, {box_a->half_extents, Mat3{}},
                     {box_b->half_extents, to_matrix(b_in_a.rotation)}, t, axis, max_separation);
    } else if (box_b && kind_of(a) == ShapeKind::Plane) {
        push_plane_box(manifold, {box_b->half_extents, to_matrix(b_in_a.rotation)}, t, axis.normal,
                       true, axis.separation, max_separation);
    } else if (box_a && kind_of(b) == ShapeKind::Plane) {
        push_plane_box(manifold, {box_a->half_extents, Mat3{}}, -t, -axis.normal, false,
                       axis.separation, max_separation);
    } else {
        push_witness(manifold, axis, 0);
    }
    return manifold;
}

}  // namespace cairn

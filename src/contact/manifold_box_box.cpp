// The contact points of two boxes; see manifold_box_box.h.
//
// The normal is compared with the boxes' edges: an edge across it lies along the contact, and two
// such make a face. A face on either side, or two that nearly face each other, gives the clipped
// polygon; parallel edges give the two ends of what they share; all else one point.
//
// Symbols: n the normal along A's axes, m the same along B's; both from A to B.

#include "contact/manifold_box_box.h"

#include "contact/clip_faces.h"
#include "contact/feature.h"
#include "contact/reduce_points.h"

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

// How many of a box's edges lie along the contact; `slope` is the normal along its axes.
int count_level(Three slope) {
    const Three s = absolute(slope);
    return (s[0] <= along_contact) + (s[1] <= along_contact) + (s[2] <= along_contact);
}

// The clipped polygon, its points within reach, at most four of them.
void push_faces(Manifold& manifold, const BoxPair& pair, Three n, Three m, float max_separation) {
    // The smaller box is the subject, so that its arms are exact to its own size.
    const bool b_is_first = sum(pair.h_a) < clearly_smaller * sum(pair.h_b);
    ClipPolygon polygon =
        b_is_first
            ? clip_faces(seen_from_b(pair), -m, -n, FaceOwner::B, FaceOwner::A, max_separation)
            : clip_faces(pair, n, m, FaceOwner::A, FaceOwner::B, max_separation);
    reduce_points(polygon);

    // Along A's axes again.
    const int k1 = (polygon.axis + 1) % 3, k2 = (polygon.axis + 2) % 3;
    const Three u = b_is_first ? pair.axes_b[k1] : unit_three(k1);
    const Three v = b_is_first ? pair.axes_b[k2] : unit_three(k2);
    const Three up = b_is_first ? -n : n;
    const Three to_a = b_is_first ? Three{} : pair.t, to_b = b_is_first ? -pair.t : Three{};
    for (int i = 0; i < polygon.count; ++i) {
        const float height = polygon.height + 0.5f * polygon.separation[i];
        const Three position = polygon.p[i] * u + polygon.q[i] * v + height * up;
        push_point(manifold, {vec3(position + to_a), vec3(position + to_b), polygon.separation[i],
                              polygon.feature[i]});
    }
}

// The feature of a box that is farthest along a direction.
struct Extreme {
    Three center = {};  // the feature's middle, from the box's centre, along the box's axes
    std::uint32_t faces = 0;
    int level_axis = 0;  // the one whose edge lies along the contact, where there is one
};

Extreme find_extreme(Three slope, Three half_extents, FaceOwner owner) {
    Extreme extreme;
    for (int k = 0; k < 3; ++k) {
        if (absolute(slope[k]) <= along_contact) {
            extreme.level_axis = k;
            continue;
        }
        extreme.faces |= face_bit(owner, k, slope[k]);
        extreme.center[k] = slope[k] < 0 ? -half_extents[k] : half_extents[k];
    }
    return extreme;
}

// Two parallel edges: the ends of the stretch that they share, each named after the vertex there.
// False where they share none.
bool push_parallel_edges(Manifold& manifold, const BoxPair& pair, const Extreme& on_a,
                         const Extreme& on_b, Three n, float separation) {
    const Three e = unit_three(on_a.level_axis);
    const Three u = pair.axes_b[on_b.level_axis], across = cross(e, u);
    if (dot(across, across) > parallel_edges * parallel_edges) return false;
    const Three center_b = along_a(pair, on_b.center);
    const float half_a = pair.h_a[on_a.level_axis];
    const float half_b = pair.h_b[on_b.level_axis];
    const float turn = dot(e, u) < 0 ? -1.0f : 1.0f;
    // Along e, A's edge spans -half_a to half_a and B's middle lies at shift.
    const float shift = dot(e, pair.t + center_b - on_a.center);
    if (absolute(shift) >= half_a + half_b) return false;
    const Three half_gap = 0.5f * separation * n;
    for (const float sign : {-1.0f, 1.0f}) {
        const float end_a = sign * half_a, end_b = shift + sign * half_b;
        const bool ends_on_a = sign < 0 ? end_a > end_b : end_a < end_b;
        const std::uint32_t end = ends_on_a ? face_bit(FaceOwner::A, on_a.level_axis, sign)
                                            : face_bit(FaceOwner::B, on_b.level_axis, turn * sign);
        const float from_a = ends_on_a ? end_a : end_b;
        const float from_b = ends_on_a ? end_a - shift : sign * half_b;
        push_point(manifold, {vec3(on_a.center + from_a * e + half_gap),
                              vec3(center_b + from_b * (turn * u) - half_gap), separation,
                              on_a.faces | on_b.faces | end});
    }
    return true;
}

}  // namespace

void push_box_box(Manifold& manifold, const BoxPair& pair, const Axis& axis, float max_separation) {
    const Three n = three(axis.normal), m = along_b(pair, n);
    const int level_a = count_level(n), level_b = count_level(m);
    const bool face_each_other =
        largest(absolute(n)) > facing_cosine && largest(absolute(m)) > facing_cosine;
    if (level_a == 2 || level_b == 2 || face_each_other) {
        push_faces(manifold, pair, n, m, max_separation);
        if (manifold.point_count > 0) return;
    }
    const Extreme on_a = find_extreme(n, pair.h_a, FaceOwner::A);
    const Extreme on_b = find_extreme(-m, pair.h_b, FaceOwner::B);
    const bool has_edges = level_a == 1 && level_b == 1 && !face_each_other;
    if (has_edges && push_parallel_edges(manifold, pair, on_a, on_b, n, axis.separation)) return;
    push_witness(manifold, axis, on_a.faces | on_b.faces);
}

}  // namespace cairn

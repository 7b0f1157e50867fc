// The pair table and the thin functions in it: they take the shapes out of their variants, place
// them along A's axes, and turn the answer round where a closed form has the pair in the other
// order.

#include "narrow/pair_table.h"

#include <limits>

#include "narrow/axis_box_box.h"
#include "narrow/closed_forms.h"
#include "narrow/find_axis.h"

namespace cairn {
namespace {

template <class Shape>
const Shape& get(const Geometry& geometry) {
    return *std::get_if<Shape>(&geometry);
}

// The same axis from B's side, still along A's axes.
Axis turned_round(const Axis& axis) {
    return {-axis.normal, axis.separation, axis.point_b, axis.point_a};
}

Axis sphere_sphere(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase,
                   AxisHint&) {
    return find_axis_sphere_sphere(get<Sphere>(a), get<Sphere>(b), b_in_a.position);
}

Axis box_sphere(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase, AxisHint&) {
    return find_axis_box_sphere(get<Box>(a), Mat3{}, get<Sphere>(b), b_in_a.position);
}
Axis sphere_box(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase, AxisHint&) {
    const Mat3 axes = to_matrix(b_in_a.rotation);
    return turned_round(find_axis_box_sphere(get<Box>(b), axes, get<Sphere>(a), -b_in_a.position));
}

// How far a point at `offset` from the plane's origin lies above its surface.
float height_above(const Plane& plane, Vec3 normal, Vec3 offset) {
    return dot(normal, offset) - plane.offset;
}

Axis plane_sphere(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase,
                  AxisHint&) {
    const Plane& plane = get<Plane>(a);
    const float height = height_above(plane, plane.normal, b_in_a.position);
    return find_axis_plane_sphere(plane.normal, height, b_in_a.position, get<Sphere>(b));
}
Axis sphere_plane(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase,
                  AxisHint&) {
    const Plane& plane = get<Plane>(b);
    const Vec3 normal = rotate(b_in_a.rotation, plane.normal), offset = -b_in_a.position;
    const float height = height_above(plane, normal, offset);
    return turned_round(find_axis_plane_sphere(normal, height, offset, get<Sphere>(a)));
}

Axis plane_box(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase, AxisHint&) {
    const Plane& plane = get<Plane>(a);
    const float height = height_above(plane, plane.normal, b_in_a.position);
    return find_axis_plane_box(plane.normal, height, b_in_a.position, get<Box>(b),
                               to_matrix(b_in_a.rotation));
}
Axis box_plane(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase, AxisHint&) {
    const Plane& plane = get<Plane>(b);
    const Vec3 normal = rotate(b_in_a.rotation, plane.normal), offset = -b_in_a.position;
    const float height = height_above(plane, normal, offset);
    return turned_round(find_axis_plane_box(normal, height, offset, get<Box>(a), Mat3{}));
}

Axis box_box(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase method,
             AxisHint& hint) {
    Axis axis;
    find_axis_box_box(make_box_pair(get<Box>(a), get<Box>(b), b_in_a), method, everywhere, hint,
                      axis);
    return axis;
}

// Which way a capsule lies, turned by a pose.
Vec3 capsule_axis(const Pose& pose) { return to_matrix(pose.rotation).y; }
constexpr Vec3 own_axis = {0, 1, 0};

Axis capsule_sphere(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase,
                    AxisHint&) {
    return find_axis_capsule_sphere(get<Capsule>(a), own_axis, get<Sphere>(b), b_in_a.position);
}
Axis sphere_capsule(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase,
                    AxisHint&) {
    return turned_round(find_axis_capsule_sphere(get<Capsule>(b), capsule_axis(b_in_a),
                                                 get<Sphere>(a), -b_in_a.position));
}

Axis capsule_capsule(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase,
                     AxisHint&) {
    return find_axis_capsule_capsule(get<Capsule>(a), own_axis, get<Capsule>(b),
                                     capsule_axis(b_in_a), b_in_a.position);
}

Axis plane_capsule(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase,
                   AxisHint&) {
    const Plane& plane = get<Plane>(a);
    const float height = height_above(plane, plane.normal, b_in_a.position);
    return find_axis_plane_capsule(plane.normal, height, b_in_a.position, get<Capsule>(b),
                                   capsule_axis(b_in_a));
}
Axis capsule_plane(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase,
                   AxisHint&) {
    const Plane& plane = get<Plane>(b);
    const Vec3 normal = rotate(b_in_a.rotation, plane.normal), offset = -b_in_a.position;
    const float height = height_above(plane, normal, offset);
    return turned_round(find_axis_plane_capsule(normal, height, offset, get<Capsule>(a), own_axis));
}

Axis box_capsule(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase, AxisHint&) {
    return find_axis_box_capsule(get<Box>(a), Mat3{}, get<Capsule>(b), capsule_axis(b_in_a),
                                 b_in_a.position);
}
Axis capsule_box(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase, AxisHint&) {
    return turned_round(find_axis_box_capsule(get<Box>(b), to_matrix(b_in_a.rotation),
                                              get<Capsule>(a), own_axis, -b_in_a.position));
}

// Two half-spaces are never moved against each other.
Axis plane_plane(const Geometry&, const Geometry&, const Pose&, NarrowPhase, AxisHint&) {
    Axis apart;
    apart.separation = std::numeric_limits<float>::max();
    return apart;
}

using Row = std::array<FindAxis, shape_kind_count>;

// Rows are A's kind, columns B's, both in the order of ShapeKind.
constexpr std::array<Row, shape_kind_count> pair_table = {{
    {sphere_sphere, sphere_box, sphere_plane, sphere_capsule},
    {box_sphere, box_box, box_plane, box_capsule},
    {plane_sphere, plane_box, plane_plane, plane_capsule},
    {capsule_sphere, capsule_box, capsule_plane, capsule_capsule},
}};

constexpr bool has_no_hole() {
    for (const Row& row : pair_table)
        for (FindAxis entry : row)
            if (entry == nullptr) return false;
    return true;
}
static_assert(has_no_hole(), "every pair of kinds needs its function");

}  // namespace

FindAxis axis_finder(ShapeKind a, ShapeKind b) {
    return pair_table[std::size_t(a)][std::size_t(b)];
}

Axis find_axis(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase method,
               AxisHint& hint) {
    return axis_finder(kind_of(a), kind_of(b))(a, b, b_in_a, method, hint);
}

}  // namespace cairn

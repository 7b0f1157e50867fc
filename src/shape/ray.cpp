// Rays and distances in closed form; see ray.h.
//
// Symbols: o origin, d unit direction, t distance along the ray, h half extents, r radius.
//
// A capsule is entered by its side or by the end beyond which the ray comes into the endless
// cylinder about it.

#include "shape/ray.h"

#include <limits>

#include "shape/visit.h"

namespace cairn {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double absolute(double x) { return x < 0 ? -x : x; }

// The components side by side, for loops over the axes.
struct Axes {
    double of[3];
    explicit Axes(Vec3d v) : of{v.x, v.y, v.z} {}
    explicit Axes(Vec3 v) : of{double(v.x), double(v.y), double(v.z)} {}
    double operator[](int k) const { return of[k]; }
};

Vec3d signed_axis(int k, double sign) {
    return {k == 0 ? sign : 0, k == 1 ? sign : 0, k == 2 ? sign : 0};
}

bool begin_inside(const ShapeRay& ray, ShapeHit& hit) {
    hit = {0, -ray.direction, true};
    return true;
}

bool cast_at_sphere(const Sphere& sphere, const ShapeRay& ray, ShapeHit& hit) {
    const Vec3d o = ray.origin, d = ray.direction;
    const double r = double(sphere.radius), along = dot(o, d), excess = dot(o, o) - r * r;
    if (excess < 0) return begin_inside(ray, hit);
    if (along >= 0) return false;
    // The point of the line that is nearest to the centre.
    const Vec3d nearest = o - along * d;
    const double half_chord_squared = r * r - dot(nearest, nearest);
    if (half_chord_squared < 0) return false;
    const double half_chord = square_root(half_chord_squared);
    const double t = excess == 0 ? 0 : -along - half_chord;
    hit.distance = t < 0 ? 0 : t;
    if (!(hit.distance <= ray.length)) return false;
    const Vec3d outward = nearest - half_chord * d;
    hit.normal = (1 / length(outward)) * outward;
    hit.inside = false;
    return true;
}

// Where the ray is on its way between the two faces across each axis: it is in the box while it is
// between all.
bool cast_at_box(const Box& box, const ShapeRay& ray, ShapeHit& hit) {
    const Axes o(ray.origin), d(ray.direction), h(box.half_extents);
    double enter = -infinite, leave = infinite;
    int face = 0, strictly_within = 0;
    bool slides_or_leaves = false;
    for (int k = 0; k < 3; ++k) {
        const double depth = h[k] - absolute(o[k]);
        strictly_within += depth > 0 ? 1 : 0;
        slides_or_leaves |= depth == 0 && o[k] * d[k] >= 0;
        if (d[k] == 0) {
            if (depth < 0) return false;
            continue;
        }
        const double inverse = 1 / d[k], reach = d[k] < 0 ? -h[k] : h[k];
        const double t_in = (-reach - o[k]) * inverse, t_out = (reach - o[k]) * inverse;
        if (t_in > enter) enter = t_in, face = k;
        if (t_out < leave) leave = t_out;
    }
    if (strictly_within == 3) return begin_inside(ray, hit);
    if (enter > leave || leave < 0 || !(enter <= ray.length)) return false;
    // On the surface the entry is no later than the origin.
    if (enter <= 0 && slides_or_leaves) return false;
    hit.distance = enter < 0 ? 0 : enter;
    hit.normal = signed_axis(face, d[face] < 0 ? 1 : -1);
    hit.inside = false;
    return true;
}

// From a point to the capsule's core, a segment along y.
Vec3d from_core(double half, Vec3d point) {
    const double y = point.y;
    return {point.x, y < -half ? y + half : y > half ? y - half : 0, point.z};
}

bool cast_at_capsule(const Capsule& capsule, const ShapeRay& ray, ShapeHit& hit) {
    const Vec3d o = ray.origin, d = ray.direction;
    const double r = double(capsule.radius), half = 0.5 * double(capsule.height);
    const Vec3d out = from_core(half, o);
    const double excess = dot(out, out) - r * r;
    if (excess < 0) return begin_inside(ray, hit);
    if (excess == 0) {
        if (dot(out, d) >= 0) return false;
        hit = {0, (1 / length(out)) * out, false};
        return true;
    }
    // Where the ray comes into the cylinder, and how high that is.
    const double across = d.x * d.x + d.z * d.z;
    double height = d.y < 0 ? infinite : -infinite;
    if (across > 0) {
        const double along = (o.x * d.x + o.z * d.z) / across;
        const Vec3d nearest = {o.x - along * d.x, 0, o.z - along * d.z};
        const double half_chord_squared = (r * r - dot(nearest, nearest)) / across;
        if (half_chord_squared < 0) return false;
        const double half_chord = square_root(half_chord_squared);
        const double t = -along - half_chord;
        height = o.y + t * d.y;
        if (absolute(height) <= half) {
            if (t < 0 || !(t <= ray.length)) return false;
            const Vec3d outward = {nearest.x - half_chord * d.x, 0, nearest.z - half_chord * d.z};
            hit = {t, (1 / length(outward)) * outward, false};
            return true;
        }
    }
    const Vec3d end = {0, height < 0 ? -half : half, 0};
    return cast_at_sphere(Sphere{capsule.radius}, {o - end, d, ray.length}, hit);
}

bool cast_at_plane(const Plane& plane, const ShapeRay& ray, ShapeHit& hit) {
    const Vec3d n = widen(plane.normal);
    const double height = dot(n, ray.origin) - double(plane.offset);
    const double slope = dot(n, ray.direction);
    if (height < 0) return begin_inside(ray, hit);
    if (slope >= 0) return false;
    hit.distance = height / -slope;
    if (!(hit.distance <= ray.length)) return false;
    hit.normal = (1 / length(n)) * n;
    hit.inside = false;
    return true;
}

NearestPoint find_nearest_of_sphere(const Sphere& sphere, Vec3d point) {
    const double distance = length(point);
    const Vec3d normal = distance > 0 ? (1 / distance) * point : Vec3d{0, 1, 0};
    return {distance - double(sphere.radius), normal};
}

NearestPoint find_nearest_of_box(const Box& box, Vec3d point) {
    const Axes p(point), h(box.half_extents);
    double outward[3];
    double squared = 0, largest = -infinite;
    int face = 0;
    for (int k = 0; k < 3; ++k) {
        const double excess = absolute(p[k]) - h[k];
        outward[k] = excess > 0 ? (p[k] < 0 ? -excess : excess) : 0;
        squared += outward[k] * outward[k];
        if (excess > largest) largest = excess, face = k;
    }
    if (!(squared > 0)) return {largest, signed_axis(face, p[face] < 0 ? -1 : 1)};
    const double distance = square_root(squared);
    return {distance, {outward[0] / distance, outward[1] / distance, outward[2] / distance}};
}

NearestPoint find_nearest_of_capsule(const Capsule& capsule, Vec3d point) {
    const Vec3d out = from_core(0.5 * double(capsule.height), point);
    const double distance = length(out);
    const Vec3d normal = distance > 0 ? (1 / distance) * out : Vec3d{1, 0, 0};
    return {distance - double(capsule.radius), normal};
}

NearestPoint find_nearest_of_plane(const Plane& plane, Vec3d point) {
    const Vec3d n = widen(plane.normal);
    const double scale = 1 / length(n);
    return {scale * (dot(n, point) - double(plane.offset)), scale * n};
}

}  // namespace

bool cast_ray(const Geometry& geometry, const ShapeRay& ray, ShapeHit& hit) {
    return visit_shape(
        geometry, [&](const Sphere& sphere) { return cast_at_sphere(sphere, ray, hit); },
        [&](const Box& box) { return cast_at_box(box, ray, hit); },
        [&](const Plane& plane) { return cast_at_plane(plane, ray, hit); },
        [&](const Capsule& capsule) { return cast_at_capsule(capsule, ray, hit); });
}

NearestPoint find_nearest_point(const Geometry& geometry, Vec3d point) {
    return visit_shape(
        geometry, [&](const Sphere& sphere) { return find_nearest_of_sphere(sphere, point); },
        [&](const Box& box) { return find_nearest_of_box(box, point); },
        [&](const Plane& plane) { return find_nearest_of_plane(plane, point); },
        [&](const Capsule& capsule) { return find_nearest_of_capsule(capsule, point); });
}

}  // namespace cairn

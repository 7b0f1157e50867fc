// The ruler's geometry. Symbols: n an axis, d the way from a's center to b's along it, r the reach
// of a shape from its center along it; overlap along n is r_a + r_b - |d|.
//
// Source: Gottschalk, Lin, Manocha, OBBTree (1996), for the fifteen axes.

#include "overlap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::bench {

namespace {

Vector subtract(const Vector& a, const Vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double reach(const PlacedPart& box, const Vector& n) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += box.half_extents[i] * std::abs(dot(box.axes[i], n));
    return sum;
}

double overlap_boxes(const PlacedPart& a, const PlacedPart& b) {
    const Vector d = subtract(b.center, a.center);
    double least = std::numeric_limits<double>::infinity();
    // Whether the boxes still overlap, along this axis too.
    const auto meet_along = [&](const Vector& axis) {
        const double length = std::sqrt(dot(axis, axis));
        // Edges that are parallel add nothing to the faces' axes.
        if (length < 1e-9) return true;
        const Vector n = {axis[0] / length, axis[1] / length, axis[2] / length};
        least = std::min(least, reach(a, n) + reach(b, n) - std::abs(dot(d, n)));
        return least > 0;
    };
    for (const PlacedPart* box : {&a, &b}) {
        for (const Vector& axis : box->axes) {
            if (!meet_along(axis)) return 0;
        }
    }
    for (const Vector& edge_a : a.axes) {
        for (const Vector& edge_b : b.axes) {
            if (!meet_along(cross(edge_a, edge_b))) return 0;
        }
    }
    return least;
}

double overlap_box_sphere(const PlacedPart& box, const PlacedPart& sphere) {
    const Vector d = subtract(sphere.center, box.center);
    double outside = 0;  // squared distance from the box
    double inside = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const double depth = box.half_extents[i] - std::abs(dot(d, box.axes[i]));
        if (depth < 0) outside += depth * depth;
        inside = std::min(inside, depth);
    }
    return std::max(0.0, inside > 0 ? sphere.radius + inside : sphere.radius - std::sqrt(outside));
}

}  // namespace

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector turn(const Rotation& q, const Vector& v) {
    const Vector u = {q[0], q[1], q[2]};
    const Vector t = cross(u, v);
    const Vector s = cross(u, t);
    Vector turned = v;
    for (std::size_t i = 0; i < 3; ++i) turned[i] += 2 * (q[3] * t[i] + s[i]);
    return turned;
}

PlacedPart place_part(const Part& part, const Vector& position, const Rotation& rotation) {
    // Engines in binary32 hand out rotations that are a few parts in 10^7 off unit length.
    double square = 0;
    for (const double component : rotation) square += component * component;
    Rotation q = rotation;
    for (double& component : q) component /= std::sqrt(square);

    PlacedPart placed{.form = part.form,
                      .center = position,
                      .axes = {},
                      .half_extents = part.half_extents,
                      .radius = part.radius};
    const Vector offset = turn(q, part.position);
    for (std::size_t i = 0; i < 3; ++i) {
        placed.center[i] += offset[i];
        Vector axis = {};
        axis[i] = 1;
        placed.axes[i] = turn(q, turn(part.rotation, axis));
    }
    return placed;
}

double measure_overlap(const PlacedPart& a, const PlacedPart& b) {
    if (a.form == Form::Box && b.form == Form::Box) return overlap_boxes(a, b);
    if (a.form == Form::Box) return overlap_box_sphere(a, b);
    if (b.form == Form::Box) return overlap_box_sphere(b, a);
    const Vector d = subtract(b.center, a.center);
    return std::max(0.0, a.radius + b.radius - std::sqrt(dot(d, d)));
}

Vector bound_part(const PlacedPart& part) {
    if (part.form == Form::Sphere) return {part.radius, part.radius, part.radius};
    return {reach(part, {1, 0, 0}), reach(part, {0, 1, 0}), reach(part, {0, 0, 1})};
}

}  // namespace cairn::bench

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

double distance_from_box(const PlacedPart& box, const Vector& point) {
    const Vector d = subtract(point, box.center);
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double outside = std::abs(dot(d, box.axes[i])) - box.half_extents[i];
        if (outside > 0) square += outside * outside;
    }
    return std::sqrt(square);
}

// The point of the core at t from -1 to 1.
Vector core_point(const PlacedPart& part, double t) {
    Vector p = part.center;
    for (std::size_t i = 0; i < 3; ++i) p[i] += t * part.half_extents[1] * part.axes[1][i];
    return p;
}

// The least of a function of t that falls, then rises.
template <class Function>
double find_least(const Function& function) {
    double low = -1, high = 1;
    for (int i = 0; i < 80; ++i) {
        const double first = low + (high - low) / 3, second = high - (high - low) / 3;
        (function(first) < function(second) ? high : low) =
            function(first) < function(second) ? second : first;
    }
    return function(0.5 * (low + high));
}

double overlap_box_capsule(const PlacedPart& box, const PlacedPart& capsule) {
    const double core = overlap_boxes(box, capsule);
    if (core > 0) return core + capsule.radius;
    const double distance =
        find_least([&](double t) { return distance_from_box(box, core_point(capsule, t)); });
    return std::max(0.0, capsule.radius - distance);
}

// Balls are capsules whose core is a point.
double overlap_round(const PlacedPart& a, const PlacedPart& b) {
    const auto from_b = [&](const Vector& p) {
        const Vector d = subtract(p, b.center);
        const double half = b.half_extents[1];
        const double along = std::clamp(dot(d, b.axes[1]), -half, half);
        const double square = dot(d, d) - along * (2 * dot(d, b.axes[1]) - along);
        return std::sqrt(std::max(0.0, square));
    };
    const double distance = a.form == Form::Capsule
                                ? find_least([&](double t) { return from_b(core_point(a, t)); })
                                : from_b(a.center);
    return std::max(0.0, a.radius + b.radius - distance);
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

    PlacedPart placed{
        .form = part.form,
        .center = position,
        .axes = {},
        .half_extents = part.form == Form::Box ? part.half_extents : Vector{0, part.half_height, 0},
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
    if (b.form == Form::Box) return measure_overlap(b, a);
    if (a.form == Form::Box)
        return b.form == Form::Sphere ? overlap_box_sphere(a, b) : overlap_box_capsule(a, b);
    return overlap_round(a, b);
}

Vector bound_part(const PlacedPart& part) {
    const double r = part.form == Form::Box ? 0 : part.radius;
    return {reach(part, {1, 0, 0}) + r, reach(part, {0, 1, 0}) + r, reach(part, {0, 0, 1}) + r};
}

}  // namespace cairn::bench

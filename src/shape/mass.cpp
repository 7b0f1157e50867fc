// Mass properties in closed form, worked in binary64 and rounded once.
//
//   sphere   m = rho 4/3 pi r^3    I = 2/5 m r^2
//   box      m = rho 8 a b c       Ixx = m/3 (b^2 + c^2), a, b, c half extents
//   capsule  c = rho pi r^2 h, s = rho 4/3 pi r^3, m = c + s: cylinder and caps
//                                  Iyy = c r^2/2 + s 2/5 r^2
//                                  Ixx = Izz = c (h^2/12 + r^2/4) + s (2/5 r^2 + h^2/4 + 3/8 h r)
//
// Several shapes: the center of mass is the weighted mean; each tensor is turned into the body's
// frame and moved to the common center by the parallel axis theorem, I + m (|d|^2 1 - d d^T).
// Departure from the textbook: the tensors are moved to the common center, never through the
// origin, so nothing cancels for a body whose shapes lie far from its origin.

#include "shape/mass.h"

#include <array>
#include <numbers>

#include "math/scalar.h"
#include "shape/visit.h"

namespace cairn {
namespace {

using Row = std::array<double, 3>;

// A solid's mass and its principal moments about its own center, along its own axes.
struct Solid {
    double mass = 0;
    Row moments = {};
};

Solid solid_of(const ShapeDef& shape) {
    const double density = shape.density;
    return visit_shape(
        shape.geometry,
        [&](const Sphere& s) {
            const double r = s.radius, mass = density * (4.0 / 3.0) * std::numbers::pi * r * r * r;
            const double moment = 0.4 * mass * r * r;
            return Solid{mass, {moment, moment, moment}};
        },
        [&](const Box& box) {
            const double a = box.half_extents.x, b = box.half_extents.y, c = box.half_extents.z;
            const double mass = density * 8.0 * a * b * c, third = mass / 3.0;
            return Solid{
                mass, {third * (b * b + c * c), third * (a * a + c * c), third * (a * a + b * b)}};
        },
        [&](const Capsule& capsule) {
            const double r = capsule.radius, h = capsule.height;
            const double disc = density * std::numbers::pi * r * r;
            const double cylinder = disc * h, caps = disc * (4.0 / 3.0) * r;
            const double across = cylinder * (h * h / 12 + r * r / 4) +
                                  caps * (0.4 * r * r + h * h / 4 + 0.375 * h * r);
            const double along = cylinder * 0.5 * r * r + caps * 0.4 * r * r;
            return Solid{cylinder + caps, {across, along, across}};
        },
        [](const Plane&) { return Solid{}; });
}

// The columns of the rotation matrix of q, which need not be normalised to the last bit.
std::array<Row, 3> rotation_columns(Quat q) {
    double x = q.x, y = q.y, z = q.z, w = q.w;
    const double n = x * x + y * y + z * z + w * w;
    if (!(n > 0)) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const double s = 2.0 / n;
    return {{{1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
             {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)},
             {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)}}};
}

struct Tensor {
    double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;

    // Adds moment * u u^T.
    void add_outer(double moment, const Row& u) {
        xx += moment * u[0] * u[0], yy += moment * u[1] * u[1], zz += moment * u[2] * u[2];
        xy += moment * u[0] * u[1], xz += moment * u[0] * u[2], yz += moment * u[1] * u[2];
    }
    // Adds m (|d|^2 1 - d d^T): what the mass m at the offset d contributes.
    void add_parallel_axis(double mass, const Row& d) {
        const double squared = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        add_outer(-mass, d);
        xx += mass * squared, yy += mass * squared, zz += mass * squared;
    }
};

Row position_of(const ShapeDef& shape) {
    const Vec3 p = shape.local_pose.position;
    return {p.x, p.y, p.z};
}

}  // namespace

MassProperties combined_mass_properties(std::span<const ShapeDef> shapes) {
    double mass = 0;
    Row center = {};
    for (const ShapeDef& shape : shapes) {
        const Solid solid = solid_of(shape);
        const Row p = position_of(shape);
        mass += solid.mass;
        for (std::size_t k = 0; k < 3; ++k) center[k] += solid.mass * p[k];
    }
    if (!(mass > 0)) return {};
    for (double& c : center) c /= mass;

    Tensor inertia;
    for (const ShapeDef& shape : shapes) {
        const Solid solid = solid_of(shape);
        const std::array<Row, 3> axes = rotation_columns(shape.local_pose.rotation);
        for (std::size_t k = 0; k < 3; ++k) inertia.add_outer(solid.moments[k], axes[k]);
        const Row p = position_of(shape);
        inertia.add_parallel_axis(solid.mass,
                                  {p[0] - center[0], p[1] - center[1], p[2] - center[2]});
    }
    return {float(mass),
            {float(center[0]), float(center[1]), float(center[2])},
            {float(inertia.xx), float(inertia.yy), float(inertia.zz), float(inertia.xy),
             float(inertia.xz), float(inertia.yz)}};
}

}  // namespace cairn

#pragma once
// Questions to a world between its steps: what a ray meets, what is in a place, how far the nearest
// thing is.
//
// Answers are of the poses at the time of the question, and the same whichever broad phase, number
// of threads or compiler: where two shapes are equally near, the one with the smaller id comes
// first. Shapes are solid.

#include <functional>
#include <limits>
#include <optional>

#include "cairn/body.h"
#include "cairn/ids.h"
#include "cairn/types.h"

namespace cairn {

/// A straight line from a point on.
struct Ray {
    Position origin = {};
    Vec3 direction = {0, -1, 0};  ///< of any length but 0; normalised
    /// m, >= 0; may be infinite. 0 asks only for what is at the origin.
    double length = std::numeric_limits<double>::infinity();
    friend constexpr bool operator==(const Ray&, const Ray&) = default;
};

/// Which bodies and shapes a question is about; all of them unless something is said.
struct QueryFilter {
    /// The question is put as a body with this filter would be: who would not collide with it is
    /// left out. Sleeping, static and frozen bodies are seen like any others.
    std::optional<CollisionFilter> collision = {};
    /// This body is left out: the one that asks.
    BodyId except = {};
    /// Rays only: shapes that hold the ray's origin are left out, instead of being met at once.
    bool skip_inside = false;
    /// Asked last, of what the rest lets through; false leaves the shape out. Called at any time,
    /// in any order; it must change nothing in the world.
    std::function<bool(BodyId, ShapeId)> accepts = {};
};

/// Where a ray meets a shape. True where there is one.
struct RayHit {
    BodyId body = {};
    ShapeId shape = {};
    Position point = {};
    /// Unit, world, outward from the surface that is met.
    Vec3 normal = {};
    double distance = 0;  ///< m along the ray
    /// The ray begins within the shape, which is then met at once: distance 0, the point is the
    /// origin, and the normal is against the ray since no surface is met. A ray that begins on the
    /// surface meets it there if it goes in, and not at all if it slides along or leaves.
    bool inside = false;
    explicit operator bool() const { return bool(shape); }
    friend constexpr bool operator==(const RayHit&, const RayHit&) = default;
};

/// What is nearest to a point. True where there is anything within reach.
struct NearestHit {
    BodyId body = {};
    ShapeId shape = {};
    Position point = {};  ///< on the surface
    Vec3 normal = {};     ///< unit, world, outward
    /// m, signed: negative where the point is inside the shape. In several shapes at once, that
    /// from whose surface it is farthest answers.
    double distance = 0;
    explicit operator bool() const { return bool(shape); }
    friend constexpr bool operator==(const NearestHit&, const NearestHit&) = default;
};

/// A box along the world's axes.
struct Bounds {
    Position lower = {};
    Position upper = {};  ///< no coordinate below that of `lower`
    friend constexpr bool operator==(const Bounds&, const Bounds&) = default;
};

}  // namespace cairn

// Judges the poses and velocities that a run ended with.
//
// Pairs are found by a sweep along x: parts in the order of their lower ends, against those whose
// upper ends are still ahead. What cannot move is tested against what can alone, so that a million
// static boxes cost no more than what moves among them.

#include "quality.h"

#include <algorithm>
#include <cmath>

#include "overlap.h"

namespace cairn::bench {

namespace {

struct SweptPart {
    std::size_t body;
    std::uint32_t part;
    bool can_move;
    Vector low, high;
};

bool is_finite(const BodyMotion& motion) {
    double sum = 0;
    for (const double x : motion.position) sum += x;
    for (const double x : motion.rotation) sum += x;
    for (const double x : motion.linear_velocity) sum += x;
    for (const double x : motion.angular_velocity) sum += x;
    return std::isfinite(sum);
}

class OverlapSum {
public:
    OverlapSum(const BenchScene& scene, std::span<const BodyMotion> motions)
        : scene_(scene), motions_(motions) {}

    void sweep() {
        list_parts();
        std::sort(parts_.begin(), parts_.end(),
                  [](const SweptPart& a, const SweptPart& b) { return a.low[0] < b.low[0]; });
        std::vector<const SweptPart*> moving, still;
        for (const SweptPart& part : parts_) {
            pass_by(part, moving);
            if (part.can_move) pass_by(part, still);
            (part.can_move ? moving : still).push_back(&part);
        }
    }

    double deepest = 0;
    double sum = 0;
    std::size_t count = 0;

private:
    PlacedPart place(const SweptPart& part) const {
        const BodyMotion& motion = motions_[part.body];
        return place_part(scene_.parts[part.part], motion.position, motion.rotation);
    }

    void list_parts() {
        for (std::size_t i = 0; i < motions_.size(); ++i) {
            if (!is_finite(motions_[i])) continue;
            const SceneBody& body = scene_.bodies[i];
            for (std::uint32_t k = 0; k < body.part_count; ++k) {
                SweptPart part{.body = i,
                               .part = body.first_part + k,
                               .can_move = body.mobility == Mobility::Dynamic,
                               .low = {},
                               .high = {}};
                const PlacedPart placed = place(part);
                const Vector half = bound_part(placed);
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    part.low[axis] = placed.center[axis] - half[axis];
                    part.high[axis] = placed.center[axis] + half[axis];
                }
                parts_.push_back(part);
            }
        }
    }

    // Measures the part against each of those behind, and forgets those that it has left behind.
    void pass_by(const SweptPart& part, std::vector<const SweptPart*>& behind) {
        std::size_t kept = 0;
        for (const SweptPart* other : behind) {
            if (other->high[0] < part.low[0]) continue;
            behind[kept++] = other;
            if (other->body == part.body) continue;
            if (other->high[1] < part.low[1] || other->low[1] > part.high[1]) continue;
            if (other->high[2] < part.low[2] || other->low[2] > part.high[2]) continue;
            const double depth = measure_overlap(place(*other), place(part));
            if (!(depth > 0)) continue;
            deepest = std::max(deepest, depth);
            sum += depth;
            ++count;
        }
        behind.resize(kept);
    }

    const BenchScene& scene_;
    std::span<const BodyMotion> motions_;
    std::vector<SweptPart> parts_;
};

// 1/2 m v^2 + 1/2 w I w of a body with one part about its origin.
double kinetic_energy(const Part& part, double density, const BodyMotion& motion) {
    constexpr double pi = 3.14159265358979323846;
    const Vector& v = motion.linear_velocity;
    const Vector& w = motion.angular_velocity;
    if (part.form == Form::Sphere) {
        const double mass = 4.0 / 3 * pi * part.radius * part.radius * part.radius * density;
        return 0.5 * mass * (dot(v, v) + 0.4 * part.radius * part.radius * dot(w, w));
    }
    if (part.form == Form::Capsule) {
        const double r = part.radius, l = 2 * part.half_height;
        const double middle = pi * r * r * l * density;
        const double ends = 4.0 / 3 * pi * r * r * r * density;
        const double along = middle * r * r / 2 + ends * 0.4 * r * r;
        const double across =
            middle * (l * l / 12 + r * r / 4) + ends * (0.4 * r * r + l * l / 4 + 0.375 * l * r);
        const double spin = dot(w, place_part(part, motion.position, motion.rotation).axes[1]);
        return 0.5 * ((middle + ends) * dot(v, v) + across * (dot(w, w) - spin * spin) +
                      along * spin * spin);
    }
    const Vector& h = part.half_extents;
    const double mass = 8 * h[0] * h[1] * h[2] * density;
    const PlacedPart placed = place_part(part, motion.position, motion.rotation);
    double turning = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double speed = dot(w, placed.axes[i]);
        turning += (dot(h, h) - h[i] * h[i]) / 3 * speed * speed;
    }
    return 0.5 * mass * (dot(v, v) + turning);
}

double distance(const Vector& a, const Vector& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

Quality measure_quality(const BenchScene& scene, std::span<const BodyMotion> motions) {
    Quality quality;
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const SceneBody& body = scene.bodies[i];
        if (body.mobility != Mobility::Dynamic) continue;
        const bool is_sound = is_finite(motions[i]);
        if (!is_sound || motions[i].position[1] < scene.lost_below) ++quality.lost_bodies;
        if (!is_sound) continue;
        quality.kinetic_energy += kinetic_energy(scene.parts[body.first_part],
                                                 static_cast<double>(body.density), motions[i]);
    }
    for (const Standing& standing : scene.standing) {
        if (standing.body >= motions.size()) continue;
        const double away = distance(motions[standing.body].position, standing.place);
        // Not a number must not hide behind the others.
        if (!(away <= quality.drift.value_or(-1))) quality.drift = away;
    }
    OverlapSum overlaps(scene, motions);
    overlaps.sweep();
    quality.deepest_penetration = overlaps.deepest;
    quality.overlapping_pairs = overlaps.count;
    if (overlaps.count > 0) {
        quality.mean_penetration = overlaps.sum / static_cast<double>(overlaps.count);
    }
    return quality;
}

}  // namespace cairn::bench

#pragma once
// Judges for the narrow phase, in binary64 and by other means than its own: random poses, the hull
// of all vertex differences, and distances by looking at every pair of features.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "cairn/settings.h"
#include "math/quat.h"
#include "narrow/find_axis.h"

namespace cairn::judge {

struct V {
    double x = 0, y = 0, z = 0;
};
inline V operator+(V a, V b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V operator-(V a, V b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V operator*(double s, V v) { return {s * v.x, s * v.y, s * v.z}; }
inline double dot(V a, V b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V cross(V a, V b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(V v) { return std::sqrt(dot(v, v)); }
inline V wide(Vec3 v) { return {double(v.x), double(v.y), double(v.z)}; }

// splitmix64: the same draws everywhere.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    double uniform(double low, double high) {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        z ^= z >> 31;
        return low + (high - low) * double(z >> 11) * 0x1p-53;
    }
    float real(double low, double high) { return float(uniform(low, high)); }
    Vec3 vector(double half) { return {real(-half, half), real(-half, half), real(-half, half)}; }
    Vec3 direction() {
        for (;;) {
            const Vec3 v = vector(1);
            const float squared = length_squared(v);
            if (squared > 0.01f && squared <= 1) return normalize_or(v, {1, 0, 0});
        }
    }
    Quat rotation() {
        for (;;) {
            const Quat q = {real(-1, 1), real(-1, 1), real(-1, 1), real(-1, 1)};
            const float squared = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
            if (squared > 0.01f && squared <= 1) return normalize(q);
        }
    }

private:
    std::uint64_t state_;
};

inline Quat turn(Vec3 axis, double radians) {
    const Vec3 n = normalize_or(axis, {1, 0, 0});
    const float s = float(std::sin(radians / 2));
    return {n.x * s, n.y * s, n.z * s, float(std::cos(radians / 2))};
}

// A box in binary64, its axes those of the binary32 matrix that the narrow phase sees.
struct WideBox {
    V center;
    V axes[3];
    double half[3];

    WideBox(const Box& box, const Pose& pose) : center(wide(pose.position)) {
        const Mat3 m = to_matrix(pose.rotation);
        axes[0] = wide(m.x), axes[1] = wide(m.y), axes[2] = wide(m.z);
        half[0] = double(box.half_extents.x);
        half[1] = double(box.half_extents.y);
        half[2] = double(box.half_extents.z);
    }
    std::array<V, 8> vertices() const {
        std::array<V, 8> all;
        for (int i = 0; i < 8; ++i) {
            V v = center;
            for (int k = 0; k < 3; ++k) v = v + ((i >> k & 1) ? half[k] : -half[k]) * axes[k];
            all[std::size_t(i)] = v;
        }
        return all;
    }
    double distance_to(V point) const {
        double squared = 0;
        for (int k = 0; k < 3; ++k) {
            const double excess = std::abs(dot(point - center, axes[k])) - half[k];
            if (excess > 0) squared += excess * excess;
        }
        return std::sqrt(squared);
    }
};

inline double segment_distance(V p0, V p1, V q0, V q1) {
    // The least of the four ends against the other segment, and of the crossing where it is inside
    // both.
    const auto to_segment = [](V p, V a, V b) {
        const V ab = b - a;
        const double squared = dot(ab, ab);
        const double t = squared > 0 ? std::clamp(dot(p - a, ab) / squared, 0.0, 1.0) : 0.0;
        return length(p - a - t * ab);
    };
    double best = std::min({to_segment(p0, q0, q1), to_segment(p1, q0, q1), to_segment(q0, p0, p1),
                            to_segment(q1, p0, p1)});
    const V u = p1 - p0, v = q1 - q0, w = p0 - q0;
    const double a = dot(u, u), b = dot(u, v), c = dot(v, v), d = dot(u, w), e = dot(v, w);
    const double det = a * c - b * b;
    if (det > 1e-14 * a * c) {
        const double s = (b * e - c * d) / det, t = (a * e - b * d) / det;
        if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best = std::min(best, length(w + s * u - t * v));
    }
    return best;
}

// The distance of two boxes that do not overlap: every vertex against the other box, every edge
// pair.
inline double distance_by_features(const WideBox& a, const WideBox& b) {
    const auto on_a = a.vertices(), on_b = b.vertices();
    double best = 1e300;
    for (const V& v : on_a) best = std::min(best, b.distance_to(v));
    for (const V& v : on_b) best = std::min(best, a.distance_to(v));
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t k = 1; k < 8; k <<= 1) {
            if (i & k) continue;
            for (std::size_t j = 0; j < 8; ++j)
                for (std::size_t l = 1; l < 8; l <<= 1) {
                    if (j & l) continue;
                    best = std::min(best,
                                    segment_distance(on_a[i], on_a[i | k], on_b[j], on_b[j | l]));
                }
        }
    return best;
}

// The signed distance from the origin to the surface of the hull of a - b over all vertices: every
// plane through three of the points that has none beyond it. Negative where the boxes overlap;
// where they do not, the largest distance to a face's plane, a lower bound of the distance.
inline double separation_by_hull(const std::vector<V>& on_a, const std::vector<V>& on_b) {
    std::vector<V> d;
    for (const V& p : on_a)
        for (const V& q : on_b) d.push_back(p - q);
    double scale = 0;
    for (const V& p : d) scale = std::max(scale, length(p));
    double best = -1e300;
    for (std::size_t i = 0; i < d.size(); ++i)
        for (std::size_t j = i + 1; j < d.size(); ++j)
            for (std::size_t k = j + 1; k < d.size(); ++k) {
                V n = cross(d[j] - d[i], d[k] - d[i]);
                const double area = length(n);
                if (area <= 1e-9 * length(d[j] - d[i]) * length(d[k] - d[i])) continue;
                n = (1 / area) * n;
                bool above = false, below = false;
                for (const V& p : d) {
                    const double h = dot(n, p - d[i]);
                    above |= h > 1e-9 * scale;
                    below |= h < -1e-9 * scale;
                    if (above && below) break;
                }
                if (above && below) continue;
                const double offset = dot(n, d[i]);
                if (!above) best = std::max(best, -offset);
                if (!below) best = std::max(best, offset);
            }
    return best;
}
inline double separation_by_hull(const WideBox& a, const WideBox& b) {
    const auto on_a = a.vertices(), on_b = b.vertices();
    return separation_by_hull({on_a.begin(), on_a.end()}, {on_b.begin(), on_b.end()});
}

// A capsule's core in binary64: its ends.
struct WideCore {
    V ends[2];
    double radius;

    WideCore(const Capsule& capsule, const Pose& pose) : radius(double(capsule.radius)) {
        const V half = 0.5 * double(capsule.height) * wide(to_matrix(pose.rotation).y);
        ends[0] = wide(pose.position) - half;
        ends[1] = wide(pose.position) + half;
    }
};

inline double distance_to_core(V point, const WideCore& core) {
    return segment_distance(core.ends[0], core.ends[1], point, point);
}

// Of a core and a box: where they overlap the least push, else the distance of every two features.
inline double core_separation(const WideBox& box, const WideCore& core) {
    const auto vertices = box.vertices();
    const double by_hull =
        separation_by_hull({vertices.begin(), vertices.end()}, {core.ends[0], core.ends[1]});
    if (by_hull <= 0) return by_hull;
    double best = std::min(box.distance_to(core.ends[0]), box.distance_to(core.ends[1]));
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t k = 1; k < 8; k <<= 1) {
            if (i & k) continue;
            best = std::min(
                best, segment_distance(core.ends[0], core.ends[1], vertices[i], vertices[i | k]));
        }
    return best;
}

// How far apart the two boxes are along the unit vector n, from A to B.
inline double separation_along(const WideBox& a, const WideBox& b, V n) {
    double top = -1e300, bottom = 1e300;
    for (const V& v : a.vertices()) top = std::max(top, dot(n, v));
    for (const V& v : b.vertices()) bottom = std::min(bottom, dot(n, v));
    return bottom - top;
}

inline constexpr NarrowPhase methods[] = {NarrowPhase::Sat, NarrowPhase::GjkEpa};

inline Axis axis_of(const Geometry& a, const Geometry& b, const Pose& b_in_a, NarrowPhase method) {
    AxisHint hint;
    return find_axis(a, b, b_in_a, method, hint);
}
// Where both shapes are placed in a common frame; the axis is along A's axes.
inline Axis axis_between(const Geometry& a, const Pose& pose_a, const Geometry& b,
                         const Pose& pose_b, NarrowPhase method) {
    return axis_of(a, b, inverse(pose_a) * pose_b, method);
}

}  // namespace cairn::judge

// Reduction of a contact polygon to four points; see reduce_points.h.

#include "contact/reduce_points.h"

namespace cairn {
namespace {

// How much larger a later subset must be, and, as part of the polygon's size, how much deeper a
// later point to count as the deepest.
constexpr float clearly_larger = 1.02f;
constexpr float relative_depth = 1e-4f;
// The weight of length beside area: it decides only where the polygon has next to no area.
constexpr float length_weight = 1e-3f;

struct Place {
    float p = 0, q = 0;
};

float twice_area(Place a, Place b, Place c) {
    return (b.p - a.p) * (c.q - a.q) - (b.q - a.q) * (c.p - a.p);
}
float distance_squared(Place a, Place b) { return square(b.p - a.p) + square(b.q - a.q); }

template <std::size_t N>
float twice_area(const std::array<Place, N>& corners, int count) {
    float area = 0;
    for (int i = 2; i < count; ++i) {
        area += twice_area(corners[0], corners[std::size_t(i - 1)], corners[std::size_t(i)]);
    }
    return area;
}

// Whether the convex polygon holds the point; `turn` is the sign of its area.
template <std::size_t N>
bool holds(const std::array<Place, N>& corners, int count, Place point, float turn) {
    for (int i = 0; i < count; ++i) {
        const Place a = corners[std::size_t(i)],
                    b = corners[std::size_t(i + 1 == count ? 0 : i + 1)];
        if (turn * twice_area(a, b, point) < 0) return false;
    }
    return true;
}

using Polygon = std::array<Place, ClipPolygon::max_points>;
using Quad = std::array<Place, 4>;

float score(const Quad& quad, float turn, const Place (&centers)[2], const bool (&is_held)[2]) {
    float length = 0;
    for (std::size_t i = 0; i < 4; ++i) length += distance_squared(quad[i], quad[(i + 1) % 4]);
    float result = turn * twice_area(quad, 4) + length_weight * length;
    for (int k = 0; k < 2; ++k) {
        if (is_held[k] && !holds(quad, 4, centers[k], turn)) result *= 0.5f;
    }
    return result;
}

int find_deepest(const ClipPolygon& polygon) {
    float size = 0;
    for (int i = 0; i < polygon.count; ++i) {
        const ClipPoint& point = polygon.points[std::size_t(i)];
        size = max(size, max(absolute(point.p), absolute(point.q)));
    }
    int deepest = 0;
    for (int i = 1; i < polygon.count; ++i) {
        const float best = polygon.points[std::size_t(deepest)].separation;
        if (polygon.points[std::size_t(i)].separation < best - relative_depth * size) deepest = i;
    }
    return deepest;
}

}  // namespace

void reduce_points(ClipPolygon& polygon) {
    if (polygon.count <= 4) return;
    Polygon corners;
    for (std::size_t i = 0; i < std::size_t(polygon.count); ++i) {
        corners[i] = {polygon.points[i].p, polygon.points[i].q};
    }
    const float turn = twice_area(corners, polygon.count) < 0 ? -1.0f : 1.0f;
    const Place centers[2] = {{0, 0}, {polygon.other_p, polygon.other_q}};
    const bool is_held[2] = {holds(corners, polygon.count, centers[0], turn),
                             holds(corners, polygon.count, centers[1], turn)};
    const int deepest = find_deepest(polygon);

    std::array<int, 4> best = {0, 1, 2, 3};
    float best_score = -1;
    const int n = polygon.count;
    for (int i = 0; i < n - 3; ++i) {
        for (int j = i + 1; j < n - 2; ++j) {
            for (int k = j + 1; k < n - 1; ++k) {
                for (int l = k + 1; l < n; ++l) {
                    if (i != deepest && j != deepest && k != deepest && l != deepest) continue;
                    const Quad quad = {corners[std::size_t(i)], corners[std::size_t(j)],
                                       corners[std::size_t(k)], corners[std::size_t(l)]};
                    const float candidate = score(quad, turn, centers, is_held);
                    if (candidate <= best_score * clearly_larger) continue;
                    best_score = candidate;
                    best = {i, j, k, l};
                }
            }
        }
    }
    for (std::size_t i = 0; i < 4; ++i) {
        polygon.points[i] = polygon.points[std::size_t(best[i])];
    }
    polygon.count = 4;
}

}  // namespace cairn

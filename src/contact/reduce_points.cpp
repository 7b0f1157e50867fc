// Reduction of a contact polygon to four points; see reduce_points.h.
//
// The worth of a quadrilateral adds up from its sides, so each stretch between two corners is
// measured once, forth and back. Its area is that of the triangle which it spans with the subject's
// centre, at 0: over the four sides these add up to the quadrilateral's.

#include "contact/reduce_points.h"

#include "math/scalar.h"

namespace cairn {
namespace {

constexpr int max_points = ClipPolygon::max_points;

// How much larger a later subset must be, and, as part of the polygon's size, how much deeper a
// later point to count as the deepest.
constexpr float clearly_larger = 1.02f;
constexpr float relative_depth = 1e-4f;
// The weight of length beside area: it decides only where the polygon has next to no area.
constexpr float length_weight = 1e-3f;

int find_deepest(const ClipPolygon& polygon) {
    float size = 0;
    for (int i = 0; i < polygon.count; ++i) {
        size = max(size, max(absolute(polygon.p[i]), absolute(polygon.q[i])));
    }
    int deepest = 0;
    for (int i = 1; i < polygon.count; ++i) {
        if (polygon.separation[i] < polygon.separation[deepest] - relative_depth * size) {
            deepest = i;
        }
    }
    return deepest;
}

// One side or several, one after the other.
struct Stretch {
    float worth = 0;
    int held = 0;  // the centres on the inner side of all of it: 1 the subject's, 2 the reference's
};

Stretch operator+(Stretch x, Stretch y) { return {x.worth + y.worth, x.held & y.held}; }

// From every corner to every other. `turn` is the sign of the polygon's area.
struct Stretches {
    float worth[max_points][max_points];
    int held[max_points][max_points];

    Stretches(const ClipPolygon& polygon, float turn) {
        for (int i = 0; i < polygon.count; ++i) measure_from(polygon, i, turn);
    }
    // To all places of the polygon, taken or not: so compilers do four at a time.
    void measure_from(const ClipPolygon& polygon, int i, float turn) {
        const float p_i = polygon.p[i], q_i = polygon.q[i];
        const float to_p = p_i - polygon.center_p, to_q = q_i - polygon.center_q;
        for (int j = 0; j < max_points; ++j) {
            const float p = polygon.p[j] - p_i, q = polygon.q[j] - q_i;
            const float by_subject = turn * (p_i * q - q_i * p);
            const float by_reference = turn * (to_p * q - to_q * p);
            worth[i][j] = by_subject + length_weight * (p * p + q * q);
            held[i][j] = (by_subject >= 0 ? 1 : 0) | (by_reference >= 0 ? 2 : 0);
        }
    }
    Stretch operator()(int i, int j) const { return {worth[i][j], held[i][j]}; }
};

float twice_area(const ClipPolygon& polygon) {
    float area = 0;
    for (int i = 0, last = polygon.count - 1; i < polygon.count; last = i++) {
        area += polygon.p[last] * polygon.q[i] - polygon.q[last] * polygon.p[i];
    }
    return area;
}

}  // namespace

void reduce_points(ClipPolygon& polygon) {
    const int n = polygon.count;
    if (n <= 4) return;
    const Stretches between(polygon, twice_area(polygon) < 0 ? -1.0f : 1.0f);
    int held_by_all = between.held[n - 1][0];
    for (int i = 1; i < n; ++i) held_by_all &= between.held[i - 1][i];
    const int deepest = find_deepest(polygon);
    // What may follow a corner: the deepest or one before it, as long as that is still to come.
    const auto last_after = [&](int corner, int still_to_come) {
        const int last = n - 1 - still_to_come;
        return corner < deepest && deepest < last ? deepest : last;
    };

    int best[4] = {0, 1, 2, 3};
    float best_worth = -1;
    for (int i = 0; i <= last_after(-1, 3); ++i) {
        for (int j = i + 1; j <= last_after(i, 2); ++j) {
            for (int k = j + 1; k <= last_after(j, 1); ++k) {
                const Stretch three = between(i, j) + between(j, k);
                for (int l = k < deepest ? deepest : k + 1; l <= last_after(k, 0); ++l) {
                    const Stretch quad = three + between(k, l) + between(l, i);
                    constexpr float share[4] = {1, 0.5f, 0.5f, 0.25f};
                    const float worth = quad.worth * share[held_by_all & ~quad.held];
                    if (worth <= best_worth * clearly_larger) continue;
                    best_worth = worth;
                    best[0] = i, best[1] = j, best[2] = k, best[3] = l;
                }
            }
        }
    }
    for (int i = 0; i < 4; ++i) move_corner(polygon, best[i], i);
    polygon.count = 4;
}

}  // namespace cairn

// Clipping one face of a box against another; see clip_faces.h.
//
// Symbols, along the first box's axes, taken in turn so that the one across its face is the third:
// n the normal, t the second box's centre from the first's. A point x has the coordinates (p, q) of
// the place where its line along n meets the plane through the second box's centre:
// p = x_1 - x_3 n_1 / n_3 and q = x_2 - x_3 n_2 / n_3.

#include "contact/clip_faces.h"

namespace cairn {
namespace {

constexpr int max_points = ClipPolygon::max_points;

// A vertex this part of the smaller face's half width outside a side is moved to it.
constexpr float relative_snap = 5e-3f;

// Two opposite sides of the first box's face: x is the coordinate that they bound, about a middle.
struct Band {
    float middle;
    float half;
    std::uint32_t faces[2];  // of the first box, at the lower and at the upper side

    float bound(int side) const { return middle + float(side) * half; }
};

// Cuts the polygon off at both sides of the band; y is the other coordinate.
void cut_to_band(ClipPolygon& polygon, float* x, float* y, const Band& band, float snap) {
    const int count = polygon.count;
    int side[max_points];  // on which a corner lies outside, -1 or 1; 0 within
    bool any_outside = false;
    for (int i = 0; i < count; ++i) {
        const float across = x[i] - band.middle;
        const bool is_outside = absolute(across) > band.half + snap;
        side[i] = !is_outside ? 0 : across < 0 ? -1 : 1;
        any_outside |= is_outside;
        if (!is_outside) x[i] = clamp(x[i], band.bound(-1), band.bound(1));
    }
    if (!any_outside) return;

    const ClipPolygon whole = polygon;
    const float* const from_x = x == polygon.p ? whole.p : whole.q;
    const float* const from_y = x == polygon.p ? whole.q : whole.p;
    int kept = 0;
    const auto keep = [&](float at_x, float at_y, std::uint32_t feature) {
        if (kept == max_points) return;
        x[kept] = at_x, y[kept] = at_y, polygon.feature[kept] = feature;
        ++kept;
    };
    const auto keep_crossing = [&](int in, int out) {
        const float bound = band.bound(side[out]);
        // A corner on the side itself is its own crossing.
        if (from_x[in] == bound) return;
        const float part = (bound - from_x[in]) / (from_x[out] - from_x[in]);
        // What the ends share: an edge of the subject, or the side that was cut before; with this
        // side, a crossing of edges or a vertex of the reference over the subject's face.
        keep(bound, from_y[in] + part * (from_y[out] - from_y[in]),
             (whole.feature[in] & whole.feature[out]) | band.faces[side[out] > 0]);
    };
    for (int i = 0; i < count; ++i) {
        const int next = i + 1 == count ? 0 : i + 1;
        if (side[i] == 0) keep(from_x[i], from_y[i], whole.feature[i]);
        if (side[i] == side[next]) continue;
        if (side[i] != 0) keep_crossing(next, i);
        if (side[next] != 0) keep_crossing(i, next);
    }
    polygon.count = kept;
}

}  // namespace

ClipPolygon clip_faces(const BoxPair& pair, Three n_in_first, Three n_in_second, FaceOwner first,
                       FaceOwner second) {
    // The first box's face that looks most along n, and the second's that looks most against it.
    const int k = steepest_axis(n_in_first), k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    const int s = steepest_axis(n_in_second), s1 = (s + 1) % 3, s2 = (s + 2) % 3;
    const Three n = turn_to(n_in_first, k), t = turn_to(pair.t, k), h = turn_to(pair.h_a, k);
    const float h_s = pair.h_b[s], h_s1 = pair.h_b[s1], h_s2 = pair.h_b[s2];
    const float sign = n[2] < 0 ? -1.0f : 1.0f;
    const float sign_s = n_in_second[s] < 0 ? 1.0f : -1.0f;
    const Three m = sign_s * turn_to(pair.axes_b[s], k);  // outward from the second's face

    // From a point to its place (p, q).
    const Three lean = (1.0f / n[2]) * n;
    const auto place = [&](Three x) { return x - x[2] * lean; };
    const Three middle = place(h_s * m);
    const Three edge_1 = place(h_s1 * turn_to(pair.axes_b[s1], k));
    const Three edge_2 = place(h_s2 * turn_to(pair.axes_b[s2], k));
    constexpr float turn[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    ClipPolygon polygon;
    polygon.count = 4;
    const std::uint32_t faces = face_bit(first, k, sign) | face_bit(second, s, sign_s);
    for (int i = 0; i < 4; ++i) {
        const auto& [sign_1, sign_2] = turn[i];
        const Three corner = middle + (sign_1 * edge_1 + sign_2 * edge_2);
        polygon.p[i] = corner[0], polygon.q[i] = corner[1];
        polygon.feature[i] = faces | face_bit(second, s1, sign_1) | face_bit(second, s2, sign_2);
    }

    // The first box's face stands about the place of its own middle.
    const Three around = place(Three{0, 0, sign * h[2], 0} - t);
    const float snap = relative_snap * min(min(h[0], h[1]), min(h_s1, h_s2));
    const Band band_p = {around[0], h[0], {face_bit(first, k1, -1), face_bit(first, k1, 1)}};
    const Band band_q = {around[1], h[1], {face_bit(first, k2, -1), face_bit(first, k2, 1)}};
    cut_to_band(polygon, polygon.p, polygon.q, band_p, snap);
    cut_to_band(polygon, polygon.q, polygon.p, band_q, snap);

    // Both faces' heights along n above the plane through the second box's centre.
    const Three center = place(-t);
    polygon.center_p = center[0], polygon.center_q = center[1];
    polygon.axis = k;
    polygon.height = (h[2] - sign * t[2]) / (sign * n[2]);
    const Three climb = (1.0f / absolute(n_in_second[s])) * m;
    const float level = -h_s / absolute(n_in_second[s]) - polygon.height;
    for (int i = 0; i < polygon.count; ++i) {
        polygon.separation[i] = level + (polygon.p[i] * climb[0] + polygon.q[i] * climb[1]);
    }
    return polygon;
}

void keep_nearer(ClipPolygon& polygon, float max_separation) {
    int kept = 0;
    for (int i = 0; i < polygon.count; ++i) {
        if (polygon.separation[i] <= max_separation) move_corner(polygon, i, kept++);
    }
    polygon.count = kept;
}

}  // namespace cairn

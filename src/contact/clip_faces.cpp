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

// A convex polygon in the first box's face: its corners' two coordinates and what meets there.
struct Corners {
    int count = 0;
    float at[2][max_points];
    std::uint32_t feature[max_points];

    // A cut adds a corner at most; where rounding adds more, they are left out.
    void push(int coordinate, float x, float y, std::uint32_t meeting) {
        if (count == max_points) return;
        at[coordinate][count] = x, at[1 - coordinate][count] = y, feature[count] = meeting;
        ++count;
    }
};

// Two opposite sides of the first box's face: they bound one coordinate, about a middle.
struct Band {
    int coordinate;
    float middle;
    float half;
    std::uint32_t faces[2];  // of the first box, at the lower and at the upper side

    float bound(int side) const { return middle + float(side) * half; }
};

// Cuts the corners off at both sides of the band, into `kept`. False, and nothing kept, where all
// are within.
bool cut_to_band(Corners& corners, const Band& band, float snap, Corners& kept) {
    const int count = corners.count;
    float* const x = corners.at[band.coordinate];
    const float* const y = corners.at[1 - band.coordinate];
    int side[max_points];  // on which a corner lies outside, -1 or 1; 0 within
    bool any_outside = false;
    for (int i = 0; i < count; ++i) {
        const float across = x[i] - band.middle;
        const bool is_outside = absolute(across) > band.half + snap;
        side[i] = !is_outside ? 0 : across < 0 ? -1 : 1;
        any_outside |= is_outside;
        if (!is_outside) x[i] = clamp(x[i], band.bound(-1), band.bound(1));
    }
    if (!any_outside) return false;

    const auto push_crossing = [&](int in, int out) {
        const float bound = band.bound(side[out]);
        // A corner on the side itself is its own crossing.
        if (x[in] == bound) return;
        const float part = (bound - x[in]) / (x[out] - x[in]);
        // What the ends share: an edge of the subject, or the side that was cut before; with this
        // side, a crossing of edges or a vertex of the reference over the subject's face.
        kept.push(band.coordinate, bound, y[in] + part * (y[out] - y[in]),
                  (corners.feature[in] & corners.feature[out]) | band.faces[side[out] > 0]);
    };
    for (int i = 0; i < count; ++i) {
        const int next = i + 1 == count ? 0 : i + 1;
        if (side[i] == 0) kept.push(band.coordinate, x[i], y[i], corners.feature[i]);
        if (side[i] == side[next]) continue;
        if (side[i] != 0) push_crossing(next, i);
        if (side[next] != 0) push_crossing(i, next);
    }
    return true;
}

}  // namespace

ClipPolygon clip_faces(const BoxPair& pair, Three n_in_first, Three n_in_second, FaceOwner first,
                       FaceOwner second, float max_separation) {
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
    Corners vertices, cut_once, cut_twice;
    const std::uint32_t faces = face_bit(first, k, sign) | face_bit(second, s, sign_s);
    for (int i = 0; i < 4; ++i) {
        const auto& [sign_1, sign_2] = turn[i];
        const Three corner = middle + (sign_1 * edge_1 + sign_2 * edge_2);
        vertices.push(0, corner[0], corner[1],
                      faces | face_bit(second, s1, sign_1) | face_bit(second, s2, sign_2));
    }

    // The first box's face stands about the place of its own middle.
    const Three around = place(Three{0, 0, sign * h[2], 0} - t);
    const float snap = relative_snap * min(min(h[0], h[1]), min(h_s1, h_s2));
    const Band bands[2] = {{0, around[0], h[0], {face_bit(first, k1, -1), face_bit(first, k1, 1)}},
                           {1, around[1], h[1], {face_bit(first, k2, -1), face_bit(first, k2, 1)}}};
    Corners* corners = &vertices;
    if (cut_to_band(*corners, bands[0], snap, cut_once)) corners = &cut_once;
    if (cut_to_band(*corners, bands[1], snap, cut_twice)) corners = &cut_twice;

    // Both faces' heights along n above the plane through the second box's centre.
    const Three center = place(-t);
    ClipPolygon polygon;
    polygon.center_p = center[0], polygon.center_q = center[1];
    polygon.axis = k;
    polygon.height = (h[2] - sign * t[2]) / (sign * n[2]);
    const float steepness = 1.0f / absolute(n_in_second[s]);
    const float climb_p = steepness * m[0], climb_q = steepness * m[1];
    const float level = -h_s * steepness - polygon.height;
    for (int i = 0; i < corners->count; ++i) {
        const float p = corners->at[0][i], q = corners->at[1][i];
        const float separation = level + (p * climb_p + q * climb_q);
        if (!(separation <= max_separation)) continue;
        const int to = polygon.count++;
        polygon.p[to] = p, polygon.q[to] = q;
        polygon.separation[to] = separation, polygon.feature[to] = corners->feature[i];
    }
    return polygon;
}

}  // namespace cairn

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

struct Place {
    float p = 0, q = 0;
};

// The side of the first box's face where sign x = bound.
struct Side {
    float sign;
    float bound;
    std::uint32_t face;
};

// Cuts the polygon off where coordinate x goes beyond the side; y is the other coordinate.
void cut_off(ClipPolygon& polygon, float* x, float* y, const Side& side, float snap) {
    const int count = polygon.count;
    bool is_inside[max_points];
    bool all_inside = true;
    for (int i = 0; i < count; ++i) {
        const float beyond = side.sign * x[i] - side.bound;
        is_inside[i] = beyond <= snap;
        all_inside &= beyond <= snap;
        if (beyond > 0 && beyond <= snap) x[i] = side.sign * side.bound;
    }
    if (all_inside) return;

    const ClipPolygon whole = polygon;
    const float* const from_x = x == polygon.p ? whole.p : whole.q;
    const float* const from_y = x == polygon.p ? whole.q : whole.p;
    const std::uint32_t* const from = whole.feature;
    const float bound = side.sign * side.bound;
    int kept = 0;
    const auto keep = [&](float at_x, float at_y, std::uint32_t feature) {
        if (kept == max_points) return;
        x[kept] = at_x, y[kept] = at_y, polygon.feature[kept] = feature;
        ++kept;
    };
    for (int i = 0; i < count; ++i) {
        const int next = i + 1 == count ? 0 : i + 1;
        if (is_inside[i]) keep(from_x[i], from_y[i], from[i]);
        if (is_inside[i] == is_inside[next]) continue;
        const int in = is_inside[i] ? i : next, out = is_inside[i] ? next : i;
        // A corner on the side itself is its own crossing.
        if (from_x[in] == bound) continue;
        const float part = (bound - from_x[in]) / (from_x[out] - from_x[in]);
        // What the ends share: an edge of the subject, or the side that was cut before; with this
        // side, a crossing of edges or a vertex of the reference over the subject's face.
        keep(bound, from_y[in] + part * (from_y[out] - from_y[in]),
             (from[in] & from[out]) | side.face);
    }
    polygon.count = kept;
}

// The same vector along the axes next to `axis`, the one after, and `axis` itself.
Vec3 cycle(Vec3 v, int axis) {
    return axis == 0 ? Vec3{v.y, v.z, v.x} : axis == 1 ? Vec3{v.z, v.x, v.y} : v;
}

}  // namespace

ClipPolygon clip_faces(const BoxPair& pair, Vec3 n_in_first, Vec3 n_in_second, FaceOwner first,
                       FaceOwner second) {
    // The first box's face that looks most along n, and the second's that looks most against it.
    const int k = steepest_axis(n_in_first), k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    const int s = steepest_axis(n_in_second), s1 = (s + 1) % 3, s2 = (s + 2) % 3;
    const Vec3 n = cycle(n_in_first, k), t = cycle(pair.t, k), h = cycle(pair.h_a, k);
    const Vec3 h_s = cycle(pair.h_b, s);
    const float sign = n.z < 0 ? -1.0f : 1.0f;
    const float slope_s = component(n_in_second, s), sign_s = slope_s < 0 ? 1.0f : -1.0f;
    const Vec3 m = sign_s * cycle(column(pair.axes_b, s), k);  // outward from the second's face

    const Vec3 lean = (1.0f / n.z) * n;
    const auto place = [&](Vec3 x) { return Place{x.x - x.z * lean.x, x.y - x.z * lean.y}; };
    const Place middle = place(h_s.z * m);
    const Place along_1 = place(h_s.x * cycle(column(pair.axes_b, s1), k));
    const Place along_2 = place(h_s.y * cycle(column(pair.axes_b, s2), k));
    constexpr float turn[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};

    ClipPolygon polygon;
    polygon.count = 4;
    const std::uint32_t faces = face_bit(first, k, sign) | face_bit(second, s, sign_s);
    for (int i = 0; i < 4; ++i) {
        const auto& [sign_1, sign_2] = turn[i];
        polygon.p[i] = middle.p + (sign_1 * along_1.p + sign_2 * along_2.p);
        polygon.q[i] = middle.q + (sign_1 * along_1.q + sign_2 * along_2.q);
        polygon.feature[i] = faces | face_bit(second, s1, sign_1) | face_bit(second, s2, sign_2);
    }

    // The first box's face stands about the place of its middle.
    const Place around = place(Vec3{0, 0, sign * h.z} - t);
    const float snap = relative_snap * min(min(h.x, h.y), min(h_s.x, h_s.y));
    const Side sides_p[2] = {{1, around.p + h.x, face_bit(first, k1, 1)},
                             {-1, h.x - around.p, face_bit(first, k1, -1)}};
    const Side sides_q[2] = {{1, around.q + h.y, face_bit(first, k2, 1)},
                             {-1, h.y - around.q, face_bit(first, k2, -1)}};
    for (const Side& side : sides_p) cut_off(polygon, polygon.p, polygon.q, side, snap);
    for (const Side& side : sides_q) cut_off(polygon, polygon.q, polygon.p, side, snap);

    // Both faces' heights along n above the plane through the second box's centre.
    const Place center = place(-t);
    polygon.center_p = center.p, polygon.center_q = center.q;
    polygon.axis = k;
    polygon.height = (h.z - sign * t.z) / (sign * n.z);
    const float steepness = 1.0f / absolute(slope_s);
    const float level = -h_s.z * steepness - polygon.height;
    const float climb_p = m.x * steepness, climb_q = m.y * steepness;
    for (int i = 0; i < polygon.count; ++i) {
        polygon.separation[i] = level + (polygon.p[i] * climb_p + polygon.q[i] * climb_q);
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

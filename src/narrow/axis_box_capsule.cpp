// A box and a capsule: the capsule's core is a segment, so the question is how far a segment is
// from a box, or how deep within it.
//
// Symbols, along the box's axes: h half extents, x(t) = c + t d the core's points, |t| <= 1,
// e(t) = x less the box's nearest point. The squared distance |e|^2 is convex in t and half its
// slope d.e is linear between the few t at which x crosses the plane of a face: so where the slope
// changes its sign is found without a case for each region.
//
// A core that enters the box leaves by the face, or across one of the box's edges and itself, along
// which it is least deep: the box grown by the core is a polytope with no other faces. Worked in
// binary64, so that rounding chooses nothing that can be seen; results are rounded once.

#include "narrow/closed_forms.h"

namespace cairn {
namespace {

// A slope, as a share of what it is made of, that counts as level.
constexpr double level_share = 1e-12;
// An edge within this sine of the core spans no axis with it: its faces stand for it.
constexpr double parallel_edge = 1e-4;
// A face is left only for an edge that is better by this share of the box: of equals, the face.
constexpr double clearly_better = 1e-5;

double absolute(double x) { return x < 0 ? -x : x; }

struct CoreInBox {
    double h[3], c[3], d[3];

    double at(int k, double t) const { return c[k] + t * d[k]; }
    double excess(int k, double t) const {
        const double x = at(k, t);
        return x > h[k] ? x - h[k] : x < -h[k] ? x + h[k] : 0;
    }
    double nearest(int k, double t) const {
        const double x = at(k, t);
        return x > h[k] ? h[k] : x < -h[k] ? -h[k] : x;
    }
    double slope(double t) const {
        double sum = 0, size = 0;
        for (int k = 0; k < 3; ++k) {
            sum += d[k] * excess(k, t);
            size += absolute(d[k]) * (absolute(c[k]) + absolute(d[k]) + h[k]);
        }
        return absolute(sum) <= level_share * size ? 0 : sum;
    }
};

// Between `low`, before which the core approaches the box, and `high`, after which it leaves it.
struct Turning {
    double low = -1, high = 1;
    double slope_low = 0, slope_high = 0;
    double first_level = 2, last_level = -2;

    void see(double t, double slope) {
        if (slope < 0) {
            if (t >= low) low = t, slope_low = slope;
        } else if (slope > 0) {
            if (t <= high) high = t, slope_high = slope;
        } else {
            if (t < first_level) first_level = t;
            if (t > last_level) last_level = t;
        }
    }
};

// The t of the core's point that is nearest to the box; of several, the middle.
double find_nearest_place(const CoreInBox& core) {
    Turning turning;
    const double first = core.slope(-1), last = core.slope(1);
    if (first > 0) return -1;
    if (last < 0) return 1;
    turning.see(-1, first);
    turning.see(1, last);
    for (int k = 0; k < 3; ++k) {
        if (core.d[k] == 0) continue;
        for (const double face : {-core.h[k], core.h[k]}) {
            const double t = (face - core.c[k]) / core.d[k];
            if (t > turning.low && t < turning.high) turning.see(t, core.slope(t));
        }
    }
    if (turning.first_level <= turning.last_level)
        return 0.5 * (turning.first_level + turning.last_level);
    const double rise = turning.slope_high - turning.slope_low;
    if (!(rise > 0)) return 0.5 * (turning.low + turning.high);
    return turning.low - turning.slope_low * (turning.high - turning.low) / rise;
}

Vec3 to_vec3(const double (&v)[3]) { return {float(v[0]), float(v[1]), float(v[2])}; }

// Of a core that is apart from the box at the place t, by `distance`.
Axis leave_apart(const CoreInBox& core, double t, double distance, double radius) {
    double n[3], on_box[3], on_capsule[3];
    for (int k = 0; k < 3; ++k) {
        n[k] = core.excess(k, t) / distance;
        on_box[k] = core.nearest(k, t);
        on_capsule[k] = t * core.d[k] - radius * n[k];
    }
    return {to_vec3(n), float(distance - radius), to_vec3(on_box), to_vec3(on_capsule)};
}

struct WayOut {
    double separation = -1e300;  // of the core, along n
    double n[3] = {};
    double t = 0;  // the core's deepest point
};

// The deepest place of what is over the box's face across k; of a level core, the middle.
double find_deepest_over_face(const CoreInBox& core, int k, double sign) {
    double low = -1, high = 1;
    for (int i = 0; i < 3; ++i) {
        if (i == k || core.d[i] == 0) continue;
        const double a = (-core.h[i] - core.c[i]) / core.d[i];
        const double b = (core.h[i] - core.c[i]) / core.d[i];
        const double enter = a < b ? a : b, leave = a < b ? b : a;
        if (enter > low) low = enter < high ? enter : high;
        if (leave < high) high = leave > low ? leave : low;
    }
    const double slope = sign * core.d[k];
    return slope == 0 ? 0.5 * (low + high) : slope > 0 ? low : high;
}

WayOut find_nearest_face(const CoreInBox& core) {
    WayOut best;
    for (int k = 0; k < 3; ++k) {
        const double separation = absolute(core.c[k]) - (core.h[k] + absolute(core.d[k]));
        if (separation <= best.separation) continue;
        const double sign = core.c[k] < 0 ? -1 : 1;
        best = {separation, {}, 0};
        best.n[k] = sign;
        best.t = find_deepest_over_face(core, k, sign);
    }
    return best;
}

// Across the box's edges along i and the core, where that is better than `best`.
void try_edges(const CoreInBox& core, int i, WayOut& best) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double squared = core.d[j] * core.d[j] + core.d[k] * core.d[k];
    if (!(squared > parallel_edge * parallel_edge * (squared + core.d[i] * core.d[i]))) return;
    const double inverse = 1 / square_root(squared);
    const double along = (core.c[k] * core.d[j] - core.c[j] * core.d[k]) * inverse;
    const double sign = along < 0 ? -1 : 1;
    const double n_j = -sign * core.d[k] * inverse, n_k = sign * core.d[j] * inverse;
    const double separation =
        absolute(along) - (core.h[j] * absolute(n_j) + core.h[k] * absolute(n_k));
    const double smallest = core.h[j] < core.h[k] ? core.h[j] : core.h[k];
    if (separation <= best.separation + clearly_better * smallest) return;
    best = {separation, {}, 0};
    best.n[j] = n_j, best.n[k] = n_k;
    // Pushed out along n, the core crosses the edge at this point.
    const double on_j = (n_j < 0 ? -core.h[j] : core.h[j]) + separation * n_j - core.c[j];
    const double on_k = (n_k < 0 ? -core.h[k] : core.h[k]) + separation * n_k - core.c[k];
    const double t = (on_j * core.d[j] + on_k * core.d[k]) / squared;
    best.t = t < -1 ? -1 : t > 1 ? 1 : t;
}

// Of a core that touches or enters the box.
Axis leave_within(const CoreInBox& core, double radius) {
    WayOut out = find_nearest_face(core);
    for (int i = 0; i < 3; ++i) try_edges(core, i, out);
    double on_box[3], on_capsule[3];
    for (int k = 0; k < 3; ++k) {
        const double x = core.at(k, out.t) - out.separation * out.n[k];
        on_box[k] = x < -core.h[k] ? -core.h[k] : x > core.h[k] ? core.h[k] : x;
        on_capsule[k] = out.t * core.d[k] - radius * out.n[k];
    }
    return {to_vec3(out.n), float(out.separation - radius), to_vec3(on_box), to_vec3(on_capsule)};
}

Axis find_axis_in_box_frame(const CoreInBox& core, double radius) {
    const double t = find_nearest_place(core);
    double squared = 0, size = 0;
    for (int k = 0; k < 3; ++k) {
        squared += core.excess(k, t) * core.excess(k, t);
        const double reach = absolute(core.c[k]) + absolute(core.d[k]);
        if (reach > size) size = reach;
    }
    const double distance = square_root(squared);
    // So near the surface the pose's own rounding would choose the direction.
    constexpr double rounding = 4 * double(float_epsilon);
    return distance > rounding * size ? leave_apart(core, t, distance, radius)
                                      : leave_within(core, radius);
}

}  // namespace

Axis find_axis_box_capsule(const Box& box, const Mat3& box_axes, const Capsule& capsule,
                           Vec3 capsule_axis, Vec3 offset) {
    const Vec3 h = box.half_extents, c = multiply_transposed(box_axes, offset);
    const Vec3 d = 0.5f * capsule.height * multiply_transposed(box_axes, capsule_axis);
    const CoreInBox core = {{double(h.x), double(h.y), double(h.z)},
                            {double(c.x), double(c.y), double(c.z)},
                            {double(d.x), double(d.y), double(d.z)}};
    const Axis local = find_axis_in_box_frame(core, double(capsule.radius));
    return {box_axes * local.normal, local.separation, box_axes * local.point_a,
            box_axes * local.point_b};
}

}  // namespace cairn

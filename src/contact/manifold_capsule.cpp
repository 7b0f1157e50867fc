// Stretches along which a capsule lies, and their ends as contact points; see manifold_capsule.h.
//
// Symbols: n the normal from A to B, u a core's unit axis, s a place on a core.

#include "contact/manifold_capsule.h"

#include "contact/feature.h"

namespace cairn {
namespace {

// Stretches shorter than this part of the radius are a point.
constexpr float shortest_share = 1e-3f;
// A core lies along another, or along an edge, within this cosine: beyond it, ends that are near
// enough to touch are near the crossing.
constexpr float along_cosine = 0.95f;
// A normal this near to a box's face is of that face.
constexpr float facing_cosine = 0.95f;
// How far across the normal two points of a stretch's end may lie, as a part of the radius.
constexpr float farthest_aside = 0.3f;
// An end this part of the radius beyond a face's side still lies over it: flush ones keep their
// names.
constexpr float flush_share = 1e-4f;
// A witness counts beside the ends if it is deeper by this part of the radius, and is one of them
// if it is nearer than that part.
constexpr float deeper_share = 1e-5f;
constexpr float nearest_share = 0.25f;

// One end of a stretch: the place on the capsule's core and the point that lies there.
struct StretchEnd {
    Vec3 core;
    ManifoldPoint point;
};

std::uint32_t end_bit(FaceOwner owner, float sign) { return face_bit(owner, 1, sign); }

// The ends of a stretch, or the witness at one of them or between; `core` is the place of the
// witness.
void push_stretch(Manifold& manifold, StretchEnd first, StretchEnd last, const Axis& axis,
                  Vec3 core, float radius, float max_separation) {
    const float deepest = min(first.point.separation, last.point.separation);
    const bool is_deeper = axis.separation < deepest - deeper_share * radius;
    bool is_at_end = false;
    for (StretchEnd* end : {&first, &last}) {
        // No point is deeper than the least push that parts the shapes.
        end->point.separation = max(end->point.separation, axis.separation);
        const bool at_end =
            length_squared(end->core - core) < square(nearest_share * radius) && !is_at_end;
        if (is_deeper && at_end) {
            Manifold witness;
            push_witness(witness, axis, end->point.feature);
            end->point = witness.points[0];
            is_at_end = true;
        }
        if (end->point.separation <= max_separation) push_point(manifold, end->point);
    }
    if (is_deeper && !is_at_end) push_witness(manifold, axis, 0);
    if (manifold.point_count == 0) push_witness(manifold, axis, 0);
}

// The common stretch of two cores, as places on the first, and which of them end it.
struct CommonStretch {
    float low = 0, high = 0;
    bool low_is_b = false, high_is_b = false;
    bool b_is_turned = false;  // b's axis points against a's
};

CommonStretch find_common_stretch(const Segment& a, const Segment& b, float cosine) {
    const float middle = dot(a.axis, b.center - a.center);
    const float reach = b.half * absolute(cosine);
    CommonStretch stretch;
    stretch.low_is_b = middle - reach > -a.half;
    stretch.high_is_b = middle + reach < a.half;
    stretch.low = stretch.low_is_b ? middle - reach : -a.half;
    stretch.high = stretch.high_is_b ? middle + reach : a.half;
    stretch.b_is_turned = cosine < 0;
    return stretch;
}

// Two cores at one end of their stretch.
struct CoreEnd {
    float on_a = 0, on_b = 0;
    std::uint32_t feature = 0;
};

CoreEnd find_core_end(const Segment& a, const Segment& b, const CommonStretch& stretch,
                      float sign) {
    const bool ends_on_b = sign < 0 ? stretch.low_is_b : stretch.high_is_b;
    if (!ends_on_b) {
        const float on_a = sign * a.half;
        return {on_a, find_place(b, point_at(a, on_a)), end_bit(FaceOwner::A, sign)};
    }
    const float sign_b = stretch.b_is_turned ? -sign : sign;
    const float on_b = sign_b * b.half;
    return {find_place(a, point_at(b, on_b)), on_b, end_bit(FaceOwner::B, sign_b)};
}

// What a box and a core are in the box's frame: x(s) = center + s axis.
struct CoreOverBox {
    Vec3 half_extents;
    Segment core;
    float radius = 0;
    Vec3 n;  // from the box to the capsule
    FaceOwner box = FaceOwner::A, capsule = FaceOwner::B;
};

// The stretch of a core within the slabs between some of the box's faces, over one of its faces or
// beside one of its edges.
struct Clip {
    float low = 0, high = 0;
    std::uint32_t low_feature = 0, high_feature = 0;
    std::uint32_t faces = 0;
    int face = 0;   // the box's axis that the normal is steepest along
    int edge = -1;  // and, beside an edge, the one that the edge is along
};

// False where it is beyond the slab across the box's axis k.
bool clip_to_slab(const CoreOverBox& pair, int k, Clip& clip) {
    const float h = component(pair.half_extents, k), c = component(pair.core.center, k);
    const float u = component(pair.core.axis, k);
    const float farthest = h + flush_share * pair.radius;
    const float toward = u < 0 ? -1.0f : 1.0f;
    // Along the side to which the core goes.
    const float low = toward * (c + clip.low * u), high = toward * (c + clip.high * u);
    if (low > farthest || high < -farthest) return false;
    if (low < -farthest) {
        clip.low = clamp((-toward * h - c) / u, clip.low, clip.high);
        clip.low_feature = face_bit(pair.box, k, -toward);
    }
    if (high > farthest) {
        clip.high = clamp((toward * h - c) / u, clip.low, clip.high);
        clip.high_feature = face_bit(pair.box, k, toward);
    }
    return true;
}

// From a place x of the core to the box's surface below it, and how long that is: negative within
// the box.
struct Below {
    Vec3 way;
    float distance = 0;
};

Below find_below(const CoreOverBox& pair, const Clip& clip, Vec3 x) {
    const Vec3 h = pair.half_extents;
    const Vec3 way = max(min(x, h), -h) - x;
    const int k = clip.face;
    const float sign = component(pair.n, k) < 0 ? -1.0f : 1.0f;
    const float height = sign * component(x, k) - component(h, k);
    if (clip.edge < 0 && height <= 0) return {-height * sign * unit_axis(k), height};
    if (way != Vec3{}) return {way, length(way)};
    // Within the box, beside an edge that lies along the normal.
    const float depth = dot(absolute(pair.n), h) - dot(pair.n, x);
    return {depth * pair.n, -depth};
}

// Whether the normal is of a face, or of an edge beside which the core lies; the stretch there.
bool find_stretch(const CoreOverBox& pair, Clip& clip) {
    clip.low = -pair.core.half, clip.high = pair.core.half;
    clip.low_feature = end_bit(pair.capsule, -1), clip.high_feature = end_bit(pair.capsule, 1);
    const Vec3 n = absolute(pair.n);
    const int k = clip.face = n.x >= n.y ? (n.x >= n.z ? 0 : 2) : (n.y >= n.z ? 1 : 2);
    clip.faces = face_bit(pair.box, k, component(pair.n, k));
    if (component(n, k) >= facing_cosine) {
        if (!clip_to_slab(pair, (k + 1) % 3, clip)) return false;
        if (!clip_to_slab(pair, (k + 2) % 3, clip)) return false;
    } else {
        const int i = n.x <= n.y ? (n.x <= n.z ? 0 : 2) : (n.y <= n.z ? 1 : 2);
        if (component(n, i) > 1 - along_cosine) return false;
        if (absolute(component(pair.core.axis, i)) < along_cosine) return false;
        const int j = 3 - i - k;
        clip.edge = i;
        clip.faces |= face_bit(pair.box, j, component(pair.n, j));
        if (!clip_to_slab(pair, i, clip)) return false;
    }
    return clip.high - clip.low > shortest_share * pair.radius;
}

}  // namespace

void push_plane_capsule(Manifold& manifold, const Segment& core, float radius, const Axis& axis,
                        bool plane_is_a, float max_separation) {
    const Vec3 n = plane_is_a ? axis.normal : -axis.normal;
    const float slope = dot(n, core.axis);
    if (2 * core.half <= shortest_share * radius) return push_witness(manifold, axis, 0);
    for (const float sign : {-1.0f, 1.0f}) {
        // From the lower end the other one is higher by the rise.
        const float separation = axis.separation + max(0, 2 * core.half * sign * slope);
        if (!(separation <= max_separation)) continue;
        const Vec3 arm = sign * core.half * core.axis - (radius + 0.5f * separation) * n;
        const Vec3 from_plane = core.center + arm;
        push_point(manifold, {plane_is_a ? from_plane : arm, plane_is_a ? arm : from_plane,
                              separation, end_bit(plane_is_a ? FaceOwner::B : FaceOwner::A, sign)});
    }
}

void push_capsule_capsule(Manifold& manifold, const Segment& core_a, float radius_a,
                          const Segment& core_b, float radius_b, const Axis& axis,
                          float max_separation) {
    const Vec3 n = axis.normal;
    const float radius = min(radius_a, radius_b), sum = radius_a + radius_b;
    const float cosine = dot(core_a.axis, core_b.axis);
    const CommonStretch stretch = find_common_stretch(core_a, core_b, cosine);
    if (absolute(cosine) < along_cosine || stretch.high - stretch.low <= shortest_share * radius)
        return push_witness(manifold, axis, 0);
    StretchEnd ends[2];
    for (const int i : {0, 1}) {
        const CoreEnd end = find_core_end(core_a, core_b, stretch, i == 0 ? -1.0f : 1.0f);
        const Vec3 arm_a = end.on_a * core_a.axis, arm_b = end.on_b * core_b.axis;
        const Vec3 gap = (core_b.center - arm_a) + arm_b;
        const float along = dot(gap, n);
        const Vec3 aside = gap - along * n;
        if (length_squared(aside) > square(farthest_aside * radius))
            return push_witness(manifold, axis, 0);
        const float distance = along > 0 ? length(gap) : along;
        // Halfway between the two surfaces.
        const Vec3 from_a = arm_a + 0.5f * (gap + (radius_a - radius_b) * n);
        ends[i] = {arm_a, {from_a, arm_b + (from_a - arm_a) - gap, distance - sum, end.feature}};
    }
    const Vec3 witness = find_place(core_a, axis.point_a) * core_a.axis;
    push_stretch(manifold, ends[0], ends[1], axis, witness, radius, max_separation);
}

void push_box_capsule(Manifold& manifold, Vec3 half_extents, const Mat3& box_axes,
                      const Segment& core, float radius, const Axis& axis, bool box_is_a,
                      float max_separation) {
    const Vec3 n = box_is_a ? axis.normal : -axis.normal;
    const CoreOverBox pair = {half_extents,
                              {multiply_transposed(box_axes, core.center),
                               multiply_transposed(box_axes, core.axis), core.half},
                              radius,
                              multiply_transposed(box_axes, n),
                              box_is_a ? FaceOwner::A : FaceOwner::B,
                              box_is_a ? FaceOwner::B : FaceOwner::A};
    Clip clip;
    if (!find_stretch(pair, clip)) return push_witness(manifold, axis, 0);
    StretchEnd ends[2];
    for (const int i : {0, 1}) {
        const Vec3 arm = (i == 0 ? clip.low : clip.high) * pair.core.axis;
        const Vec3 x = pair.core.center + arm;
        const Below below = find_below(pair, clip, x);
        if (length_squared(below.way + below.distance * pair.n) > square(farthest_aside * radius))
            return push_witness(manifold, axis, 0);
        // Halfway between the two surfaces.
        const Vec3 halfway = 0.5f * (below.way - radius * pair.n);
        const Vec3 from_capsule = box_axes * (arm + halfway);
        const Vec3 from_box = box_axes * (x + halfway);
        ends[i] = {arm,
                   {box_is_a ? from_box : from_capsule, box_is_a ? from_capsule : from_box,
                    below.distance - radius,
                    clip.faces | (i == 0 ? clip.low_feature : clip.high_feature)}};
    }
    const Vec3 on_capsule = multiply_transposed(box_axes, box_is_a ? axis.point_b : axis.point_a);
    const Segment own = {{}, pair.core.axis, pair.core.half};
    const Vec3 witness = find_place(own, on_capsule) * pair.core.axis;
    push_stretch(manifold, ends[0], ends[1], axis, witness, radius, max_separation);
}

}  // namespace cairn

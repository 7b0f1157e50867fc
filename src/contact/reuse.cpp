// Contacts carried along; see reuse.h.

#include "contact/reuse.h"

namespace cairn {
namespace {

// How far a point may slide or open, as a share of the smaller shape's size, and the bodies turn
// against each other, in radians: what this hides is a tenth of what tolerances forgive.
constexpr float farthest_share = 5e-5f;
constexpr float farthest_turn = 1e-4f;
// Beyond this turn of either body, in radians, small turns no longer add as vectors.
constexpr float farthest_common_turn = 0.1f;

Mat3 operator-(const Mat3& a, const Mat3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

// How far B's half of each point has come away from A's.
std::array<Vec3, 4> find_gaps(int count, const FaceSighting& seen, const BodyPlace& a,
                              const BodyPlace& b) {
    const Vec3 moved_a = a.position - seen.place_a.position;
    const Vec3 moved_b = b.position - seen.place_b.position;
    const Vec3 drift = moved_b - moved_a;
    Mat3 change_a = {{}, {}, {}}, change_b = {{}, {}, {}};
    if (a.rotation != seen.place_a.rotation)
        change_a = to_matrix(a.rotation) - to_matrix(seen.place_a.rotation);
    if (b.rotation != seen.place_b.rotation)
        change_b = to_matrix(b.rotation) - to_matrix(seen.place_b.rotation);
    std::array<Vec3, 4> gaps;
    for (std::size_t i = 0; i < std::size_t(count); ++i) {
        gaps[i] = drift + (change_b * seen.arms_b[i] - change_a * seen.arms_a[i]);
    }
    return gaps;
}

}  // namespace

Vec3 half_turn(Quat to, Quat from) {
    const Quat q = to * conjugate(from);
    return q.w < 0 ? Vec3{-q.x, -q.y, -q.z} : Vec3{q.x, q.y, q.z};
}

void remember_face(const Contact& contact, const BodyPlace& a, const BodyPlace& b,
                   FaceSighting::Owner owner, float within, FaceSighting& seen) {
    seen.owner = owner;
    seen.place_a = a;
    seen.place_b = b;
    const Quat rotation = owner == FaceSighting::Owner::A ? a.rotation : b.rotation;
    seen.normal = rotate_inverse(rotation, contact.normal);
    seen.within = within;
    for (std::size_t i = 0; i < std::size_t(contact.point_count); ++i) {
        seen.arms_a[i] = contact.points[i].arm_a.core;
        seen.arms_b[i] = contact.points[i].arm_b.core;
        seen.separations[i] = contact.points[i].separation;
    }
}

bool follow_face(Contact& contact, const FaceSighting& seen, const BodyPlace& a,
                 const BodyPlace& b) {
    const Vec3 turn_a = half_turn(a.rotation, seen.place_a.rotation);
    const Vec3 turn_b = half_turn(b.rotation, seen.place_b.rotation);
    constexpr float common = 0.5f * farthest_common_turn, against = 0.5f * farthest_turn;
    if (!(length_squared(turn_a) <= common * common)) return false;
    if (!(length_squared(turn_b - turn_a) <= against * against)) return false;
    const auto count = std::size_t(contact.point_count);
    const std::array<Vec3, 4> gaps = find_gaps(contact.point_count, seen, a, b);
    const float farthest = farthest_share * contact.size;
    for (std::size_t i = 0; i < count; ++i) {
        if (!(length_squared(gaps[i]) <= farthest * farthest)) return false;
    }
    const Quat owner = seen.owner == FaceSighting::Owner::A ? a.rotation : b.rotation;
    const Vec3 n = contact.normal = rotate(owner, seen.normal);
    const Mat3 axes_a = to_matrix(a.rotation), axes_b = to_matrix(b.rotation);
    for (std::size_t i = 0; i < count; ++i) {
        ContactPoint& point = contact.points[i];
        const float opened = dot(n, gaps[i]);
        // The point stays halfway between the surfaces, and across the normal with its corner.
        const Vec3 halfway = (0.5f * opened) * n;
        const Vec3 slid = gaps[i] - opened * n;
        const Vec3 on_a = contact.stays_with_a ? halfway : halfway + slid;
        const Vec3 on_b = contact.stays_with_a ? halfway + slid : halfway;
        point.arm_a.core = seen.arms_a[i] + multiply_transposed(axes_a, on_a);
        point.arm_b.core = seen.arms_b[i] - multiply_transposed(axes_b, on_b);
        point.separation = seen.separations[i] + opened;
    }
    clear_impulses(contact);
    return true;
}

}  // namespace cairn

#pragma once
// What a look at two shapes found, carried along while they hardly move against each other: whether
// the pair must be looked at anew, and its points as they are now.
//
// A face on a face or on a plane keeps its points while every one of them has slid or opened by no
// more than a small share of the shapes' size since the last look, and the bodies have turned
// against each other by no more than a small angle. The points move with the bodies: with d how
// far B's center has moved beyond A's, c the arms in the bodies' frames and R, R0 the rotations now
// and then, the two halves of a point have come apart by
//
//     g = d + (R_b - R0_b) c_b - (R_a - R0_a) c_a
//
// so its separation is the one found plus n.g, with the normal n fixed in the body whose face it
// is; what is left out is of second order in a small angle.

#include "contact/contact.h"

namespace cairn {

struct BodyPlace {
    Position position;  // of the center of mass
    Quat rotation;
};

// What the last look at two shapes of which one showed a face found, and where the bodies were.
struct FaceSighting {
    enum class Owner : std::uint8_t { A, B };
    Owner owner = Owner::A;  // of the face
    BodyPlace place_a, place_b;
    Vec3 normal;  // in the owner's frame
    std::array<Vec3, 4> arms_a, arms_b;
    std::array<float, 4> separations = {};
    float within = 0;  // points farther apart than this were left out
};

// Points that were just found, none of which has an arm in two parts.
void remember_face(const Contact& contact, const BodyPlace& a, const BodyPlace& b,
                   FaceSighting::Owner owner, float within, FaceSighting& seen);

// Moves the points to the present, with no impulses over the step; false, and nothing done, where
// the bodies have moved too much against each other.
bool follow_face(Contact& contact, const FaceSighting& seen, const BodyPlace& a,
                 const BodyPlace& b);

// The sine of half the angle of the turn between two rotations, along its axis.
Vec3 half_turn(Quat to, Quat from);

}  // namespace cairn

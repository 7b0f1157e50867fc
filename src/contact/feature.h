#pragma once
// Names for the features of boxes and capsules, and for the pair of them that meets in a contact
// point.
//
// A feature of a box is the set of the faces that it lies on, a bit a face: a face has one, an edge
// two, a vertex three. What two features share is the smallest feature that holds both: the sets of
// an edge's two ends have the edge's two faces in common. A pair of features is the set of A's
// faces and B's: it is the same whenever the same features meet, in whatever order the points were
// found and whichever face was clipped against which. A capsule's two ends are named as the faces
// of a box across y; where it touches along its side, and for spheres and planes, which have one
// feature only, nothing is added.

#include <cstdint>

namespace cairn {

// Whose faces are meant: how far their bits are shifted.
enum class FaceOwner : std::uint8_t { A = 0, B = 8 };

// The face across the box's axis, on the side that `sign` says.
constexpr std::uint32_t face_bit(FaceOwner owner, int axis, float sign) {
    return 1u << (int(owner) + 2 * axis + (sign < 0 ? 1 : 0));
}

}  // namespace cairn

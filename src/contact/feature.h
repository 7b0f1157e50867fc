#pragma once
// Names for the features of shapes, and for the pair of them that meets in a contact point.
//
// A feature of a box is three signs, one an axis: +1 or -1 where it lies on that face, 0 where it
// goes from one to the other. A vertex has no 0, an edge one, a face two. So (+1, 0, -1) is an
// edge, and what two features have in common is the feature that holds both: two vertices of an
// edge give the edge. Where the features of A and B that meet are the same, the number is the same,
// in whatever order the points were found and whichever face was clipped against which.

#include <cstdint>

namespace cairn {

struct BoxFeature {
    std::int8_t signs[3] = {0, 0, 0};
};

// The smallest feature that holds both.
constexpr BoxFeature common_feature(const BoxFeature& p, const BoxFeature& q) {
    BoxFeature common;
    for (int k = 0; k < 3; ++k) {
        common.signs[k] = p.signs[k] == q.signs[k] ? p.signs[k] : std::int8_t(0);
    }
    return common;
}

// 1 to 27; 0 stands for a shape with a single feature, a sphere or a plane.
constexpr std::uint32_t feature_code(const BoxFeature& f) {
    return std::uint32_t(1 + (f.signs[0] + 1) + 3 * (f.signs[1] + 1) + 9 * (f.signs[2] + 1));
}

constexpr std::uint32_t feature_pair(std::uint32_t code_a, std::uint32_t code_b) {
    return code_a | code_b << 8;
}

}  // namespace cairn

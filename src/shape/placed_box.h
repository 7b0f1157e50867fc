#pragma once
// A box turned along some common axes; where its centre lies is said beside it.

#include "math/mat3.h"

namespace cairn {

struct PlacedBox {
    Vec3 half_extents;
    Mat3 axes;  // the box's own axes, along the common ones
};

// The box's axis k.
constexpr Vec3 column(const Mat3& axes, int k) {
    return k == 0 ? axes.x : k == 1 ? axes.y : axes.z;
}

}  // namespace cairn

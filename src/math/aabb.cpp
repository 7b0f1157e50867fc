// Outward rounding of bounding boxes; see aabb.h.

#include "math/aabb.h"

namespace cairn {
inline namespace kernel {

namespace {

// The next binary32 number in the direction of `sign` (+1 or -1); infinities stay.
float next(float x, int sign) {
    auto bits = __builtin_bit_cast(std::int32_t, x);
    if ((bits & 0x7fffffff) == 0) return sign > 0 ? 1.40129846e-45f : -1.40129846e-45f;
    if (!is_finite(x)) return x;
    bits += (bits < 0) == (sign > 0) ? -1 : 1;
    return __builtin_bit_cast(float, bits);
}

}  // namespace

float round_down(double x) {
    const auto rounded = float(x);
    return double(rounded) > x ? next(rounded, -1) : rounded;
}

float round_up(double x) {
    const auto rounded = float(x);
    return double(rounded) < x ? next(rounded, 1) : rounded;
}

Aabb box_around(Position center, Vec3 half) {
    return {{round_down(center.x - double(half.x)), round_down(center.y - double(half.y)),
             round_down(center.z - double(half.z))},
            {round_up(center.x + double(half.x)), round_up(center.y + double(half.y)),
             round_up(center.z + double(half.z))}};
}

}  // namespace kernel
}  // namespace cairn

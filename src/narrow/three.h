#pragma once
// A vector in one register: three numbers side by side, each of which goes through the same IEEE
// operations that a single float would. The fourth lane is 0 wherever it counts.
//
// For the kernels that see a pair of boxes several times a step; elsewhere Vec3 reads better.

#include <cstdint>

#include "math/vec3.h"

namespace cairn {

typedef float Three __attribute__((vector_size(16)));
typedef std::int32_t Choice __attribute__((vector_size(16)));

inline namespace kernel {

inline Three three(Vec3 v) { return Three{v.x, v.y, v.z, 0}; }
inline Vec3 vec3(Three v) { return {v[0], v[1], v[2]}; }

inline Three absolute(Three v) { return Three(Choice(v) & 0x7fffffff); }
inline Three min(Three a, Three b) { return b < a ? b : a; }
inline Three max(Three a, Three b) { return a < b ? b : a; }
inline float sum(Three v) { return v[0] + v[1] + v[2]; }
inline float dot(Three a, Three b) { return sum(a * b); }
inline float largest(Three v) { return max(v[0], max(v[1], v[2])); }
inline float smallest(Three v) { return min(v[0], min(v[1], v[2])); }
inline bool any(Choice choice) {
    const Choice half = choice | __builtin_shufflevector(choice, choice, 2, 3, 0, 1);
    return (half[0] | half[1]) != 0;
}

// True in lane k alone: a single lane written by itself would have to wait in memory for the
// others.
inline Choice lane(int k) {
    static constexpr Choice lanes[3] = {{-1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}};
    return lanes[k];
}
inline Three unit_three(int k) { return lane(k) ? Three{1, 1, 1, 0} : Three{}; }

// Lane k holds what was in the lane after it in turn, or in the one before it.
inline Three next(Three v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); }
inline Three last(Three v) { return __builtin_shufflevector(v, v, 2, 0, 1, 3); }
inline Three cross(Three a, Three b) { return next(a) * last(b) - last(a) * next(b); }
// Turned so that lane k comes third.
inline Three turn_to(Three v, int k) { return k == 0 ? next(v) : k == 1 ? last(v) : v; }

}  // namespace kernel
}  // namespace cairn

#pragma once
// Scalar functions with the same bits on every machine: IEEE additions, products, quotients and
// square roots only, never libm.

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace cairn {
inline namespace kernel {

inline constexpr float float_epsilon = std::numeric_limits<float>::epsilon();

// A compiler turns these into one instruction each; std::min and std::max bind references.
constexpr float min(float a, float b) { return b < a ? b : a; }
constexpr float max(float a, float b) { return a < b ? b : a; }
constexpr float clamp(float x, float low, float high) { return min(max(x, low), high); }
constexpr float square(float x) { return x * x; }
constexpr float absolute(float x) { return x < 0 ? -x : x; }
inline float square_root(float x) { return __builtin_sqrtf(x); }
inline double square_root(double x) { return __builtin_sqrt(x); }

/// True for every number but NaN and the infinities, whatever the compiler assumes.
inline bool is_finite(float x) {
    return (__builtin_bit_cast(std::uint32_t, x) & 0x7f800000u) != 0x7f800000u;
}
inline bool is_finite(double x) {
    return (__builtin_bit_cast(std::uint64_t, x) & 0x7ff0000000000000u) != 0x7ff0000000000000u;
}

struct SineCosine {
    double sine;
    double cosine;
};
/// Error below 1e-15 for |radians| up to 1e6; the argument is reduced by the half turns in it.
SineCosine sine_cosine(double radians);
/// Error below 1e-15; (0, 0) gives 0.
double exact_arc_tangent2(double y, double x);

}  // namespace kernel
}  // namespace cairn

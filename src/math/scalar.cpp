// Sine, cosine and arc tangent by argument reduction and power series, in binary64.
//
// sine and cosine: x = k pi/2 + r with |r| <= pi/4, pi/2 split in three so that k times each part
// is exact for |k| < 2^20 (Cody and Waite); then the Taylor series to r^17, whose first neglected
// term is below 1e-17 at pi/4. arc tangent: the quotient folded to [0, 1], then twice through
// atan(x) = 2 atan(x / (1 + sqrt(1 + x^2))), which leaves |x| <= 0.199; the series to x^21 then
// errs below 1e-17.

#include "math/scalar.h"

namespace cairn {
inline namespace kernel {

SineCosine sine_cosine(double radians) {
    constexpr double two_over_pi = 0.63661977236758134308;
    // pi/2 in pieces of 33 bits.
    constexpr double half_pi_high = 1.57079632673412561417e+00;
    constexpr double half_pi_middle = 6.07710050630396597660e-11;
    constexpr double half_pi_low = 2.02226624879595063154e-21;

    if (!is_finite(radians) || radians > 1e9 || radians < -1e9) return {0, 1};
    const double turns = radians * two_over_pi;
    const auto quadrant = static_cast<std::int64_t>(turns + (turns < 0 ? -0.5 : 0.5));
    const auto k = static_cast<double>(quadrant);
    const double r = ((radians - k * half_pi_high) - k * half_pi_middle) - k * half_pi_low;
    const double z = r * r;

    const double s =
        r +
        r * z *
            (-1.0 / 6 +
             z * (1.0 / 120 + z * (-1.0 / 5040 +
                                   z * (1.0 / 362880 + z * (-1.0 / 39916800 +
                                                            z * (1.0 / 6227020800.0 +
                                                                 z * (-1.0 / 1307674368000.0 +
                                                                      z / 355687428096000.0)))))));
    const double c =
        1 - 0.5 * z +
        z * z *
            (1.0 / 24 +
             z * (-1.0 / 720 +
                  z * (1.0 / 40320 + z * (-1.0 / 3628800 +
                                          z * (1.0 / 479001600.0 + z * (-1.0 / 87178291200.0 +
                                                                        z / 20922789888000.0))))));

    switch (quadrant & 3) {
        case 0: return {s, c};
        case 1: return {c, -s};
        case 2: return {-s, -c};
        default: return {-c, s};
    }
}

double exact_arc_tangent2(double y, double x) {
    constexpr double pi = std::numbers::pi;
    const double absolute_x = x < 0 ? -x : x;
    const double absolute_y = y < 0 ? -y : y;
    const bool steep = absolute_y > absolute_x;
    const double larger = steep ? absolute_y : absolute_x;
    if (!(larger > 0) || !is_finite(larger)) return 0;
    const double smaller = steep ? absolute_x : absolute_y;

    double t = smaller / larger;
    t = t / (1 + square_root(1 + t * t));
    t = t / (1 + square_root(1 + t * t));
    const double z = t * t;
    double series = 0;
    for (int n = 21; n >= 1; n -= 2) series = 1.0 / n - z * series;
    double angle = 4 * t * series;

    if (steep) angle = pi / 2 - angle;
    if (x < 0) angle = pi - angle;
    return y < 0 ? -angle : angle;
}

}  // namespace kernel
}  // namespace cairn

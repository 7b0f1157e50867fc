// Two segments' nearest points; see segment.h.
//
// Symbols: u, v the unit axes, w from a's middle to b's, c = u.v. The lines come closest where
//
//     s = (u.w - c v.w) / (1 - c^2)
//
// Cut to a's length, it gives the nearest place t on b; cut to b's length, t gives s anew, which is
// then right for both.
//
// Source: Ericson, Real-Time Collision Detection, 2005, section 5.1.9. Departures: worked in
// binary64, in which 1 - c^2 of binary32 axes keeps its digits down to angles of 1e-7; where it is
// nothing, the middle of the common stretch.

#include "narrow/segment.h"

namespace cairn {
namespace {

// Axes are parallel whose squared sine is less than this.
constexpr double parallel = 1e-13;

double wide_dot(Vec3 a, Vec3 b) {
    return double(a.x) * double(b.x) + double(a.y) * double(b.y) + double(a.z) * double(b.z);
}
double clamp(double x, double half) { return x < -half ? -half : x > half ? half : x; }

// The middle of what b covers of a, or the end of a that is nearest to b.
double find_middle(double half_a, double middle_b, double half_b) {
    const double low = clamp(middle_b - half_b, half_a), high = clamp(middle_b + half_b, half_a);
    return 0.5 * (low + high);
}

}  // namespace

SegmentPlaces find_closest_places(const Segment& a, const Segment& b) {
    const Vec3 w = b.center - a.center;
    const double uu = wide_dot(a.axis, a.axis), vv = wide_dot(b.axis, b.axis);
    const double uv = wide_dot(a.axis, b.axis);
    const double uw = wide_dot(a.axis, w), vw = wide_dot(b.axis, w);
    const double half_a = a.half, half_b = b.half;
    const double squared_sine = uu * vv - uv * uv;
    const double s = squared_sine > parallel ? clamp((uw * vv - uv * vw) / squared_sine, half_a)
                                             : find_middle(half_a, uw, half_b);
    const double t = (s * uv - vw) / vv;
    const double on_b = clamp(t, half_b);
    const double on_a = on_b == t ? s : clamp((on_b * uv + uw) / uu, half_a);
    return {float(on_a), float(on_b)};
}

}  // namespace cairn

#pragma once
// Whether a body stands still, for all that anybody can see: what must hold of each body of an
// island before the island may sleep.
//
// Watched is the way of the body's farthest point, pose against pose, so that trembling adds up
// to nothing and creeping adds up. Time is cut into halves of the sleep time; a body is still when
// in each of the last two
// - its farthest point stayed within a small share of its size of where the half began,
// - it was never faster than trembling is, and
// - the second half's way was not longer than the first's: what has begun to fall over, or falls
//   in a feeble gravity, is slow but gathers speed.
//
// Box3D and Jolt put a body to sleep that is slower than 5 and 3 cm/s for half a second, whatever
// its size: a marble that rolls across a table stops, a pendulum hangs still beside the vertical.
// Here the slowest steady motion that is kept is 1/1000 of the body's size a second, and what is
// lost by falling asleep is less than anything that is drawn shows.
//
// Symbols: `size` is the geometric mean of a body's thickness (smallest half extent) and its reach
// (farthest point from the center of mass): a long thin thing is neither judged by its length
// alone nor by its thickness.

#include <limits>

#include "math/quat.h"

namespace cairn {

// A body's measures, m.
struct BodyExtent {
    float size = 0;
    float reach = 0;
};

// What is remembered of one body.
struct Stillness {
    Quat rotation;       // when the present half began
    Vec3 moved;          // of the center of mass since then
    float since = 0;     // s since then
    float farthest = 0;  // m, the most that its farthest point was away from there
    float last = std::numeric_limits<float>::infinity();   // `farthest` of the half before
    float first = std::numeric_limits<float>::infinity();  // and of the one before that
};

// What the body did in a step of dt seconds.
struct StepOfBody {
    Vec3 displacement = {};  // of the center of mass
    Quat rotation = {};      // at its end
    Vec3 linear_velocity = {}, angular_velocity = {};
    float dt = 0;
};

// Not still, whatever it was: watched anew from here.
void stir(Stillness& stillness, Quat rotation);

// Takes note of a step; `sleep_time` is how long a body must be still.
void watch(Stillness& stillness, const StepOfBody& step, const BodyExtent& extent,
           float sleep_time);

// Whether it has been still for the sleep time.
bool is_still(const Stillness& stillness, const BodyExtent& extent);

}  // namespace cairn

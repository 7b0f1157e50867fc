// Watching a body's way; see stillness.h.

#include "island/stillness.h"

namespace cairn {

namespace {

// How far the farthest point may come in half the sleep time, as a share of the size. More lets
// heaps sleep sooner and stops slower movers; what rests under the soft step stays ten times
// below.
constexpr float farthest_share = 2.5e-4f;
// What it may be as a speed at any moment, in the same half time: trembling is faster than it is
// wide.
constexpr float speed_share = 1e-3f;
// A way that grows by more than this from one half to the next gathers speed, unless it is no more
// than solvers tremble at rest, a share of the size.
constexpr float growth = 1.5f;
constexpr float trembling_share = 6e-5f;

}  // namespace

void stir(Stillness& stillness, Quat rotation) { stillness = {.rotation = rotation, .moved = {}}; }

void watch(Stillness& stillness, const StepOfBody& step, const BodyExtent& extent,
           float sleep_time) {
    const float half = 0.5f * sleep_time;
    stillness.moved += step.displacement;
    const Quat turn = step.rotation * conjugate(stillness.rotation);
    const float sine = length(Vec3{turn.x, turn.y, turn.z});
    const float way = length(stillness.moved) + 2 * sine * extent.reach;
    const float speed = length(step.linear_velocity) + length(step.angular_velocity) * extent.reach;
    // Negated, so that what is not a number stirs.
    if (!(way <= farthest_share * extent.size && half * speed <= speed_share * extent.size)) {
        stir(stillness, step.rotation);
        return;
    }
    stillness.farthest = max(stillness.farthest, way);
    stillness.since += step.dt;
    // Rounded to whole steps.
    if (stillness.since + 0.5f * step.dt < half) return;
    const float last = stillness.last;
    const float farthest = stillness.farthest;
    stir(stillness, step.rotation);
    stillness.first = last;
    stillness.last = farthest;
}

bool is_still(const Stillness& stillness, const BodyExtent& extent) {
    if (!(stillness.first <= farthest_share * extent.size)) return false;
    return stillness.last <= growth * stillness.first ||
           stillness.last <= trembling_share * extent.size;
}

}  // namespace cairn

// Stillness: what rests is still after the sleep time, what only seems to rest is not.

#include "island/stillness.h"

#include <doctest/doctest.h>

#include <vector>

namespace {

using namespace cairn;

constexpr float sleep_time = 0.5f;
constexpr float dt = 1.0f / 60;
// A cube of edge 1 m.
constexpr BodyExtent cube = {.size = 0.658f, .reach = 0.866f};

// Watches a body whose center is at x(t) and whose turn is angle(t), both about fixed axes, for
// `steps` steps; returns the first step after which it is still, or 0.
template <class Place, class Angle>
int find_still_step(Place x, Angle angle, int steps, const BodyExtent& extent = cube,
                    float step_time = dt, float time = sleep_time) {
    Stillness stillness;
    const auto rotation_at = [&](float t) { return exponential_map({0, 0, angle(t)}); };
    stir(stillness, rotation_at(0));
    for (int k = 1; k <= steps; ++k) {
        const float t = float(k) * step_time, before = float(k - 1) * step_time;
        const float v = (x(t) - x(before)) / step_time;
        const float w = (angle(t) - angle(before)) / step_time;
        watch(stillness,
              {.displacement = {x(t) - x(before), 0, 0},
               .rotation = rotation_at(t),
               .linear_velocity = {v, 0, 0},
               .angular_velocity = {0, 0, w},
               .dt = step_time},
              extent, time);
        if (is_still(stillness, extent)) return k;
    }
    return 0;
}

const auto none = [](float) { return 0.0f; };

// A deterministic sequence in [-1, 1].
float tremble(float t) {
    const auto k = std::uint32_t(t / dt + 0.5f) * 2654435761u;
    return float(k >> 8u) / float(1u << 23u) - 1.0f;
}

}  // namespace

TEST_CASE("a body at rest is still after half a second, not a step sooner or later") {
    CHECK(find_still_step(none, none, 100) == 30);
    CHECK(find_still_step(none, none, 1000, cube, 1.0f / 240) == 120);
    // Steps longer than half the time: two are the least that can tell.
    CHECK(find_still_step(none, none, 10, cube, 1.0f) == 2);
}

TEST_CASE("a ball that rolls by a thousandth and a half of its radius a second is never still") {
    const BodyExtent ball = {.size = 0.5f, .reach = 0.5f};
    const float speed = 0.75e-3f;
    const auto roll = [&](float t) { return speed * t; };
    const auto turn = [&](float t) { return speed / 0.5f * t; };
    CHECK(find_still_step(roll, turn, 3600, ball) == 0);
    // One that turns on the spot, or slides and does not turn, at twice that.
    CHECK(find_still_step(
              none, [&](float t) { return 4 * speed * t; }, 3600, ball) == 0);
    CHECK(find_still_step([&](float t) { return 2 * speed * t; }, none, 3600, ball) == 0);
}

TEST_CASE("a pendulum that swings by a hundredth of its size is not still where it turns back") {
    // Sines by their own recurrence: x'' = -w^2 x.
    for (const float period : {0.5f, 1.0f, 2.0f, 4.0f}) {
        float x = 0.01f * cube.size, v = 0;
        const float w = 6.2831853f / period;
        std::vector<float> path = {x};
        for (int k = 0; k < 3600; ++k) {
            v -= dt * w * w * x;
            x += dt * v;
            path.push_back(x);
        }
        const auto place = [&](float t) { return path[std::size_t(t / dt + 0.5f)]; };
        CHECK(find_still_step(place, none, 3600) == 0);
    }
}

TEST_CASE("a cube let go a tenth of a millimetre beyond its balance on an edge is never still") {
    // x'' = (3.2/s)^2 x until it has visibly begun to fall.
    float x = 1e-4f, v = 0;
    std::vector<float> path = {0};
    for (int k = 0; k < 120; ++k) {
        v += dt * 3.2f * 3.2f * x;
        x += dt * v;
        path.push_back(x - 1e-4f);
    }
    const auto place = [&](float t) { return path[std::size_t(t / dt + 0.5f)]; };
    CHECK(find_still_step(place, none, 120) == 0);
}

TEST_CASE("what falls from rest is not still, be gravity ten thousand times weaker") {
    const auto fall = [](float t) { return 0.5f * 0.981e-3f * t * t; };
    CHECK(find_still_step(fall, none, 600) == 0);
}

TEST_CASE("trembling in place by a ten thousandth of the size keeps nothing awake") {
    const auto shake = [](float t) { return 0.2e-4f * cube.size * tremble(t); };
    CHECK(find_still_step(shake, none, 60) > 0);
    // Twenty times as wide, it is seen.
    const auto rattle = [](float t) { return 20 * 0.2e-4f * cube.size * tremble(t); };
    CHECK(find_still_step(rattle, none, 600) == 0);
}

TEST_CASE("a scene ten times smaller, its times smaller by the root of ten, sleeps as the large") {
    const float root = square_root(10.0f);
    // Comes to rest: x = size (1 - e^-3t) / 20, here by (1 + t)^-8.
    const auto settle = [](float scale, float rate) {
        return [=](float t) {
            const float u = 1 / (1 + rate * t);
            const float u2 = u * u, u4 = u2 * u2;
            return scale * 0.05f * u4 * u4;
        };
    };
    const int large = find_still_step(settle(1, 1), none, 1000);
    const BodyExtent small = {.size = 0.1f * cube.size, .reach = 0.1f * cube.reach};
    CHECK(large > 30);
    CHECK(find_still_step(settle(0.1f, root), none, 1000, small, dt / root, sleep_time / root) ==
          large);
}

TEST_CASE("what is not a number is never still, and does not spoil what comes after") {
    Stillness stillness;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (int k = 0; k < 100; ++k) {
        watch(stillness, {.displacement = {nan, 0, 0}, .rotation = {}, .dt = dt}, cube, sleep_time);
        CHECK(!is_still(stillness, cube));
    }
    for (int k = 0; k < 31; ++k) {
        watch(stillness, {.displacement = {}, .rotation = {}, .dt = dt}, cube, sleep_time);
    }
    CHECK(is_still(stillness, cube));
}

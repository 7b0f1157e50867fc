// Case C04: where two capsules touch, against the distance of two segments in binary64.

#include <algorithm>

#include "pair.h"

namespace cairn::physics {

namespace {

// A capsule's core: its middle and the way to its +y end.
struct Core {
    Vec at, half;
};

double distance_to(const Core& core, const Vec& p) {
    const double squared = dot(core.half, core.half);
    const double t = squared > 0 ? dot(p - core.at, core.half) / squared : 0;
    return length(p - core.at - std::clamp(t, -1.0, 1.0) * core.half);
}

// The least of the ends' distances from the other core, and of the lines' where they cross within.
double distance_of(const Core& a, const Core& b) {
    double least = std::min({distance_to(b, a.at - a.half), distance_to(b, a.at + a.half),
                             distance_to(a, b.at - b.half), distance_to(a, b.at + b.half)});
    const Vec w = b.at - a.at;
    const double aa = dot(a.half, a.half), bb = dot(b.half, b.half), ab = dot(a.half, b.half);
    const double determinant = aa * bb - ab * ab;
    if (!(determinant > 1e-12 * aa * bb)) return least;
    const double s = (dot(a.half, w) * bb - ab * dot(b.half, w)) / determinant;
    const double t = (dot(a.half, w) * ab - aa * dot(b.half, w)) / determinant;
    if (std::abs(s) <= 1 && std::abs(t) <= 1)
        least = std::min(least, length(w + t * b.half - s * a.half));
    return least;
}

Core core_of(const Capsule& shape, const Vec& at, const Turn& turn) {
    return {at, rotate(turn, {0, 0.5 * static_cast<double>(shape.height), 0})};
}

ShapeDef as_shape(const Capsule& geometry) {
    return capsule(static_cast<double>(geometry.radius), static_cast<double>(geometry.height),
                   rough(0));
}

void touch_at_random(const Setup& setup, Sheet& sheet) {
    Random random(4);
    double off = 0, off_apart = 0;
    int missed = 0, overlapping = 0;
    for (int i = 0; i < 10000; ++i) {
        const Capsule first = {static_cast<float>(random.uniform(0.1, 0.5)),
                               static_cast<float>(random.uniform(0, 1.5))};
        const Capsule second = {static_cast<float>(random.uniform(0.1, 0.5)),
                                static_cast<float>(random.uniform(0, 1.5))};
        Pair pair(setup, as_shape(first), as_shape(second));
        const Turn turn_a = random.turn();
        // Every third pair is nearly parallel.
        const Turn turn_b = i % 3 == 0
                                ? turn_about(random.in_cube(1), random.uniform(0, 0.1)) * turn_a
                                : random.turn();
        const Vec at = random.in_cube(1);
        pair.put_first({}, turn_a);
        pair.put_second(at, turn_b);
        const double expected =
            distance_of(core_of(first, {}, turn_a), core_of(second, at, turn_b)) -
            static_cast<double>(first.radius) - static_cast<double>(second.radius);
        const std::optional<Touch> touch = pair.touch();
        if (!touch) {
            missed += expected < -1e-5 ? 1 : 0;
            continue;
        }
        double& worst = expected < 0 ? off : off_apart;
        worst = std::max(worst, std::abs(touch->separation - expected));
        overlapping += expected < 0 ? 1 : 0;
    }
    sheet.bound("10000 pairs, separation off", off, 1e-5);
    sheet.bound("those about to touch, separation off", off_apart, 1e-5);
    sheet.bound("overlaps not seen", missed, 0);
    sheet.bound("overlaps met, short of 3000", 3000 - overlapping, 0);
}

}  // namespace

void touch_capsules(const Setup& setup, Sheet& sheet) {
    const double r = 0.5;
    const Turn along_x = turn_about({0, 0, 1}, -pi / 2);
    // Cores along (1, 0, 0) and (0.6, 0.8, 0), whose nearest points lie 1.5 apart.
    Pair skew(setup, capsule(r, 2, rough(0)), capsule(r, 2, rough(0)));
    skew.put_first({}, along_x);
    skew.put_second({0.2, 0.3, 1.5}, turn_about({0, 0, 1}, std::atan2(0.8, 0.6) - pi / 2));
    sheet.compare("skew", skew.gap_along({0, 0, 1}, 0.5), 0.5, 1e-5);

    Pair beside(setup, capsule(r, 2, rough(0)), capsule(r, 3, rough(0)));
    beside.put_second({0.9, 1, 0});
    const std::optional<Touch> two = beside.touch();
    sheet.compare("parallel, points", two ? static_cast<double>(two->points.size()) : not_seen, 2,
                  0);
    sheet.compare("parallel, separation", two ? two->separation : not_seen, -0.1, 1e-5);
    sheet.compare("parallel, apart by what they share",
                  two ? length(two->points.front() - two->points.back()) : not_seen, 1.5, 1e-5);

    Pair ends(setup, capsule(r, 2, rough(0)), capsule(r, 1, rough(0)));
    ends.put_second({0, 2.75, 0});
    sheet.compare("end to end", ends.gap_along({0, 1, 0}, 0.25), 0.25, 1e-5);

    Pair balls(setup, capsule(r, 0, rough(0)), capsule(r, 0, rough(0)));
    balls.put_second({0.48, 0, 0.64});
    const std::optional<Touch> one = balls.touch();
    sheet.compare("without length", one ? one->separation : not_seen, -0.2, 1e-5);
    sheet.compare("without length, points",
                  one ? static_cast<double>(one->points.size()) : not_seen, 1, 0);
    touch_at_random(setup, sheet);
}

}  // namespace cairn::physics

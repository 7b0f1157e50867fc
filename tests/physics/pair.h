#pragma once
// Two bodies alone in a world that never steps: what World::contacts() says where they are put.

#include <optional>

#include "scene.h"

namespace cairn::physics {

struct Touch {
    double separation = 0;  // the least of the points'
    Vec normal;             // from the first body to the second
    std::vector<Vec> points;
    std::vector<double> separations;
};

class Pair {
public:
    enum class Order { AsGiven, Swapped };  // which body the world is told of first
    Pair(const Setup& setup, const ShapeDef& first, const ShapeDef& second,
         Order order = Order::AsGiven);

    void put_first(const Vec& at, const Turn& turn = {});
    void put_second(const Vec& at, const Turn& turn = {});
    // Nothing where the world reports no contact, as it may where the shapes are apart.
    std::optional<Touch> touch() const;
    // Where the shapes are apart: how far the second must come along -normal until they overlap by
    // a millimetre, less the millimetre. It is the gap if `normal` is the direction of the least
    // distance.
    double gap_along(const Vec& normal, double expected);

private:
    World world_;
    BodyId first_, second_;
};

// The area of the convex polygon that the points make in the plane across `normal`.
double area_of(const Touch& touch);
// Whether the convex polygon of the points, seen along the normal, has `point` inside.
bool surrounds(const Touch& touch, const Vec& point);

}  // namespace cairn::physics

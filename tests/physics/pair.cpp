// Two bodies alone, and the polygon that their contact points make.

#include "pair.h"

#include <algorithm>

namespace cairn::physics {

namespace {

// The points around their middle, in order, as seen against the normal.
std::vector<Vec> in_order(const Touch& touch) {
    Vec middle;
    for (const Vec& p : touch.points) {
        middle = middle + (1 / static_cast<double>(touch.points.size())) * p;
    }
    const Vec& n = touch.normal;
    const Vec helper = std::abs(n.x) < 0.6 ? Vec{1, 0, 0} : Vec{0, 1, 0};
    const Vec u = cross(n, helper), v = cross(n, u);
    const auto angle = [&](const Vec& p) {
        return std::atan2(dot(p - middle, v), dot(p - middle, u));
    };
    std::vector<Vec> points = touch.points;
    std::sort(points.begin(), points.end(),
              [&](const Vec& a, const Vec& b) { return angle(a) < angle(b); });
    return points;
}

}  // namespace

Pair::Pair(const Setup& setup, const ShapeDef& first, const ShapeDef& second, Order order)
    : world_(make_world(setup, {.gravity = 0})) {
    BodyDef a, b;
    a.shapes = {first};
    b.shapes = {second};
    a.mass = 1.0f;
    b.mass = 1.0f;
    if (order == Order::AsGiven) {
        first_ = add(world_, a);
        second_ = add(world_, b);
    } else {
        second_ = add(world_, b);
        first_ = add(world_, a);
    }
}

void Pair::put_first(const Vec& at, const Turn& turn) { set_pose(world_, first_, at, turn); }
void Pair::put_second(const Vec& at, const Turn& turn) { set_pose(world_, second_, at, turn); }

std::optional<Touch> Pair::touch() const {
    const std::vector<ContactReport> contacts = world_.contacts();
    if (contacts.empty()) return std::nullopt;
    const ContactReport& contact = contacts.front();
    Touch touch;
    touch.normal = (contact.body_a == first_ ? 1.0 : -1.0) * from(contact.normal);
    touch.separation = std::numeric_limits<double>::infinity();
    for (int i = 0; i < contact.point_count; ++i) {
        const ContactPointReport& point = contact.points[static_cast<std::size_t>(i)];
        touch.points.push_back(from(point.position));
        touch.separations.push_back(static_cast<double>(point.separation));
        // Written so that a NaN shows.
        if (!(touch.separations.back() >= touch.separation)) {
            touch.separation = touch.separations.back();
        }
    }
    return touch;
}

double Pair::gap_along(const Vec& normal, double expected) {
    const std::optional<Touch> apart = touch();
    // What is reported of shapes that are apart must be right too.
    if (apart && std::abs(apart->separation - expected) > 1e-5) return apart->separation;
    const double overlap = 1e-3;
    const Vec at = from(world_.position(second_));
    const Turn turn = turn_of(world_, second_);
    put_second(at - (expected + overlap) * normal, turn);
    const std::optional<Touch> close = touch();
    put_second(at, turn);
    return close ? close->separation + overlap + expected : not_seen;
}

double area_of(const Touch& touch) {
    const std::vector<Vec> points = in_order(touch);
    double twice = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        twice += dot(cross(points[i], points[(i + 1) % points.size()]), touch.normal);
    }
    return std::abs(twice) / 2;
}

bool surrounds(const Touch& touch, const Vec& point) {
    const std::vector<Vec> points = in_order(touch);
    bool left = false, right = false;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec edge = points[(i + 1) % points.size()] - points[i];
        const double side = dot(cross(edge, point - points[i]), touch.normal);
        left = left || side > 0;
        right = right || side < 0;
    }
    return points.size() >= 3 && left != right;
}

}  // namespace cairn::physics

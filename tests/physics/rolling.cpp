// Cases D13, D15 and D16: a ball that slips, then rolls; one that rolls, and a capsule about its
// axis; one that never can.

#include "scene.h"

namespace cairn::physics {

namespace {

void slip_then_roll(const Setup& setup, Sheet& sheet) {
    const double r = 0.1;
    for (const Ground ground : {Ground::Plane, Ground::Box}) {
        World world = make_world(setup);
        add_ground(world, ground, rough(0.3));
        BodyDef def;
        def.shapes = {ball(r, rough(0.3))};
        def.position = {0, 0, r};
        def.linear_velocity = {5, 0, 0};
        const BodyId body = add(world, def);
        run(world, setup, 1.5);
        const double v = velocity_of(world, body).x, u = r * spin_of(world, body).y;
        const double expected = 5.0 * 5 / 7;
        const bool is_tight = setup.solver == Solver::SoftStep || !is_coarse(setup);
        const double tolerance = (is_tight ? 0.003 : 0.01) * expected;
        const std::string where = std::string(", ") + name(ground);
        sheet.compare("speed at 1.5 s, m/s" + where, v, expected, tolerance);
        sheet.compare("spin times radius, m/s" + where, u, expected, tolerance);
        sheet.bound("speed and spin apart, m/s" + where, std::abs(v - u), 0.003 * expected);
    }
}

// Speed and spin times radius after 1 s on a slope.
void roll_down(const Setup& setup, Sheet& sheet, const std::string& what, const ShapeDef& shape,
               double r, double mass, double tilt, double v, double u) {
    const double friction = static_cast<double>(shape.material.friction);
    for (const Ground ground : {Ground::Plane, Ground::Box}) {
        World world = make_world(setup);
        const Slope slope = slope_of(tilt);
        add_ground(world, ground, rough(friction), tilt);
        BodyDef def;
        def.shapes = {shape};
        def.mass = static_cast<float>(mass);
        def.position = to_position(r * slope.normal);
        const BodyId body = add(world, def);
        run(world, setup, 1);
        const std::string where = what + ", " + name(ground);
        sheet.compare("speed at 1 s, m/s" + where, dot(velocity_of(world, body), slope.downhill), v,
                      0.005 * v);
        sheet.compare("spin times radius, m/s" + where, r * dot(spin_of(world, body), slope.across),
                      u, 0.005 * u);
    }
}

void roll(const Setup& setup, Sheet& sheet) {
    const double a = 5.0 / 7 * gravity * std::sin(radians(15));
    roll_down(setup, sheet, "", ball(0.05, rough(0.5)), 0.05, 0.1, radians(15), a, a);
    // A cylinder of mass c and two half balls of mass s in all: I = c r^2 / 2 + s 2/5 r^2.
    const double r = 0.05, h = 0.2, c = pi * r * r * h, s = 4.0 / 3 * pi * r * r * r;
    const double share = (c / 2 + 0.4 * s) / (c + s);
    const double b = gravity * std::sin(radians(15)) / (1 + share);
    roll_down(setup, sheet, ", capsule", capsule(r, h, rough(0.5)), r, 0.1, radians(15), b, b);
}

void slip(const Setup& setup, Sheet& sheet) {
    const double s = std::sin(radians(30)), c = std::cos(radians(30));
    roll_down(setup, sheet, "", ball(0.1, rough(0.1)), 0.1, 1, radians(30), gravity * (s - 0.1 * c),
              2.5 * 0.1 * gravity * c);
}

}  // namespace

std::vector<Case> rolling_cases() {
    return {
        {.id = "D13", .title = "slipping, then rolling", .run = slip_then_roll, .quick = true},
        {.id = "D15", .title = "rolling down", .run = roll, .quick = true},
        {.id = "D16", .title = "slipping down", .run = slip, .quick = true},
    };
}

}  // namespace cairn::physics

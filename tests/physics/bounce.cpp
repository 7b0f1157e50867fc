// Cases D01 to D07: what comes back from an impact.

#include <algorithm>

#include "scene.h"

namespace cairn::physics {

namespace {

// The heights of the first `count` peaks over the rest height, of a ball dropped by 1 m.
std::vector<double> watch_peaks(const Setup& setup, Ground ground, double restitution,
                                std::size_t count) {
    const double radius = 0.1;
    World world = make_world(setup, {.restitution_threshold = 0.01});
    add_ground(world, ground, rough(0, restitution));
    BodyDef def;
    def.shapes = {ball(radius, rough(0, restitution))};
    def.position = {0, 0, 1 + radius};
    const BodyId body = add(world, def);
    std::vector<double> peaks;
    Vec at = center_of(world, body), v;
    for (int i = 0; i < steps_in(setup, 12) && peaks.size() < count; ++i) {
        advance(world, setup.dt);
        const Vec next = velocity_of(world, body);
        if (v.z > 0 && next.z <= 0) {
            // The parabola that the flight's positions lie on begins h/2 later than its speed says.
            const double rise = v.z - gravity * substep_of(setup) / 2;
            peaks.push_back(at.z - radius + rise * rise / (2 * gravity));
        }
        at = center_of(world, body);
        v = next;
    }
    peaks.resize(count, not_seen);
    return peaks;
}

void drop_ball(const Setup& setup, Sheet& sheet) {
    const double first = std::pow(0.8, 2), fifth = std::pow(0.8, 10);
    const double part = is_coarse(setup) ? 0.02 : 0.01;
    for (const Ground ground : {Ground::Plane, Ground::Box}) {
        const std::vector<double> peaks = watch_peaks(setup, ground, 0.8, 5);
        const std::string where = std::string(", ") + name(ground);
        sheet.compare("first peak, m" + where, peaks[0], first, part * first);
        sheet.compare("fifth peak, m" + where, peaks[4], fifth, 5 * part * fifth);
    }
}

void drop_elastic_ball(const Setup& setup, Sheet& sheet) {
    for (const Ground ground : {Ground::Plane, Ground::Box}) {
        const std::vector<double> peaks = watch_peaks(setup, ground, 1, 10);
        double highest = 0, lowest = 10;
        for (const double peak : peaks) {
            if (!(peak <= highest)) highest = peak;
            if (!(peak >= lowest)) lowest = peak;
        }
        const std::string where = std::string(", ") + name(ground);
        sheet.bound("highest of ten peaks over the start, m" + where, highest - 1, 0.01);
        sheet.bound("lowest of ten peaks under the start, m" + where, 1 - lowest, 0.03);
    }
}

double rebound_from_wall(const Setup& setup, double speed) {
    World world = make_world(setup, {.gravity = 0, .restitution_threshold = 1});
    add_static(world, block({1, 4, 4}, rough(0, 0.8)), {1, 0, 0});
    BodyDef def;
    def.shapes = {ball(0.1, rough(0, 0.8))};
    def.position = {0, 0, 0};
    def.linear_velocity = to_vec3({speed, 0, 0});
    const BodyId body = add(world, def);
    run(world, setup, 0.4 / speed + 0.3);
    return -velocity_of(world, body).x;
}

void try_threshold(const Setup& setup, Sheet& sheet) {
    sheet.compare("after 0.9 m/s", rebound_from_wall(setup, 0.9), 0, 1e-3);
    sheet.compare("after 1.1 m/s", rebound_from_wall(setup, 1.1), 0.88, 1e-3);
    World world = make_world(setup);
    add_ground(world, Ground::Plane, rough(0.6, 0.9));
    BodyDef def;
    def.shapes = {block({1, 1, 1}, rough(0.6, 0.9))};
    def.position = {0, 0, 0.5};
    const BodyId body = add(world, def);
    run(world, setup, 0.5);
    double fastest = 0;
    for (int i = 0; i < steps_in(setup, 9.5); ++i) {
        advance(world, setup.dt);
        fastest = std::max(fastest, speed_of(world, body));
    }
    sheet.bound("cube at rest with e = 0.9, m/s", fastest, 1e-3);
}

void collide_in_line(const Setup& setup, Sheet& sheet) {
    World world = make_world(setup, {.gravity = 0, .restitution_threshold = 0.01});
    BodyDef def;
    def.shapes = {ball(0.1, rough(0, 0.7))};
    def.mass = 1.0f;
    def.linear_velocity = {2, 0, 0};
    const BodyId a = add(world, def);
    def.mass = 3.0f;
    def.position = {1, 0, 0};
    def.linear_velocity = {-1, 0, 0};
    const BodyId b = add(world, def);
    run(world, setup, 1);
    sheet.compare("lighter ball, m/s", velocity_of(world, a).x, -1.825, 1e-4);
    sheet.compare("heavier ball, m/s", velocity_of(world, b).x, 0.275, 1e-4);
    sheet.compare("momentum, kg m/s", world.momentum().linear[0], -1, 1e-6);
}

void collide_aside(const Setup& setup, Sheet& sheet) {
    World world = make_world(setup, {.gravity = 0, .restitution_threshold = 0.01});
    BodyDef def;
    def.shapes = {ball(0.5, rough(0, 1))};
    def.linear_velocity = {2, 0, 0};
    const BodyId a = add(world, def);
    def.position = {1.3, 0.5, 0};
    def.linear_velocity = {};
    const BodyId b = add(world, def);
    run(world, setup, 1);
    // 1% of v at 1/240: the normal is that of the time at which contact is seen, off by v dt / R.
    const double tolerance = 0.02 * setup.dt * 240;
    const Vec v = velocity_of(world, a), u = velocity_of(world, b);
    sheet.compare("striker, along, m/s", v.x, 0.5, tolerance);
    sheet.compare("striker, aside, m/s", v.y, -0.8660254, tolerance);
    sheet.compare("struck, along, m/s", u.x, 1.5, tolerance);
    sheet.compare("struck, aside, m/s", u.y, 0.8660254, tolerance);
    sheet.bound("out of the plane, m/s", std::abs(v.z) + std::abs(u.z), 1e-6);
}

}  // namespace

std::vector<Case> bounce_cases() {
    return {
        {.id = "D01", .title = "a bouncing ball", .run = drop_ball, .quick = true},
        {.id = "D02",
         .title = "a ball that loses nothing",
         .run = drop_elastic_ball,
         .quick = true},
        {.id = "D04", .title = "the threshold of bouncing", .run = try_threshold, .quick = true},
        {.id = "D06", .title = "two balls head on", .run = collide_in_line, .quick = true},
        {.id = "D07", .title = "a ball struck aside", .run = collide_aside, .quick = true},
    };
}

}  // namespace cairn::physics

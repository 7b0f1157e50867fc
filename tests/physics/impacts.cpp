// Cases F17 and F18: many impacts at once, and what they must keep.

#include <algorithm>

#include "scene.h"

namespace cairn::physics {

namespace {

Vec as_vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

void break_rack(const Setup& setup, Sheet& sheet) {
    const double r = 0.028575, speed = 8;
    World world = make_world(setup, {.gravity = 0, .restitution_threshold = 0.01});
    BodyDef def;
    def.shapes = {ball(r, rough(0, 0.95))};
    def.mass = 0.17f;
    def.linear_velocity = to_vec3({speed, 0, 0});
    def.position = {-0.3, 0, 0};
    const BodyId cue = add(world, def);
    def.linear_velocity = {};
    // Rows of one to five, each ball 0.1 mm from its neighbours; mirrored in y.
    const double pitch = 2 * r + 1e-4;
    std::vector<std::pair<BodyId, BodyId>> mirrored;
    for (int row = 0; row < 5; ++row) {
        std::vector<BodyId> balls;
        for (int i = 0; i <= row; ++i) {
            def.position = {row * pitch * std::sqrt(3.0) / 2, (i - row / 2.0) * pitch, 0};
            balls.push_back(add(world, def));
        }
        for (std::size_t i = 0; i < balls.size(); ++i) {
            mirrored.emplace_back(balls[i], balls[balls.size() - 1 - i]);
        }
    }
    mirrored.emplace_back(cue, cue);
    const Vec p0 = as_vec(world.momentum().linear);
    double energy = world.energy().kinetic, gain = 0, lost = 0, skew = 0;
    const double start = energy;
    for (int i = 0; i < steps_in(setup, 1); ++i) {
        advance(world, setup.dt);
        const double now = world.energy().kinetic;
        gain = std::max(gain, (now - energy) / start);
        energy = now;
        lost = std::max(lost, length(as_vec(world.momentum().linear) - p0) / length(p0));
        for (const auto& [a, b] : mirrored) {
            const Vec v = velocity_of(world, a), u = velocity_of(world, b);
            skew = std::max(skew, length(v - Vec{u.x, -u.y, u.z}) / speed);
        }
    }
    double spread = 0;
    for (const auto& pair : mirrored) spread = std::max(spread, speed_of(world, pair.first));
    sheet.claim("the rack breaks", spread > 0.5 && energy < 0.99 * start);
    sheet.bound("momentum lost, relative", lost, 1e-5);
    // Binary32 squares know no better.
    sheet.bound("energy gained in a step, relative", gain, 1e-6);
    sheet.bound("mirrored velocities apart, over the cue's", skew, 0.05);
}

void collide_gas(const Setup& setup, Sheet& sheet) {
    World world = make_world(setup, {.gravity = 0, .restitution_threshold = 0.01});
    Random random(18);
    for (int i = 0; i < 200; ++i) {
        BodyDef def;
        def.shapes = {i % 2 == 0 ? ball(0.15, rough(0.5, 0.8))
                                 : block({0.2, 0.3, 0.24}, rough(0.5, 0.8))};
        const Vec at = 0.6 * (Vec{i % 6 + 0.0, i / 6 % 6 + 0.0, i / 36 + 0.0} - Vec{2.5, 2.5, 2.5});
        def.position = to_position(at);
        def.linear_velocity = to_vec3(random.in_cube(2) - 0.5 * at);
        def.angular_velocity = to_vec3(random.in_cube(2));
        add(world, def);
    }
    double sizes = 0, turns = 0;
    for (const BodyId body : world.bodies()) {
        const MassProperties m = world.mass_properties(body);
        const auto mass = static_cast<double>(m.mass);
        const Vec v = velocity_of(world, body), w = spin_of(world, body);
        // No body is turned yet: its axes are the world's.
        const Vec spin = {static_cast<double>(m.inertia.xx) * w.x,
                          static_cast<double>(m.inertia.yy) * w.y,
                          static_cast<double>(m.inertia.zz) * w.z};
        sizes += mass * length(v);
        turns += length(mass * cross(center_of(world, body), v)) + length(spin);
    }
    const Vec p0 = as_vec(world.momentum().linear), l0 = as_vec(world.momentum().angular);
    double energy = world.energy().kinetic, gain = 0;
    const double start = energy;
    for (int i = 0; i < steps_in(setup, 10); ++i) {
        advance(world, setup.dt);
        const double now = world.energy().kinetic;
        gain = std::max(gain, (now - energy) / start);
        energy = now;
    }
    sheet.claim("they collide", energy < 0.8 * start);
    sheet.bound("momentum off, relative", length(as_vec(world.momentum().linear) - p0) / sizes,
                1e-5);
    sheet.bound("angular momentum off, relative",
                length(as_vec(world.momentum().angular) - l0) / turns, 1e-4);
    sheet.bound("energy gained in a step, relative", gain, 1e-4);
}

}  // namespace

std::vector<Case> impact_cases() {
    return {
        {.id = "F17", .title = "the break", .run = break_rack, .quick = true, .steps = {1.0 / 240}},
        {.id = "F18", .title = "a gas of balls and boxes", .run = collide_gas},
    };
}

}  // namespace cairn::physics

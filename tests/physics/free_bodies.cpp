// Cases A: one free body. What integration does alone: where it goes, how it turns and tumbles.
//
// A02 and A01 fall, the rest float without gravity. Closed forms: projectile sums of the
// semi-implicit step; the symmetric top's L/I turn times the body's own; Jacobi's elliptic motion
// of a box (its zero crossings, every 2K(k)/rate).

#include <algorithm>

#include "scene.h"

namespace cairn::physics {

namespace {

constexpr double float_tolerance(int substeps) { return substeps <= 4 ? 2e-6 : 2e-5; }

void fall_freely(const Setup& setup, Sheet& sheet) {
    World world = make_world(setup);
    BodyDef def;
    def.position = {0, 0, 10};
    def.shapes = {ball(0.1, rough(0))};
    const BodyId body = add(world, def);
    for (int i = 0; i < 60; ++i) advance(world, setup.dt);
    const double n = 60.0 * default_substeps(setup.solver);
    const double h = substep_of(setup);
    const double z = 10 - gravity * h * h * n * (n + 1) / 2;
    const double v = -gravity * n * h;
    const double tolerance = float_tolerance(default_substeps(setup.solver));
    sheet.compare("height after 60 steps", center_of(world, body).z, z, tolerance * z);
    sheet.compare("speed after 60 steps", velocity_of(world, body).z, v, -tolerance * v);
}

BodyDef tumbling_box(const Vec& spin) {
    BodyDef def;
    def.shapes = {block({0.2, 0.4, 0.6}, rough(0))};
    def.mass = 1.0f;
    def.angular_velocity = to_vec3(spin);
    return def;
}

void throw_spinning(const Setup& setup, Sheet& sheet) {
    const Vec start = {3, -2, 5};
    BodyDef def = tumbling_box({0.05, 5, 0.05});
    def.linear_velocity = to_vec3(start);
    World spinning = make_world(setup);
    const BodyId body = add(spinning, def);
    def.angular_velocity = {};
    World straight = make_world(setup);
    const BodyId other = add(straight, def);

    double apart = 0, off = 0;
    const double h = substep_of(setup);
    for (int i = 1; i <= steps_in(setup, 2); ++i) {
        advance(spinning, setup.dt);
        advance(straight, setup.dt);
        const Vec at = center_of(spinning, body);
        apart = std::max(apart, length(at - center_of(straight, other)));
        // The formula as far as A01 tries it: its tolerance counts on so many roundings.
        if (i > 60) continue;
        const double n = static_cast<double>(i) * default_substeps(setup.solver);
        const Vec path = n * h * start - Vec{0, 0, gravity * h * h * n * (n + 1) / 2};
        off = std::max(off, length(at - path) / length(path));
    }
    sheet.bound("path beside the same without spin, m", apart, 1e-6);
    sheet.bound("path off the formula, relative", off,
                float_tolerance(default_substeps(setup.solver)));
}

void spin_ball(const Setup& setup, Sheet& sheet) {
    World world = make_world(setup, {.gravity = 0});
    BodyDef def;
    def.shapes = {ball(0.1, rough(0))};
    def.angular_velocity = {0, 0, 20};
    const BodyId body = add(world, def);
    advance(world, setup.dt);
    // The exponential map: the turn is w dt itself, whatever the substeps.
    sheet.compare("turn of one step, rad", angle_between({}, turn_of(world, body)), 20 * setup.dt,
                  1e-6);
    double off = 0;
    for (int i = 1; i < 100000; ++i) {
        advance(world, setup.dt);
        const Turn q = turn_of(world, body);
        off = std::max(off, std::abs(std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w) - 1));
    }
    sheet.bound("|q| off 1 in 100000 steps", off, 1e-6);
}

struct TopError {
    double turn = 0, spin = 0;  // rad
};

// The symmetric top I1 = I2 = 0.04, I3 = 0.02 after `seconds`, against the closed form.
TopError run_top(const Setup& setup, double dt, int substeps, double seconds) {
    const double transverse = 0.04, axial = 0.02;
    const Vec w0 = {2, -1, 6};
    World world = make_world(setup, {.gravity = 0, .substeps = substeps});
    BodyDef def;
    def.mass_properties = MassProperties{1, {}, {0.04f, 0.04f, 0.02f, 0, 0, 0}};
    def.angular_velocity = to_vec3(w0);
    const BodyId body = add(world, def);
    const auto count = static_cast<int>(std::lround(seconds / dt));
    for (int i = 0; i < count; ++i) advance(world, dt);

    const double sigma = (axial - transverse) / transverse * w0.z;
    const Vec momentum = {transverse * w0.x, transverse * w0.y, axial * w0.z};
    const double rate = length(momentum) / transverse;
    const Turn turn =
        turn_about(momentum, rate * seconds) * turn_about({0, 0, 1}, -sigma * seconds);
    const double c = std::cos(sigma * seconds), s = std::sin(sigma * seconds);
    const Vec w = {w0.x * c - w0.y * s, w0.x * s + w0.y * c, w0.z};

    const Vec spin = rotate(inverse(turn_of(world, body)), spin_of(world, body));
    return {angle_between(turn, turn_of(world, body)), length(spin - w) / length(w)};
}

void spin_top(const Setup& setup, Sheet& sheet) {
    const TopError own = run_top(setup, setup.dt, 0, 5);
    sheet.bound("attitude off after 5 s, degrees", degrees(own.turn), 2);
    sheet.bound("spin in the body's frame off after 5 s, degrees", degrees(own.spin), 2);
    // Midpoint claims order 2. One substep a step, and from 1/60: at finer steps the error is that
    // of binary32's roundings, which no smaller step makes less.
    if (!is_coarse(setup)) return;
    const double coarse = run_top(setup, setup.dt, 1, 5).turn;
    const double fine = run_top(setup, setup.dt / 2, 1, 5).turn;
    sheet.bound("order of convergence short of 2", 2 - std::log2(coarse / fine), 0.2);
}

void flip_box(const Setup& setup, Sheet& sheet) {
    World world = make_world(setup, {.gravity = 0});
    const BodyId body = add(world, tumbling_box({1, 5, 0}));
    const double energy = 0.4383333, momentum = 0.17220788;
    const double crossings[3] = {1.0812189, 3.2436567, 5.4060945};
    std::vector<double> found;
    double energy_off = 0, momentum_off = 0, last = 5;
    for (int i = 1; i <= steps_in(setup, 6); ++i) {
        advance(world, setup.dt);
        const double w = rotate(inverse(turn_of(world, body)), spin_of(world, body)).y;
        if ((w > 0) != (last > 0)) found.push_back((i - w / (w - last)) * setup.dt);
        last = w;
        const auto l = world.momentum().angular;
        energy_off = std::max(energy_off, std::abs(world.energy().kinetic / energy - 1));
        momentum_off = std::max(momentum_off, std::abs(length({l[0], l[1], l[2]}) / momentum - 1));
    }
    for (std::size_t i = 0; i < 3; ++i) {
        sheet.compare("flip " + std::to_string(i + 1) + ", s",
                      found.size() == 3 ? found[i] : not_seen, crossings[i], 0.015 * crossings[i]);
    }
    sheet.bound("energy off in 6 s, relative", energy_off, 0.01);
    sheet.bound("|L| off in 6 s, relative", momentum_off, 0.01);
}

struct EnergyRange {
    double most = 0, least = 0;  // relative to the start, less 1
};

EnergyRange watch_energy(World& world, const Setup& setup, double seconds) {
    const double start = world.energy().kinetic;
    EnergyRange range;
    for (int i = 0; i < steps_in(setup, seconds); ++i) {
        advance(world, setup.dt);
        const double change = world.energy().kinetic / start - 1;
        if (!(change >= range.least)) range.least = change;
        if (!(change <= range.most)) range.most = change;
    }
    return range;
}

void tumble_long(const Setup& setup, Sheet& sheet) {
    for (const Vec& spin : {Vec{0.05, 5, 0.05}, Vec{20, 0.05, 0.05}}) {
        World world = make_world(setup, {.gravity = 0});
        add(world, tumbling_box(spin));
        const EnergyRange range = watch_energy(world, setup, 100);
        const std::string about = spin.y > 1 ? ", middle axis" : ", stiffest axis";
        sheet.bound("energy gained in 100 s, relative" + about, range.most, 0.01);
        sheet.bound("energy lost in 100 s, relative" + about, -range.least, 0.01);
    }
}

void spin_plate(const Setup& setup, Sheet& sheet) {
    World world = make_world(setup, {.gravity = 0});
    BodyDef def;
    def.shapes = {block({1, 0.1, 0.02}, rough(0))};
    def.mass = 1.0f;
    def.angular_velocity = {0.1f, 0.1f, 100};
    add(world, def);
    World first_second = world;
    const auto before = first_second.momentum().angular;
    run(first_second, setup, 1);
    const auto after = first_second.momentum().angular;
    const Vec a = {before[0], before[1], before[2]}, b = {after[0], after[1], after[2]};
    sheet.bound("energy gained in 10 s, relative", watch_energy(world, setup, 10).most, 0.001);
    sheet.bound("direction of L off after 1 s, degrees",
                degrees(std::atan2(length(cross(a, b)), dot(a, b))), 1);
}

void damp(const Setup& setup, Sheet& sheet) {
    World world = make_world(setup, {.gravity = 0});
    BodyDef def;
    def.shapes = {ball(0.1, rough(0))};
    def.linear_velocity = {1, 0, 0};
    def.angular_velocity = {0, 0, 1};
    def.linear_damping = 0.5f;
    def.angular_damping = 0.5f;
    const BodyId body = add(world, def);
    run(world, setup, 5);
    // The documented form: divided by 1 + c h every substep.
    const int count = steps_in(setup, 5) * default_substeps(setup.solver);
    const double expected = std::pow(1 + 0.5 * substep_of(setup), -count);
    sheet.compare("speed after 5 s, m/s", velocity_of(world, body).x, expected, 3e-5);
    sheet.compare("spin after 5 s, rad/s", spin_of(world, body).z, expected, 3e-5);
}

}  // namespace

std::vector<Case> free_body_cases() {
    return {
        {.id = "A01", .title = "free fall", .run = fall_freely, .quick = true},
        {.id = "A02", .title = "a thrown box's spin", .run = throw_spinning, .quick = true},
        {.id = "A03", .title = "a turning ball", .run = spin_ball, .quick = true},
        {.id = "A04", .title = "a symmetric top", .run = spin_top, .quick = true},
        {.id = "A05", .title = "a box about its middle axis", .run = flip_box, .quick = true},
        {.id = "A07",
         .title = "a tumbling box's energy",
         .run = tumble_long,
         .steps = {1.0 / 60, 0.005, 1.0 / 240}},
        {.id = "A08", .title = "a fast thin plate", .run = spin_plate, .quick = true},
        {.id = "A09", .title = "damping", .run = damp, .quick = true},
    };
}

}  // namespace cairn::physics

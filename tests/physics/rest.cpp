// Cases D25, F04, F05, F21 and F22: what stands, stands still, and what overlaps comes apart in
// peace.
//
// Bounds of penetration at rest: sequential impulses leave the slop of their positional correction,
// 0.05% of the smaller shape's smallest half extent; one XPBD iteration a substep leaves (mass
// above / own mass) g h^2.

#include <algorithm>

#include "scene.h"

namespace cairn::physics {

namespace {

double largest_rest_penetration(const Setup& setup, double half_extent) {
    const double h = substep_of(setup);
    return setup.solver == Solver::Xpbd ? gravity * h * h : 5e-4 * half_extent;
}

void rest_on_ground(const Setup& setup, Sheet& sheet) {
    World world = make_world(setup);
    const BodyId ground = add_ground(world, Ground::Plane, rough(0.6));
    BodyDef def;
    def.shapes = {block({1, 1, 1}, rough(0.6))};
    def.position = {0, 0, 0.5};
    const BodyId body = add(world, def);
    run(world, setup, 1);
    const Vec start = center_of(world, body);
    double fastest = 0, penetration = 0, drift = 0, sum_off = 0, each_off = 0;
    const double weight =
        static_cast<double>(world.mass_properties(body).mass) * gravity * setup.dt;
    for (int i = 0; i < steps_in(setup, 59); ++i) {
        advance(world, setup.dt);
        fastest = std::max(fastest, speed_of(world, body));
        drift = std::max(drift, length(center_of(world, body) - start));
        if (i % 10 != 0) continue;
        const std::vector<ContactReport> contacts = world.contacts();
        penetration = std::max(penetration, World::penetration(contacts).deepest);
        sum_off = std::max(sum_off, std::abs(normal_impulse(world, ground, body) / weight - 1));
        for (int k = 0; k < 4; ++k) {
            const bool is_there = contacts.size() == 1 && contacts[0].point_count == 4;
            const auto n = static_cast<std::size_t>(k);
            const double part =
                is_there ? static_cast<double>(contacts[0].points[n].normal_impulse) : 0;
            each_off = std::max(each_off, std::abs(4 * part / weight - 1));
        }
    }
    sheet.bound("speed, m/s", fastest, 1e-4);
    sheet.bound("drift in 59 s, m", drift, 1e-3);
    sheet.bound("impulses' sum off m g dt, relative", sum_off, 0.001);
    sheet.bound("each corner's off m g dt / 4, relative", each_off, 0.05);
    sheet.bound("penetration, m", penetration, largest_rest_penetration(setup, 0.5));
}

void stack_cubes(const Setup& setup, Sheet& sheet) {
    for (const int count : {1, 5, 10, 20}) {
        World world = make_world(setup);
        add_ground(world, Ground::Plane, rough(0.6));
        std::vector<BodyId> cubes;
        for (int i = 0; i < count; ++i) {
            BodyDef def;
            def.shapes = {block({1, 1, 1}, rough(0.6))};
            def.position = {0, 0, 0.5 + i};
            cubes.push_back(add(world, def));
        }
        run(world, setup, 9);
        double fastest = 0, aside = 0;
        for (int i = 0; i < steps_in(setup, 1); ++i) {
            advance(world, setup.dt);
            for (const BodyId cube : cubes) fastest = std::max(fastest, speed_of(world, cube));
        }
        for (const BodyId cube : cubes) {
            const Vec at = center_of(world, cube);
            aside = std::max(aside, std::hypot(at.x, at.y));
        }
        const std::string high = std::to_string(count) + " high";
        sheet.bound(high + ", speed after 9 s, m/s", fastest, 1e-3);
        sheet.bound(high + ", drift aside, m", aside, 1e-3 * count);
        sheet.bound(high + ", top's sag, m", count - 0.5 - center_of(world, cubes.back()).z,
                    4e-4 * count);
    }
}

void load_light_cube(const Setup& setup, Sheet& sheet) {
    for (const double ratio : {10.0, 100.0, 1000.0}) {
        World world = make_world(setup);
        add_ground(world, Ground::Plane, rough(0.6));
        BodyDef def;
        def.shapes = {block({1, 1, 1}, rough(0.6), 1)};
        def.position = {0, 0, 0.5};
        const BodyId light = add(world, def);
        def.shapes = {block({1, 1, 1}, rough(0.6), ratio)};
        def.position = {0, 0, 1.5};
        const BodyId heavy = add(world, def);
        run(world, setup, 10);
        const std::string times = std::to_string(std::lround(ratio)) + " times as heavy";
        const double lean = std::max(degrees(angle_between({}, turn_of(world, light))),
                                     degrees(angle_between({}, turn_of(world, heavy))));
        const bool stands = lean < 5 && center_of(world, heavy).z > 1.2;
        sheet.claim(times + ", stands", stands);
        if (ratio > 100) continue;
        sheet.bound(times + ", deepest penetration, m",
                    World::penetration(world.contacts()).deepest, 0.01);
    }
}

void part_overlapping(const Setup& setup, Sheet& sheet) {
    World world = make_world(setup);
    add_ground(world, Ground::Plane, rough(0.6));
    std::vector<BodyId> cubes;
    for (const Vec& at : {Vec{-0.45, -0.45, 0.4}, Vec{0.45, -0.45, 0.4}, Vec{-0.45, 0.45, 0.4},
                          Vec{0.45, 0.45, 0.4}, Vec{0, 0, 1.3}}) {
        BodyDef def;
        def.shapes = {block({1, 1, 1}, rough(0.6))};
        def.position = to_position(at);
        cubes.push_back(add(world, def));
    }
    const double start = world.energy().potential;
    double fastest = 0, late = 0, energy = 0;
    for (int i = 1; i <= steps_in(setup, 4); ++i) {
        advance(world, setup.dt);
        for (const BodyId cube : cubes) {
            fastest = std::max(fastest, speed_of(world, cube));
            if (i * setup.dt > 2) late = std::max(late, speed_of(world, cube));
        }
        energy = std::max(energy, world.energy().kinetic);
    }
    // Each cube lifted clear by its overlap: the upper one by two.
    const double lift = 6 * 1000 * gravity * 0.1;
    sheet.bound("fastest, m/s", fastest, 3.3);
    sheet.bound("fastest after 2 s, m/s", late, 0.01);
    sheet.bound("kinetic energy, over what lifting them clear takes", energy / lift, 1);
    sheet.bound("energy at last, over the same", (world.energy().total - start) / lift, 1.01);
    sheet.bound("overlap at last, m", World::penetration(world.contacts()).deepest, 0.01);
}

// 20 s of cubes of half a metre, or of a metre, on ground and each other; then how still they are
// and how deep in each other.
void settle(const Setup& setup, Sheet& sheet, const std::string& what, double size,
            const std::vector<Vec>& centers) {
    World world = make_world(setup);
    add_ground(world, Ground::Box, rough(0.6));
    std::vector<BodyId> cubes;
    for (const Vec& at : centers) {
        BodyDef def;
        def.shapes = {block({size, size, size}, rough(0.6))};
        def.position = to_position(at);
        cubes.push_back(add(world, def));
    }
    run(world, setup, 20);
    double fastest = 0;
    for (const BodyId cube : cubes) fastest = std::max(fastest, speed_of(world, cube));
    const Penetration overlap = World::penetration(world.contacts());
    sheet.bound(what + ", fastest after 20 s, m/s", fastest, 0.02);
    sheet.bound(what + ", mean penetration, m", overlap.mean, 0.002);
    sheet.bound(what + ", deepest penetration, m", overlap.deepest, 0.01);
}

void settle_piles(const Setup& setup, Sheet& sheet) {
    std::vector<Vec> pyramid;
    for (int k = 0; k < 20; ++k) {
        for (int i = 0; i < 20 - k; ++i)
            pyramid.push_back({1.01 * (i - 0.5 * (19 - k)), 0, 0.5 + k});
    }
    settle(setup, sheet, "a pyramid of 210", 1, pyramid);
    std::vector<Vec> heap;
    Random random(22);
    for (int k = 0; k < 5; ++k) {
        for (int i = 0; i < 10; ++i) {
            for (int j = 0; j < 10; ++j) {
                const Vec jitter = random.in_cube(0.05);
                heap.push_back(Vec{0.7 * (i - 4.5), 0.7 * (j - 4.5), 0.5 + 0.7 * k} + jitter);
            }
        }
    }
    settle(setup, sheet, "a heap of 500", 0.5, heap);
}

}  // namespace

std::vector<Case> rest_cases() {
    return {
        {.id = "D25", .title = "a cube at rest", .run = rest_on_ground, .quick = true},
        {.id = "F04",
         .title = "a stack of cubes",
         .subject = Subject::Piling,
         .run = stack_cubes,
         .quick = true},
        {.id = "F05",
         .title = "heavy on light",
         .subject = Subject::Piling,
         .run = load_light_cube,
         .quick = true},
        {.id = "F21",
         .title = "cubes put into each other",
         .subject = Subject::Piling,
         .run = part_overlapping,
         .quick = true},
        {.id = "F22", .title = "piles at rest", .run = settle_piles, .only = Solver::SoftStep},
    };
}

}  // namespace cairn::physics

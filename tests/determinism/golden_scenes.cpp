// The golden scenes; see golden_scenes.h. Between them: boxes, spheres and capsules, several shapes
// on a body, every kind of friction, bounces, columns with a heavy top, kinematic bodies, locked
// axes, free tumbling down to denormal speeds, bodies that come, go and are changed in the middle,
// and enough contacts at once to fill the widest rows; at the origin and 1e5 and 1e7 metres away
// from it.

#include "determinism/golden_scenes.h"

#include <algorithm>
#include <vector>

#include "determinism/pile.h"

namespace cairn::test {

namespace {

constexpr Position origin = {};
// No sums that binary64 holds exactly, and another one along each axis.
constexpr Position far_5 = {1.0e5 + 0.3, -1.0e5 - 0.7, 0.9e5 + 0.1};
constexpr Position far_7 = {-1.0e7 - 0.1, 1.0e7 + 0.7, 2.3e7 + 0.3};

Position offset(const Position& place, const Position& by) {
    return {place.x + by.x, place.y + by.y, place.z + by.z};
}

BodyId add(World& world, const Position& place, BodyDef def) {
    def.position = offset(place, def.position);
    return world.create_body(def).value();
}

void add_ground(World& world, const Position& place, const Plane& plane = {},
                const Material& material = {}) {
    add(world, place,
        {.kind = BodyKind::Static, .shapes = {{.geometry = plane, .material = material}}});
}

void add_block(World& world, const Position& place, const Position& at, const Vec3& half_extents,
               const Material& material = {}) {
    add(world, place,
        {.kind = BodyKind::Static,
         .position = at,
         .shapes = {{.geometry = Box{half_extents}, .material = material}}});
}

void add_heap(World& world, const Position& place, int count) {
    add_ground(world, place);
    for (int i = 0; i < count; ++i) add(world, place, pile_body(i));
}

// A heap that falls, spins, bounces and comes to rest, thrice: the place alone differs, so rounding
// to the place alone makes the hashes differ.

void build_heap(World& world) { add_heap(world, origin, 16); }
void build_heap_far_5(World& world) { add_heap(world, far_5, 16); }
void build_heap_far_7(World& world) { add_heap(world, far_7, 16); }

// A heap whose bodies come, go, are pushed, put elsewhere, held fast, and take and lose shapes.

void build_comings_and_goings(World& world) { add_heap(world, far_5, 20); }

void change_shapes(World& world, BodyId body, int step) {
    const std::vector<ShapeId> shapes = world.shapes(body);
    if (shapes.size() > 1) (void)world.destroy_shape(shapes[0]);
    (void)world.create_shape(body, {.geometry = Sphere{0.1f + 0.001f * static_cast<float>(step)},
                                    .local_pose = {.position = {0.1f, 0.2f, 0}}});
    (void)world.set_material(world.shapes(body)[0], {.friction = 0.2f, .restitution = 0.4f});
}

void come_and_go(World& world, int step) {
    const std::vector<BodyId> bodies = world.bodies();
    const std::size_t count = bodies.size();
    // The ground is the first; another one each time, wherever it lies.
    const BodyId some = bodies[1 + static_cast<std::size_t>(step) * 5 % (count - 1)];
    switch (step % 12) {
        case 2:
            (void)world.destroy_body(bodies[count / 2]);
            (void)world.destroy_body(bodies[count / 3]);
            break;
        case 3: add(world, far_5, pile_body(step % 30)); break;
        case 4: add(world, far_5, pile_body(7 + step % 23)); break;
        case 5: (void)world.apply_impulse(some, {20, 30, -10}); break;
        case 6:
            (void)world.apply_force_at(some, {400, 100, 0}, offset(world.position(some), {0, 1}));
            break;
        case 7:
            (void)world.set_pose(some, offset(far_5, {0.2, 1.5, 0.1}), {0.5f, 0.5f, -0.5f, 0.5f});
            break;
        case 8: change_shapes(world, some, step); break;
        case 9: (void)world.set_kind(bodies[3], BodyKind::Static); break;
        case 11: (void)world.set_kind(bodies[3], BodyKind::Dynamic); break;
        default: break;
    }
}

// What rolls and what pivots on a slope, each with its own resistance, and a belt that carries up.

void build_rolling(World& world) {
    const Plane slope = {{0.2f, 1, 0.1f}, 0};
    add_ground(world, far_5, slope, {.friction = 0.8f});
    add_block(world, far_5, {6, -0.5, 0}, {1, 1, 4}, {.surface_velocity = {-2, 0, 0.5f}});
    for (int i = 0; i < 14; ++i) {
        const auto part = static_cast<float>(i);
        const Material material = {.friction = 0.3f + 0.05f * part,
                                   .rolling_friction = 0.004f * static_cast<float>(i % 5),
                                   .spinning_friction = 0.02f * static_cast<float>(i % 3)};
        BodyDef def = {.position = {-3 + 0.8 * (i % 8), 1.3 + 0.9 * (i / 8), -2.0 + 1.5 * (i % 4)},
                       .linear_velocity = {1, 0, 0.3f * part},
                       .angular_velocity = {0, 4 + part, -part}};
        const Sphere ball = {0.25f + 0.01f * part};
        const Box box = {{0.3f, 0.1f, 0.2f + 0.01f * part}};
        if (i % 3 == 0) {
            def.shapes = {{.geometry = box, .material = material}};
        } else {
            def.shapes = {{.geometry = ball, .material = material}};
        }
        // Two balls on a stick roll about one axis only.
        if (i % 5 == 1) {
            def.shapes.push_back(
                {.geometry = ball, .local_pose = {.position = {0, 0, 0.5f}}, .material = material});
        }
        add(world, far_5, def);
    }
}

// A bin with a paddle that turns and a piston that goes to and fro: both push and are not pushed.

void build_machines(World& world) {
    add(world, far_5,
        {.kind = BodyKind::Kinematic,
         .position = {0, 1.2, 0},
         .angular_velocity = {0, 0.3f, 2},
         .shapes = {{.geometry = Box{{1.1f, 0.15f, 0.6f}}},
                    {.geometry = Sphere{0.3f}, .local_pose = {.position = {1, 0.2f, 0}}}}});
    add(world, far_5,
        {.kind = BodyKind::Kinematic,
         .position = {2.2, 0.4, 0},
         .shapes = {{.geometry = Box{{0.5f, 0.35f, 1.2f}}}}});
    add_block(world, far_5, {0, -0.5, 0}, {4, 0.5f, 4});
    for (const double side : {-1.0, 1.0}) {
        add_block(world, far_5, {3 * side, 1.5, 0}, {0.2f, 2, 2});
        add_block(world, far_5, {0, 1.5, 1.7 * side}, {3, 2, 0.2f});
    }
    for (int i = 0; i < 14; ++i) add(world, far_5, pile_body(i));
}

void drive_piston(World& world, int step) {
    const double phase = 0.08 * step;
    const Position to = offset(far_5, {2.2 + 0.6 * (cosine(phase) - 1), 0.4, 0});
    (void)world.move_kinematic(world.bodies()[1], to, rotation_about({1, 0, 0}, 0.1 * sine(phase)),
                               golden_dt);
}

// Bodies that may not move along or turn about some of the world's axes.

void build_rails(World& world) {
    add_ground(world, far_5);
    const LockedAxes locks[] = {{.z = true, .rx = true, .ry = true},
                                {.rx = true, .ry = true, .rz = true},
                                {.x = true, .rz = true},
                                {.y = false, .rx = true}};
    for (int i = 0; i < 16; ++i) {
        BodyDef def = pile_body(i);
        def.lock = locks[i % 4];
        add(world, far_5, def);
    }
    // A turnstile that stands where it is, and what runs into its arm.
    add(world, far_5,
        {.position = {4, 0.6, 0},
         .shapes = {{.geometry = Box{{1.5f, 0.2f, 0.1f}}}},
         .lock = {.x = true, .y = true, .z = true, .rx = true, .rz = true}});
    for (int i = 0; i < 3; ++i) {
        add(world, far_5,
            {.position = {3 + 0.9 * i, 0.5, 1.5 + i},
             .linear_velocity = {0, 0, -4},
             .shapes = {{.geometry = Sphere{0.3f}}}});
    }
}

// A square pyramid, each box on four, and balls that hit its flanks. Of eight layers there are some
// 600 contacts from the first step on, so that colours are larger than the widest rows and have
// ends that fill none of them.

void add_crowd(World& world, const Position& place, int base) {
    add_ground(world, place);
    for (int layer = 0; layer < base; ++layer) {
        const int side = base - layer;
        for (int i = 0; i < side * side; ++i) {
            const Box box = {{0.47f, 0.5f, 0.46f + 0.002f * static_cast<float>(i % 7)}};
            add(world, place,
                {.position = {i % side + 0.5 * layer, layer + 0.499, i / side + 0.5 * layer},
                 .shapes = {{.geometry = box, .material = {.friction = 0.5f}}}});
        }
    }
    for (int i = 0; i < base; ++i) {
        const double height = 2 * std::min(i + 1, base - i) + 0.2;
        add(world, place,
            {.position = {i - 0.1, height, 0.5 * (base - 1) + 0.1 * (i % 5)},
             .linear_velocity = {0, -8, 0.1f},
             .shapes = {{.geometry = Sphere{0.3f}, .density = 3000}}});
    }
}

void build_crowd(World& world) { add_crowd(world, origin, 10); }
void build_crowd_far_7(World& world) { add_crowd(world, far_7, 4); }

// Columns whose loads pass through many contacts, up to a top 400 times as dense.

void build_columns(World& world) {
    add_ground(world, far_5);
    for (int column = 0; column < 3; ++column) {
        constexpr float top_densities[] = {1000, 40000, 400000};
        constexpr int height = 10;
        for (int i = 0; i < height; ++i) {
            const bool is_top = i == height - 1;
            add(world, far_5,
                {.position = {3.0 * column + 0.01 * (i % 3), 0.5 + i, 0.007 * (i % 4)},
                 .rotation = rotation_about({0, 1, 0}, 0.02 * i),
                 .shapes = {{.geometry = Box{{0.5f, 0.5f, 0.5f}},
                             .density = is_top ? top_densities[column] : 1000}}});
        }
    }
}

// Capsules on a plane, a step of boxes and each other, with balls and boxes among them: some lie
// side by side, some cross, some stand and fall, some roll with a resistance, and some are parts of
// a body or have no length.

void add_capsules(World& world, const Position& place) {
    add_ground(world, place);
    add_block(world, place, {-1.5, 0.1, 0}, {0.9f, 0.1f, 1.2f});
    for (int i = 0; i < 18; ++i) {
        const auto part = static_cast<float>(i % 6);
        const Material bark = {.friction = 0.4f + 0.05f * part,
                               .restitution = i % 6 == 5 ? 0.4f : 0.0f,
                               .rolling_friction = i % 4 == 1 ? 0.01f : 0.0f};
        const Capsule log = {0.12f + 0.02f * part, i == 7 ? 0.0f : 0.3f + 0.1f * part};
        BodyDef def = {.position = {0.45 * (i % 4) - 1.6, 0.6 + 0.42 * (i / 4), 0.11 * (i % 3)},
                       .rotation = rotation_about({1, 0, 0.01f * part}, i % 5 == 0 ? 0.0 : 1.5708),
                       .angular_velocity = {0, 0.5f * part, i % 3 == 0 ? 6.0f : 0.0f},
                       .shapes = {{.geometry = log, .material = bark}}};
        if (i % 6 == 2) def.shapes[0].geometry = Box{{0.2f, 0.1f, 0.15f}};
        if (i % 9 == 4) def.shapes[0].geometry = Sphere{0.2f};
        if (i % 8 == 3) {
            def.shapes.push_back({.geometry = log,
                                  .local_pose = {.position = {0.2f, 0.1f, 0},
                                                 .rotation = rotation_about({0, 0, 1}, 1.2)},
                                  .material = bark});
        }
        add(world, place, def);
    }
}

void build_capsules(World& world) { add_capsules(world, origin); }
void build_capsules_far_7(World& world) { add_capsules(world, far_7); }

// Impacts: a row of balls that passes a blow on, boxes of growing restitution, and a heavy ball.

void build_bouncing(World& world) {
    add_ground(world, origin, {}, {.restitution = 0.3f});
    for (int i = 0; i < 5; ++i) {
        const Material steel = {.friction = 0, .restitution = 1};
        add(world, origin,
            {.position = {i + (i == 4 ? 2.0 : 0.0), 3, 5},
             .linear_velocity = {i == 4 ? -5.0f : 0.0f, 0, 0},
             .shapes = {{.geometry = Sphere{0.5f}, .material = steel}},
             .gravity_scale = 0});
    }
    for (int i = 0; i < 9; ++i) {
        const float restitution = 0.1f * static_cast<float>(i);
        add(world, origin,
            {.position = {1.1 * (i % 3), 1 + 0.4 * i, 0.9 * (i / 3)},
             .rotation = rotation_about({1, 0.3f, 0.2f}, 0.3 * i),
             .linear_velocity = {0, -3, 0},
             .shapes = {{.geometry = Box{{0.4f, 0.3f, 0.2f}},
                         .material = {.friction = 0.4f, .restitution = restitution}}}});
    }
    add(world, origin,
        {.position = {1, 6, 1},
         .linear_velocity = {0, -12, 0},
         .shapes = {{.geometry = Sphere{0.6f}, .density = 100000}}});
}

// Free flight: tumbling with and without the gyroscopic torque, forces that stay, damping down to
// denormal speeds, an inertia of no shape's, and a few that meet on the way.

void build_drifting(World& world) {
    WorldSettings settings = world.settings();
    settings.gravity = {0, 0, -0.5f};
    (void)world.set_settings(settings);
    for (int i = 0; i < 10; ++i) {
        const auto part = static_cast<float>(i);
        BodyDef def = {.position = {1.3 * i, 0.1 * i, 0},
                       .linear_velocity = {i % 2 == 0 ? 1.5f : -1.5f, 0, 0.1f * part},
                       .angular_velocity = {0.01f, 6, 0.5f * part},
                       .shapes = {{.geometry = Box{{0.1f, 0.5f, 0.1f}}},
                                  {.geometry = Box{{0.4f, 0.1f, 0.1f}},
                                   .local_pose = {.position = {0, 0.5f, 0}}}},
                       .linear_damping = 0.1f * static_cast<float>(i % 3),
                       .angular_damping = 0.2f * static_cast<float>(i % 4),
                       .gyroscopic = i % 5 != 4};
        if (i % 3 == 1) def.force = {1, -2, 3}, def.torque = {0.5f, 0, -0.25f};
        add(world, far_5, def);
    }
    add(world, far_5,
        {.position = {0, 9, 0},
         .linear_velocity = {2e-38f, -2e-38f, 1e-39f},
         .angular_velocity = {1e-38f, 0, 3e-38f},
         .shapes = {{.geometry = Sphere{}}},
         .gravity_scale = 0,
         .linear_damping = 1,
         .angular_damping = 2});
    add(world, far_5,
        {.position = {5, 9, 0},
         .angular_velocity = {3, 0.1f, 0},
         .mass_properties = MassProperties{2, {0.1f, 0.2f, 0}, {2, 3, 4, 0.3f, -0.2f, 0.1f}}});
}

// A heap in the hands of a user who exchanges the solver, the narrow phase, the broad phase, the
// numbers of substeps and iterations, the reuse of contacts, and the length of the step.

void build_exchange(World& world) { add_heap(world, far_5, 14); }

void exchange_methods(World& world, int step) {
    if (step % 10 == 7) (void)world.step(1.0 / 144);
    if (step % 10 != 4) return;
    const int round = step / 10;
    WorldSettings settings = world.settings();
    StepSettings& of_step = settings.step;
    of_step.solver = static_cast<Solver>((static_cast<int>(of_step.solver) + 1) % 3);
    of_step.narrow_phase =
        of_step.narrow_phase == NarrowPhase::Sat ? NarrowPhase::GjkEpa : NarrowPhase::Sat;
    of_step.broad_phase = round % 2 == 0 ? BroadPhase::BruteForce : BroadPhase::Tree;
    of_step.reuse_contacts = round % 4 != 1;
    of_step.substeps = round % 3 == 1 ? 7 : 0;
    of_step.iterations = round % 4 == 2 ? 3 : 0;
    of_step.contact_compliance = round % 3 == 0 ? 1e-6f : 0;
    settings.gravity = {round % 2 == 0 ? 1.0f : 0.0f, -9.81f, 0};
    (void)world.set_settings(settings);
}

constexpr GoldenScene scenes[] = {
    {"heap", 80, build_heap, nullptr},
    {"heap-at-1e5", 80, build_heap_far_5, nullptr},
    {"heap-at-1e7", 80, build_heap_far_7, nullptr},
    {"comings-and-goings", 72, build_comings_and_goings, come_and_go},
    {"rolling", 80, build_rolling, nullptr},
    {"machines", 80, build_machines, drive_piston},
    {"rails", 70, build_rails, nullptr},
    {"crowd", 4, build_crowd, nullptr},
    {"crowd-at-1e7", 8, build_crowd_far_7, nullptr},
    {"columns", 30, build_columns, nullptr},
    {"capsules", 80, build_capsules, nullptr},
    {"capsules-at-1e7", 80, build_capsules_far_7, nullptr},
    {"bouncing", 80, build_bouncing, nullptr},
    {"drifting", 90, build_drifting, nullptr},
    {"exchange", 80, build_exchange, exchange_methods},
};

}  // namespace

std::span<const GoldenScene> golden_scenes() { return scenes; }

}  // namespace cairn::test

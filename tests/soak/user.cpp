// Worlds and changes; see user.h.

#include "user.h"

#include <algorithm>
#include <vector>

namespace cairn::soak {

namespace {

ShapeDef roll_shape(Dice& dice) {
    ShapeDef shape;
    if (dice.one_in(3)) {
        shape.geometry = Sphere{dice.between(0.1f, 0.5f)};
    } else if (dice.one_in(2)) {
        const float radius = dice.between(0.05f, 0.4f);
        shape.geometry = Capsule{radius, dice.between(0.0f, 0.8f)};
    } else {
        const float x = dice.between(0.05f, 0.6f);
        const float y = dice.between(0.05f, 0.6f);
        shape.geometry = Box{{x, y, dice.between(0.05f, 0.6f)}};
    }
    shape.density = dice.between(100, 5000);
    shape.material.friction = dice.between(0, 1);
    shape.material.restitution = dice.one_in(4) ? dice.between(0, 1) : 0.0f;
    shape.material.rolling_friction = dice.one_in(4) ? dice.between(0, 0.05f) : 0.0f;
    shape.material.spinning_friction = dice.one_in(4) ? dice.between(0, 0.05f) : 0.0f;
    return shape;
}

BodyDef roll_body(Dice& dice) {
    BodyDef def;
    const double x = dice.between(-3, 3);
    const double y = dice.between(0.5f, 8);
    def.position = {x, y, dice.between(-3, 3)};
    const Vec3 axis = dice.vector(1);
    def.rotation = rotation_about(axis, dice.between(0, 6));
    def.linear_velocity = dice.vector(3);
    def.angular_velocity = dice.vector(10);
    def.gyroscopic = !dice.one_in(8);
    const int shape_count = dice.one_in(4) ? 2 : 1;
    for (int i = 0; i < shape_count; ++i) {
        def.shapes.push_back(roll_shape(dice));
        if (i > 0) def.shapes.back().local_pose.position = dice.vector(0.4f);
    }
    return def;
}

// The i-th body of a crowd, at its place in a loose block.
BodyDef roll_small_body(int i, Dice& dice) {
    constexpr int across = 10;
    constexpr double pitch = 0.7;
    ShapeDef shape;
    shape.geometry = Sphere{dice.between(0.15f, 0.3f)};
    if (dice.one_in(3)) {
        const float radius = dice.between(0.1f, 0.2f);
        shape.geometry = Capsule{radius, dice.between(0.1f, 0.3f)};
    } else if (!dice.one_in(4)) {
        const float x = dice.between(0.1f, 0.3f);
        const float y = dice.between(0.1f, 0.3f);
        shape.geometry = Box{{x, y, dice.between(0.1f, 0.3f)}};
    }
    shape.density = dice.between(300, 3000);
    shape.material.friction = dice.between(0, 1);
    BodyDef def;
    const double x = pitch * (i % across - 0.5 * (across - 1));
    const double z = pitch * (i / across % across - 0.5 * (across - 1));
    def.position = {x, 1.5 + pitch * (i / (across * across)), z};
    def.linear_velocity = dice.vector(1);
    def.shapes = {shape};
    return def;
}

void change_settings(World& world, const Kind& kind, Dice& dice) {
    // 0 leaves a method its own budget, as half of all rolls do.
    const auto roll_budget = [&](int most) {
        const bool is_default = dice.one_in(2);
        const int budget = 1 + dice.below(most);
        return is_default ? 0 : budget;
    };
    WorldSettings settings = world.settings();
    if (dice.one_in(2)) settings.step.solver = Solver::SequentialImpulse;
    if (dice.one_in(2)) settings.step.solver = Solver::SoftStep;
    if (dice.one_in(3)) settings.step.solver = Solver::Xpbd;
    settings.step.narrow_phase = dice.one_in(2) ? NarrowPhase::Sat : NarrowPhase::GjkEpa;
    settings.step.iterations = roll_budget(kind.most_iterations);
    settings.step.substeps = roll_budget(kind.most_substeps);
    settings.step.reuse_contacts = !dice.one_in(3);
    settings.sleeping = !dice.one_in(4);
    settings.sleep_time = dice.between(0.1f, 1);
    (void)world.set_settings(settings);
}

// By an impulse, a torque, a force or a new velocity. At most 20 m/s and about 30 rad/s along an
// axis and at once: a light body that turns several times in a step, or crosses the pit, is nowhere
// that a wall could find it.
void shove(World& world, BodyId body, Dice& dice) {
    const MassProperties resists = world.mass_properties(body);
    const SymmetricMat3& inertia = resists.inertia;
    const float least = std::min(inertia.xx, std::min(inertia.yy, inertia.zz));
    const auto a_step = static_cast<float>(1 / dt);
    switch (dice.below(4)) {
        case 0: (void)world.apply_impulse(body, dice.vector(20 * resists.mass)); break;
        case 1: (void)world.apply_torque(body, dice.vector(30 * least * a_step)); break;
        case 2: (void)world.apply_force(body, dice.vector(20 * resists.mass * a_step)); break;
        default: (void)world.set_linear_velocity(body, dice.vector(5)); break;
    }
}

void change_shapes(World& world, BodyId body, Dice& dice) {
    if (dice.one_in(2)) {
        (void)world.create_shape(body, roll_shape(dice));
        return;
    }
    const std::vector<ShapeId> shapes = world.shapes(body);
    if (shapes.size() > 1) (void)world.destroy_shape(shapes.front());
}

void change_rest(World& world, BodyId body, Dice& dice) {
    if (dice.one_in(3)) {
        (void)world.set_can_sleep(body, dice.one_in(2));
        return;
    }
    (void)world.set_awake(body, dice.one_in(2));
}

void change_nature(World& world, BodyId body, Dice& dice) {
    switch (dice.below(4)) {
        case 0: {
            const bool rx = dice.one_in(2);
            (void)world.set_locked_axes(body, {.rx = rx, .ry = dice.one_in(2)});
            break;
        }
        case 1: {
            const float linear = dice.between(0, 1);
            (void)world.set_damping(body, linear, dice.between(0, 1));
            break;
        }
        case 2: {
            // Few stand for ever: a body that was static mostly becomes dynamic again.
            const bool is_static = world.state(body).kind == BodyKind::Static;
            const bool stays = dice.one_in(4);
            (void)world.set_kind(body, is_static != stays ? BodyKind::Dynamic : BodyKind::Static);
            break;
        }
        default: {
            const std::vector<ShapeId> shapes = world.shapes(body);
            (void)world.set_material(shapes.front(), roll_shape(dice).material);
            break;
        }
    }
}

}  // namespace

World make_world(const Kind& kind, Dice& dice) {
    WorldSettings settings;
    constexpr Solver solvers[] = {Solver::SequentialImpulse, Solver::SoftStep, Solver::Xpbd};
    settings.step.solver = solvers[dice.below(3)];
    settings.step.narrow_phase = dice.one_in(2) ? NarrowPhase::Sat : NarrowPhase::GjkEpa;
    World world = *World::create(settings);
    BodyDef walls{.kind = BodyKind::Static};
    const auto offset = static_cast<float>(-pit_half_width);
    walls.shapes = {{.geometry = Plane{{0, 1, 0}, 0}},
                    {.geometry = Plane{{1, 0, 0}, offset}},
                    {.geometry = Plane{{-1, 0, 0}, offset}},
                    {.geometry = Plane{{0, 0, 1}, offset}},
                    {.geometry = Plane{{0, 0, -1}, offset}}};
    (void)world.create_body(walls);
    (void)world.create_body({.kind = BodyKind::Static,
                             .position = {1, 0.5, 0},
                             .shapes = {{.geometry = Box{{1, 0.5f, 0.2f}}}}});
    if (kind.fewest < crowd.fewest) return world;
    const auto count = static_cast<int>((kind.fewest + kind.most) / 2);
    for (int i = 0; i < count; ++i) (void)world.create_body(roll_small_body(i, dice));
    return world;
}

void change(World& world, const Kind& kind, Dice dice) {
    const std::vector<BodyId> bodies = world.bodies();
    const int choice = bodies.size() < kind.fewest ? 0
                       : bodies.size() > kind.most ? 1
                                                   : dice.below(13);
    if (choice == 0) {
        (void)world.create_body(roll_body(dice));
        return;
    }
    // The first two are the pit and its block.
    const auto place =
        2 + static_cast<std::size_t>(dice.below(static_cast<int>(bodies.size()) - 2));
    const BodyId body = bodies[place];
    switch (choice) {
        case 1: (void)world.destroy_body(body); break;
        case 2: change_shapes(world, body, dice); break;
        case 3:
        case 4: change_nature(world, body, dice); break;
        case 5: change_settings(world, kind, dice); break;
        case 6:
            (void)world.set_pose(body, roll_body(dice).position, rotation_about({0, 1, 1}, 1));
            break;
        case 7:
        case 8: change_rest(world, body, dice); break;
        default: shove(world, body, dice); break;
    }
}

}  // namespace cairn::soak

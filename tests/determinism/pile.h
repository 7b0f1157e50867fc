#pragma once
// A small heap that exercises everything a step keeps from one to the next: boxes and spheres, some
// on one body, that fall on a plane and on each other, spinning, sliding, bouncing and coming to
// rest.

#include "cairn/cairn.h"

namespace cairn::test {

inline constexpr double pile_dt = 1.0 / 60;

struct Method {
    Solver solver;
    NarrowPhase narrow_phase;
    const char* name;
};

// Every solver by every narrow phase.
inline constexpr Method methods[] = {
    {Solver::SequentialImpulse, NarrowPhase::Sat, "sequential-impulse, sat"},
    {Solver::SequentialImpulse, NarrowPhase::GjkEpa, "sequential-impulse, gjk-epa"},
    {Solver::SoftStep, NarrowPhase::Sat, "soft-step, sat"},
    {Solver::SoftStep, NarrowPhase::GjkEpa, "soft-step, gjk-epa"},
    {Solver::Xpbd, NarrowPhase::Sat, "xpbd, sat"},
    {Solver::Xpbd, NarrowPhase::GjkEpa, "xpbd, gjk-epa"},
};

// The i-th body of the heap: its place and kind follow from i alone.
inline BodyDef pile_body(int i) {
    const float size = 0.2f + 0.03f * static_cast<float>(i % 5);
    BodyDef def{.position = {0.31 * (i % 3) - 0.3, 0.4 + 0.55 * (i / 3), 0.27 * (i % 4) - 0.4},
                .rotation = rotation_about({1, 0.5f, 0.25f}, 0.4 * i),
                .angular_velocity = {0.5f * static_cast<float>(i % 4), 1, 0}};
    const Material material{.friction = 0.5f, .restitution = i % 6 == 0 ? 0.5f : 0.0f};
    const Box box{{size, 0.5f * size, 0.8f * size}};
    const Sphere ball{0.6f * size};
    if (i % 4 != 0) def.shapes.push_back({.geometry = box, .material = material});
    if (i % 4 == 0) def.shapes.push_back({.geometry = ball, .material = material});
    if (i % 7 == 0) {
        def.shapes.push_back({.geometry = ball, .local_pose = {.position = {size, 0, 0}}});
    }
    return def;
}

inline World make_pile(const Method& method, int body_count) {
    World world =
        *World::create({.step = {.solver = method.solver, .narrow_phase = method.narrow_phase}});
    (void)world.create_body({.kind = BodyKind::Static, .shapes = {{.geometry = Plane{}}}});
    for (int i = 0; i < body_count; ++i) (void)world.create_body(pile_body(i));
    return world;
}

inline void take_steps(World& world, int count) {
    for (int i = 0; i < count; ++i) (void)world.step(pile_dt);
}

}  // namespace cairn::test

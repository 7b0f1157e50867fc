// Case F19: the same input gives the same bits, and a copy of a world takes the same future.
//
// Builds and compilers are compared in tests/determinism; here two runs and a snapshot.

#include "scene.h"

namespace cairn::physics {

namespace {

// Balls and boxes tumble into a heap: contacts of every kind begin, last and end.
World make_heap(const Setup& setup) {
    World world = make_world(setup);
    add_ground(world, Ground::Plane, rough(0.5, 0.3));
    add_static(world, block({4, 0.2, 2}, rough(0.5)), {0, 2, 1});
    Random random(19);
    for (int i = 0; i < 48; ++i) {
        BodyDef def;
        def.shapes = {i % 3 == 0 ? ball(0.2, rough(0.4, 0.3))
                                 : block({0.3, 0.4, 0.5}, rough(0.6, 0.1))};
        def.position = to_position(Vec{i % 4 * 0.5 - 1, i / 4 % 4 * 0.5 - 1, 0.5 + i / 16 * 0.7} +
                                   random.in_cube(0.1));
        def.rotation = to_quat(random.turn());
        def.linear_velocity = to_vec3(random.in_cube(1));
        def.angular_velocity = to_vec3(random.in_cube(3));
        add(world, def);
    }
    return world;
}

void repeat(const Setup& setup, Sheet& sheet) {
    World one = make_heap(setup), other = make_heap(setup);
    int differing = 0, after_snapshot = 0, after_return = 0;
    const int count = steps_in(setup, 4);
    World snapshot = one;
    for (int i = 0; i < count; ++i) {
        if (i == count / 2) snapshot = one;
        advance(one, setup.dt);
        advance(other, setup.dt);
        if (one.state_hash() != other.state_hash()) ++differing;
    }
    // Back to the middle, forward again: in a copy, and in the world that had gone on.
    const std::uint64_t end = one.state_hash();
    other = snapshot;
    for (int i = count / 2; i < count; ++i) {
        advance(snapshot, setup.dt);
        advance(other, setup.dt);
        if (snapshot.state_hash() != other.state_hash()) ++after_return;
    }
    if (snapshot.state_hash() != end) ++after_snapshot;
    sheet.bound("steps that differ between two runs", differing, 0);
    sheet.bound("ends that differ after a snapshot", after_snapshot, 0);
    sheet.bound("steps that differ in a world put back", after_return, 0);
    sheet.claim("something moved", snapshot.contacts().size() > 20);
}

}  // namespace

std::vector<Case> determinism_cases() {
    return {
        {.id = "F19",
         .title = "the same again",
         .subject = Subject::Piling,
         .run = repeat,
         .quick = true},
    };
}

}  // namespace cairn::physics

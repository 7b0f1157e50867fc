// Same input, same bits, within one process: two runs, and a copy of a world against its original.
// What a copy left out (impulses of the last step, the order of slots and pairs, a pending force)
// would show as a different hash some steps on.

#include <doctest/doctest.h>

#include <vector>

#include "determinism/pile.h"

namespace {

using namespace cairn;
using namespace cairn::test;

// What a user does to a world between two steps: bodies go from the middle and come, one is pushed,
// one is put elsewhere, one takes a new shape.
void meddle(World& world, int round) {
    const std::vector<BodyId> bodies = world.bodies();
    const std::size_t count = bodies.size();
    REQUIRE(count > 8);
    const BodyId pushed = bodies[count - 3];
    CHECK(world.destroy_body(bodies[count / 2]).ok());
    CHECK(world.destroy_body(bodies[count / 3]).ok());
    CHECK(world.create_body(pile_body(40 + round)).ok());
    CHECK(world.create_body(pile_body(43 + round)).ok());
    CHECK(world.apply_impulse(pushed, {20, 30, -10}).ok());
    CHECK(world.set_pose(bodies[2], {2.0 + round, 1, 0}, {}).ok());
    CHECK(world.create_shape(bodies[3], {.geometry = Sphere{0.15f}}).ok());
    CHECK(world.apply_force(bodies[4], {300, 0, 0}).ok());
}

}  // namespace

TEST_CASE("the same heap stepped twice goes through the same states to the bit") {
    for (const Method& method : methods) {
        CAPTURE(method.name);
        World first = make_pile(method, 24);
        World second = make_pile(method, 24);
        for (int step = 0; step < 150; ++step) {
            take_steps(first, 1);
            take_steps(second, 1);
            REQUIRE(first.state_hash() == second.state_hash());
        }
    }
}

TEST_CASE("bodies of a heap do move and meet, so that the hashes compared here say something") {
    for (const Method& method : methods) {
        CAPTURE(method.name);
        World world = make_pile(method, 24);
        const std::uint64_t before = world.state_hash();
        take_steps(world, 150);
        CHECK(world.state_hash() != before);
        CHECK(world.contacts().size() > 20);
        CHECK(world.non_finite().empty());
    }
}

TEST_CASE("a copy of a world taken in mid-fall or at rest takes exactly the original's future") {
    for (const Method& method : methods) {
        CAPTURE(method.name);
        World original = make_pile(method, 24);
        for (const int start : {0, 1, 37, 100}) {
            CAPTURE(start);
            while (original.last_step().step < static_cast<std::uint64_t>(start)) {
                take_steps(original, 1);
            }
            World copy = original;
            World branch = original;
            CHECK(copy.state_hash() == original.state_hash());
            for (int step = 0; step < 60; ++step) {
                take_steps(copy, 1);
                take_steps(branch, 1);
                REQUIRE(copy.state_hash() == branch.state_hash());
            }
            // The original, stepped by itself later, is the third witness.
            World later = original;
            take_steps(later, 60);
            CHECK(later.state_hash() == copy.state_hash());
        }
    }
}

TEST_CASE("a copy meets insertion and removal of bodies in the middle just as its original does") {
    for (const Method& method : methods) {
        CAPTURE(method.name);
        World original = make_pile(method, 24);
        take_steps(original, 40);
        meddle(original, 0);
        take_steps(original, 20);
        World copy = original;
        for (int round = 1; round < 6; ++round) {
            meddle(original, round);
            meddle(copy, round);
            for (int step = 0; step < 25; ++step) {
                take_steps(original, 1);
                take_steps(copy, 1);
                REQUIRE(original.state_hash() == copy.state_hash());
            }
            CHECK(original.bodies() == copy.bodies());
        }
    }
}

TEST_CASE("a force waiting for the next step is part of a copy") {
    World original = make_pile(methods[0], 12);
    take_steps(original, 5);
    CHECK(original.apply_force(original.bodies()[3], {500, 0, 0}).ok());
    World copy = original;
    World without_force = make_pile(methods[0], 12);
    take_steps(original, 1);
    take_steps(copy, 1);
    take_steps(without_force, 6);
    CHECK(original.state_hash() == copy.state_hash());
    CHECK(original.state_hash() != without_force.state_hash());
}

TEST_CASE("stepping a copy leaves its original as it was") {
    World original = make_pile(methods[2], 12);
    take_steps(original, 30);
    const std::uint64_t hash = original.state_hash();
    World copy = original;
    take_steps(copy, 30);
    CHECK(copy.state_hash() != hash);
    CHECK(original.state_hash() == hash);
}

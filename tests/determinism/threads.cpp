// Any number of threads gives the same bits, Cairn's own or a host's that runs its jobs one after
// another.

#include <doctest/doctest.h>

#include <map>

#include "pile.h"

using namespace cairn;

namespace {

// Enough bodies for a step to be shared.
constexpr int heap = 500;

void run_jobs_backwards(void*, int count, Job job, void* context) {
    for (int i = count; i-- > 0;) job(context, i);
}

void meddle(World& world, int step) {
    const std::vector<BodyId> bodies = world.bodies();
    const BodyId some = bodies[1 + static_cast<std::size_t>(step) % (bodies.size() - 1)];
    if (step % 5 == 3) (void)world.destroy_body(some);
    if (step % 5 == 4) (void)world.create_body(test::pile_body(step));
    if (step % 11 == 8) (void)world.set_pose(some, {0.5, 4, 0.3}, {});
}

std::vector<std::uint64_t> follow_heap(World world, const Threads& threads) {
    REQUIRE(world.set_threads(threads).ok());
    std::vector<std::uint64_t> hashes;
    for (int step = 0; step < 24; ++step) {
        meddle(world, step);
        REQUIRE(world.step(test::pile_dt).ok());
        hashes.push_back(world.state_hash());
    }
    CHECK(world.last_step().pair_count > 1000);
    return hashes;
}

}  // namespace

TEST_CASE("a heap takes the same future on 1, 2, 3, 4 and 8 threads, and on a host's") {
    for (const test::Method& method : test::methods) {
        CAPTURE(method.name);
        World world = test::make_pile(method, heap);
        test::take_steps(world, 30);
        const std::vector<std::uint64_t> alone = follow_heap(world, {.count = 1});
        for (const int count : {2, 3, 4, 8}) {
            CAPTURE(count);
            CHECK(follow_heap(world, {.count = count}) == alone);
        }
        CHECK(follow_heap(world, {.count = 4, .run = run_jobs_backwards}) == alone);
    }
}

namespace {

// One island of so many contacts that a method's loops over its rows are shared: boxes, balls and
// capsules pushed side by side and on top of each other, off their places by a little.
World make_crowd(const test::Method& method) {
    World world =
        *World::create({.step = {.solver = method.solver, .narrow_phase = method.narrow_phase}});
    (void)world.create_body({.kind = BodyKind::Static, .shapes = {{.geometry = Plane{}}}});
    for (int i = 0; i < 12 * 12 * 5; ++i) {
        const double x = i % 12, y = i / 144, z = i / 12 % 12;
        const float turn = 0.02f * static_cast<float>(i % 7 - 3);
        BodyDef def{.position = {0.998 * x, 0.499 + 0.998 * y, 0.998 * z},
                    .rotation = rotation_about({0, 1, 0.2f}, turn)};
        const Material material{.friction = 0.5f, .restitution = i % 9 == 0 ? 0.4f : 0.0f};
        if (i % 5 == 0)
            def.shapes.push_back({.geometry = Sphere{0.5f}, .material = material});
        else if (i % 5 == 3)
            def.shapes.push_back({.geometry = Capsule{0.5f, 0.1f}, .material = material});
        else
            def.shapes.push_back({.geometry = Box{{0.5f, 0.5f, 0.5f}}, .material = material});
        (void)world.create_body(def);
    }
    return world;
}

std::vector<std::uint64_t> follow_crowd(World world, int threads) {
    REQUIRE(world.set_threads({.count = threads}).ok());
    std::vector<std::uint64_t> hashes;
    for (int step = 0; step < 6; ++step) {
        REQUIRE(world.step(test::pile_dt).ok());
        hashes.push_back(world.state_hash());
        // They part as they go.
        if (step < 2) CHECK(world.contacts().size() > 1100);
    }
    return hashes;
}

}  // namespace

TEST_CASE("an island whose rows threads share takes the same future on 1, 2, 3, 4 and 8 threads") {
    for (const test::Method& method : test::methods) {
        if (method.narrow_phase != NarrowPhase::Sat) continue;
        CAPTURE(method.name);
        const World world = make_crowd(method);
        const std::vector<std::uint64_t> alone = follow_crowd(world, 1);
        for (const int count : {2, 3, 4, 8}) {
            CAPTURE(count);
            CHECK(follow_crowd(world, count) == alone);
        }
    }
}

TEST_CASE("a count of threads that is out of range is refused and changes nothing") {
    World world = test::make_pile(test::methods[0], 4);
    const Status refused = world.set_threads({.count = 65});
    REQUIRE(!refused.ok());
    CHECK(refused.error().message.find("threads.count is 65") != std::string::npos);
    CHECK(!world.set_threads({.count = -1}).ok());
    CHECK(world.step(test::pile_dt).ok());
}

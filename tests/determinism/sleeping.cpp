// Sleeping and the bits: whichever broad phase looks, whoever copies, and however much sleeps
// around, the same states.

#include <doctest/doctest.h>

#include <vector>

#include "cairn/cairn.h"

namespace {

using namespace cairn;

constexpr double dt = 1.0 / 60;

struct Random {
    std::uint64_t state = 1;
    std::uint32_t next() {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return std::uint32_t(state >> 33u);
    }
    std::uint32_t below(std::size_t n) { return next() % std::uint32_t(n); }
    float between(float low, float high) {
        return low + (high - low) * float(next() % 4096) / 4096.0f;
    }
};

BodyId add_ground(World& world, float x, float z) {
    return *world.create_body({.kind = BodyKind::Static,
                               .position = {x, -0.5, z},
                               .shapes = {{.geometry = Box{{2, 0.5f, 2}}}}});
}

Result<BodyId> add_body(World& world, Random& random) {
    BodyDef def;
    const float half = random.between(0.15f, 0.3f);
    const std::uint32_t kind = random.below(12);
    def.kind = kind == 0 ? BodyKind::Static : kind == 1 ? BodyKind::Kinematic : BodyKind::Dynamic;
    def.position = {random.between(-4, 4), random.between(0.3f, 2), random.between(-4, 4)};
    const Material sticky = {
        .friction = 0.7f, .rolling_friction = 0.02f, .spinning_friction = 0.02f};
    ShapeDef shape = {.geometry = Box{{half, half, half}}, .material = sticky};
    if (random.below(3) == 0) shape.geometry = Sphere{half};
    if (random.below(3) == 0) shape.geometry = Capsule{half, half};
    def.shapes = {shape};
    return world.create_body(def);
}

// One of the things that a user may do between two steps.
void meddle(World& world, Random& random) {
    const std::vector<BodyId> bodies = world.bodies();
    const BodyId body = bodies[random.below(bodies.size())];
    const Vec3 some = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    switch (random.below(16)) {
        case 0:
        case 1: (void)add_body(world, random); break;
        case 2: (void)world.destroy_body(body); break;
        case 3: (void)world.apply_impulse(body, 20.0f * some); break;
        case 4: (void)world.apply_force(body, 200.0f * some); break;
        case 5: {
            const Position p = world.position(body);
            (void)world.set_pose(body, {p.x + double(some.x), 0.5 + double(some.y), p.z}, {});
            break;
        }
        case 6: (void)world.set_kind(body, BodyKind(random.below(3))); break;
        case 7: (void)world.set_linear_velocity(body, some); break;
        case 8: (void)world.set_linear_velocity(body, {}); break;
        case 9: (void)world.set_angular_velocity(body, some); break;
        case 10: (void)world.set_awake(body, random.below(2) == 0); break;
        case 11: (void)world.set_can_sleep(body, random.below(4) != 0); break;
        case 12: (void)world.set_collision_filter(body, {.mask = 0xfu << random.below(2)}); break;
        case 13: (void)world.create_shape(body, {.geometry = Sphere{0.2f}}); break;
        case 14: {
            const std::vector<ShapeId> shapes = world.shapes(body);
            if (!shapes.empty()) (void)world.destroy_shape(shapes[random.below(shapes.size())]);
            break;
        }
        default: (void)world.set_constant_force(body, 30.0f * some, {}); break;
    }
    if (world.body_count() < 30) (void)add_body(world, random);
}

World make_heap(Solver solver, BroadPhase broad_phase) {
    WorldSettings settings;
    settings.step.solver = solver;
    settings.step.broad_phase = broad_phase;
    settings.sleep_time = 0.2f;
    World world = *World::create(settings);
    for (const float x : {-3.0f, 3.0f}) {
        for (const float z : {-3.0f, 3.0f}) add_ground(world, x, z);
    }
    Random random{5};
    for (int i = 0; i < 40; ++i) (void)add_body(world, random);
    return world;
}

// A tower that may not sleep, then others that may.
World make_towers(Solver solver, int count, std::vector<BodyId>& first) {
    WorldSettings settings;
    settings.step.solver = solver;
    World world = *World::create(settings);
    (void)world.create_body({.kind = BodyKind::Static,
                             .position = {0, -1, 0},
                             .shapes = {{.geometry = Box{{200, 1, 10}}}}});
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < 4; ++k) {
            const BodyId body = *world.create_body(
                {.position = {3.0 * i + 0.02 * k, 0.5 + k, 0}, .shapes = {{.geometry = Box{}}}});
            if (i > 0) continue;
            (void)world.set_can_sleep(body, false);
            first.push_back(body);
        }
    }
    return world;
}

}  // namespace

TEST_CASE("a heap that sleeps, wakes and is meddled with is the same under both broad phases") {
    for (const Solver solver : {Solver::SoftStep, Solver::SequentialImpulse, Solver::Xpbd}) {
        World tree = make_heap(solver, BroadPhase::Tree);
        World brute = make_heap(solver, BroadPhase::BruteForce);
        Random random{9}, other_random{9};
        std::size_t slept = 0, most_awake = 0;
        for (int k = 0; k < 1500; ++k) {
            CAPTURE(k);
            if (k % 40 == 0) {
                meddle(tree, random);
                meddle(brute, other_random);
            }
            REQUIRE(tree.step(dt).ok());
            REQUIRE(brute.step(dt).ok());
            REQUIRE(tree.state_hash() == brute.state_hash());
            REQUIRE(tree.last_step().pair_count == brute.last_step().pair_count);
            REQUIRE(tree.contact_events().size() == brute.contact_events().size());
            slept += tree.last_step().asleep_count;
            most_awake = std::max(most_awake, tree.last_step().awake_count);
        }
        CHECK(slept > 1500);
        CHECK(most_awake > 10);
    }
}

TEST_CASE("a copy of a heap that partly sleeps takes its future, whatever is done to both") {
    for (const Solver solver : {Solver::SoftStep, Solver::SequentialImpulse, Solver::Xpbd}) {
        World world = make_heap(solver, BroadPhase::Tree);
        Random random{3};
        for (int round = 0; round < 12; ++round) {
            for (int k = 0; k < 100; ++k) {
                if (k % 25 == 0) meddle(world, random);
                REQUIRE(world.step(dt).ok());
            }
            World copy = world;
            Random other_random = random, same_random = random;
            World original = world;
            for (int k = 0; k < 100; ++k) {
                if (k % 10 == 0) {
                    meddle(original, same_random);
                    meddle(copy, other_random);
                }
                REQUIRE(original.step(dt).ok());
                REQUIRE(copy.step(dt).ok());
                REQUIRE(original.state_hash() == copy.state_hash());
            }
        }
    }
}

TEST_CASE("switched to the other broad phase and back, a sleeping heap goes on the same") {
    World steady = make_heap(Solver::SoftStep, BroadPhase::Tree);
    World switching = make_heap(Solver::SoftStep, BroadPhase::Tree);
    Random random{21}, other_random{21};
    for (int k = 0; k < 1200; ++k) {
        if (k % 60 == 0) {
            meddle(steady, random);
            meddle(switching, other_random);
        }
        if (k % 150 == 149) {
            WorldSettings settings = switching.settings();
            const bool was_tree = settings.step.broad_phase == BroadPhase::Tree;
            settings.step.broad_phase = was_tree ? BroadPhase::BruteForce : BroadPhase::Tree;
            REQUIRE(switching.set_settings(settings).ok());
        }
        REQUIRE(steady.step(dt).ok());
        REQUIRE(switching.step(dt).ok());
        REQUIRE(steady.state_hash() == switching.state_hash());
    }
}

namespace {

void step_alike(World& a, World& b, int steps, const std::vector<BodyId>& bodies) {
    for (int k = 0; k < steps; ++k) {
        CAPTURE(k);
        REQUIRE(a.step(dt).ok());
        REQUIRE(b.step(dt).ok());
        for (const BodyId body : bodies) {
            const BodyState in_a = a.state(body), in_b = b.state(body);
            REQUIRE(in_a.position == in_b.position);
            REQUIRE(in_a.rotation == in_b.rotation);
            REQUIRE(in_a.linear_velocity == in_b.linear_velocity);
        }
    }
}

}  // namespace

// The other solvers sweep until the whole world has settled: among towers that still move, one
// does not go its own way to the bit.
TEST_CASE("a tower among sleeping ones goes through the states of the tower alone") {
    std::vector<BodyId> tower, tower_of_many;
    World alone = make_towers(Solver::SoftStep, 1, tower);
    World among = make_towers(Solver::SoftStep, 30, tower_of_many);
    step_alike(alone, among, 400, tower);
    CHECK(among.last_step().awake_count == 4);
    for (World* world : {&alone, &among}) REQUIRE(world->apply_impulse(tower[3], {0, 0, 400}).ok());
    step_alike(alone, among, 200, tower);
}

TEST_CASE("a tower goes on the same when the sleeping ones around it are destroyed") {
    for (const Solver solver : {Solver::SoftStep, Solver::SequentialImpulse, Solver::Xpbd}) {
        CAPTURE(int(solver));
        std::vector<BodyId> tower;
        World among = make_towers(solver, 30, tower);
        for (int k = 0; k < 600; ++k) REQUIRE(among.step(dt).ok());
        REQUIRE(among.last_step().awake_count == 4);
        World alone = among;
        for (const BodyId body : alone.bodies()) {
            if (among.state(body).asleep) REQUIRE(alone.destroy_body(body).ok());
        }
        CHECK(alone.body_count() == 5);
        for (World* world : {&alone, &among})
            REQUIRE(world->apply_impulse(tower[3], {0, 0, 400}).ok());
        step_alike(alone, among, 200, tower);
    }
}

// Does anything give way when a world is used for a long time and by surprise?
//
//   test_soak --seconds N --seed S
//
// Steps worlds into which bodies and shapes come, go, are pushed, thrown, moved, locked and changed
// in kind, while solver, narrow phase and budget change between steps, until the time is over. What
// must hold throughout: no number that is not finite, no energy from nowhere, contacts only between
// living bodies, and a copy taken at any time goes through exactly its original's states when it is
// treated alike. One world lives for 4000 steps; a seed gives the same worlds on every machine, so
// a failure, which prints seed, world and step, can be had again with `--seed S --world W`.

#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "cairn/cairn.h"

namespace {

using namespace cairn;

// SplitMix64: small, and the same everywhere. Each roll is a statement of its own or stands in
// braces: the order in which a call's arguments are found is the compiler's choice.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15ull;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30u)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27u)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31u);
    }
    int below(int bound) { return static_cast<int>(next() % static_cast<std::uint64_t>(bound)); }
    float between(float low, float high) {
        return low + (high - low) * (static_cast<float>(next() >> 40u) / 16777216.0f);
    }
    Vec3 vector(float range) {
        const float x = between(-range, range);
        const float y = between(-range, range);
        return {x, y, between(-range, range)};
    }

private:
    std::uint64_t state_;
};

constexpr double dt = 1.0 / 60;
constexpr int steps_a_world = 4000;
constexpr int copy_period = 400;
constexpr int most_bodies = 60;
constexpr double pit_half_width = 4;

struct Failure {
    const char* what = nullptr;
};

ShapeDef roll_shape(Dice& dice) {
    ShapeDef shape;
    if (dice.below(2) == 0) {
        shape.geometry = Sphere{dice.between(0.1f, 0.5f)};
    } else {
        const float x = dice.between(0.05f, 0.6f);
        const float y = dice.between(0.05f, 0.6f);
        shape.geometry = Box{{x, y, dice.between(0.05f, 0.6f)}};
    }
    shape.density = dice.between(100, 5000);
    shape.material.friction = dice.between(0, 1);
    shape.material.restitution = dice.below(4) == 0 ? dice.between(0, 1) : 0.0f;
    shape.material.rolling_friction = dice.below(4) == 0 ? dice.between(0, 0.05f) : 0.0f;
    shape.material.spinning_friction = dice.below(4) == 0 ? dice.between(0, 0.05f) : 0.0f;
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
    def.gyroscopic = dice.below(8) != 0;
    const int shape_count = 1 + (dice.below(4) == 0 ? 1 : 0);
    for (int i = 0; i < shape_count; ++i) {
        def.shapes.push_back(roll_shape(dice));
        if (i > 0) def.shapes.back().local_pose.position = dice.vector(0.4f);
    }
    return def;
}

World make_pit(Dice& dice) {
    WorldSettings settings;
    constexpr Solver solvers[] = {Solver::SequentialImpulse, Solver::SoftStep, Solver::Xpbd};
    settings.step.solver = solvers[dice.below(3)];
    settings.step.narrow_phase = dice.below(2) == 0 ? NarrowPhase::Sat : NarrowPhase::GjkEpa;
    World world = *World::create(settings);
    BodyDef pit{.kind = BodyKind::Static};
    const auto offset = static_cast<float>(-pit_half_width);
    pit.shapes = {{.geometry = Plane{{0, 1, 0}, 0}},
                  {.geometry = Plane{{1, 0, 0}, offset}},
                  {.geometry = Plane{{-1, 0, 0}, offset}},
                  {.geometry = Plane{{0, 0, 1}, offset}},
                  {.geometry = Plane{{0, 0, -1}, offset}}};
    (void)world.create_body(pit);
    (void)world.create_body({.kind = BodyKind::Static,
                             .position = {1, 0.5, 0},
                             .shapes = {{.geometry = Box{{1, 0.5f, 0.2f}}}}});
    return world;
}

// By an impulse, a torque, a force or a new velocity, as `choice` says. At most 20 m/s and about
// 30 rad/s along an axis and at once: a light body that turns several times in a step, or crosses
// the pit, is nowhere that a wall could find it.
void shove(World& world, BodyId body, int choice, Dice& dice) {
    const MassProperties resists = world.mass_properties(body);
    const SymmetricMat3& inertia = resists.inertia;
    const float least = std::min(inertia.xx, std::min(inertia.yy, inertia.zz));
    const auto a_step = static_cast<float>(1 / dt);
    switch (choice) {
        case 2: (void)world.apply_impulse(body, dice.vector(20 * resists.mass)); break;
        case 3: (void)world.apply_torque(body, dice.vector(30 * least * a_step)); break;
        case 4: (void)world.apply_force(body, dice.vector(20 * resists.mass * a_step)); break;
        default: (void)world.set_linear_velocity(body, dice.vector(5)); break;
    }
}

void change_settings(World& world, Dice& dice) {
    // 0 leaves a method its own budget, as half of all rolls do.
    const auto roll_budget = [&](int most) {
        const bool is_default = dice.below(2) == 0;
        const int budget = 1 + dice.below(most);
        return is_default ? 0 : budget;
    };
    WorldSettings settings = world.settings();
    if (dice.below(2) == 0) settings.step.solver = Solver::SequentialImpulse;
    if (dice.below(2) == 0) settings.step.solver = Solver::SoftStep;
    if (dice.below(3) == 0) settings.step.solver = Solver::Xpbd;
    settings.step.narrow_phase = dice.below(2) == 0 ? NarrowPhase::Sat : NarrowPhase::GjkEpa;
    settings.step.iterations = roll_budget(15);
    settings.step.substeps = roll_budget(20);
    (void)world.set_settings(settings);
}

// One change of a user's, the same to the bit on worlds that are in the same state.
void change(World& world, Dice dice) {
    const std::vector<BodyId> bodies = world.bodies();
    // The first two are the pit and its block.
    const auto any = [&] {
        return bodies[2 +
                      static_cast<std::size_t>(dice.below(static_cast<int>(bodies.size()) - 2))];
    };
    const bool is_empty = bodies.size() < 8;
    const bool is_full = bodies.size() > most_bodies;
    const int choice = is_empty ? 0 : is_full ? 1 : dice.below(12);
    switch (choice) {
        case 0: (void)world.create_body(roll_body(dice)); break;
        case 1: (void)world.destroy_body(any()); break;
        case 2:
        case 3:
        case 4:
        case 5: shove(world, any(), choice, dice); break;
        case 6: {
            const BodyId body = any();
            (void)world.create_shape(body, roll_shape(dice));
            break;
        }
        case 7: {
            const BodyId body = any();
            const std::vector<ShapeId> shapes = world.shapes(body);
            if (shapes.size() > 1) (void)world.destroy_shape(shapes.front());
            break;
        }
        case 8: {
            const BodyId body = any();
            (void)world.set_pose(body, roll_body(dice).position, rotation_about({0, 1, 1}, 1));
            break;
        }
        case 9: {
            const BodyId body = any();
            const bool rx = dice.below(2) == 0;
            const bool ry = dice.below(2) == 0;
            (void)world.set_locked_axes(body, {.rx = rx, .ry = ry});
            break;
        }
        case 10: change_settings(world, dice); break;
        default: {
            const BodyId body = any();
            const float linear = dice.between(0, 1);
            const float angular = dice.between(0, 1);
            (void)world.set_damping(body, linear, angular);
        }
    }
}

bool is_finite(const BodyState& state) {
    const double sum = state.position.x + state.position.y + state.position.z +
                       static_cast<double>(state.linear_velocity.x) +
                       static_cast<double>(state.linear_velocity.y) +
                       static_cast<double>(state.linear_velocity.z) +
                       static_cast<double>(state.angular_velocity.x) +
                       static_cast<double>(state.angular_velocity.y) +
                       static_cast<double>(state.angular_velocity.z) +
                       static_cast<double>(state.rotation.x) +
                       static_cast<double>(state.rotation.w);
    return std::isfinite(sum);
}

// What must hold after every step, wherever the bodies are.
Failure inspect(const World& world) {
    if (!world.non_finite().empty()) return {"a body's numbers went wrong"};
    for (const BodyId body : world.bodies()) {
        const BodyState state = world.state(body);
        if (!is_finite(state)) return {"a state that is not finite, and nobody said so"};
        if (state.position.y < -1 || std::abs(state.position.x) > pit_half_width + 1 ||
            std::abs(state.position.z) > pit_half_width + 1) {
            return {"a body left the pit through a wall or the floor"};
        }
    }
    for (const ContactReport& contact : world.contacts()) {
        if (!world.is_valid(contact.body_a) || !world.is_valid(contact.body_b)) {
            return {"a contact of a body that is gone"};
        }
        for (int i = 0; i < contact.point_count; ++i) {
            const ContactPointReport& point = contact.points[static_cast<std::size_t>(i)];
            if (!(point.normal_impulse >= 0)) return {"a contact that pulls"};
        }
    }
    return {};
}

// Half a second without any change: contacts may only take energy away. Overlaps that a change has
// made, a body put into others say, may give some back as they part, so the world settles first.
Failure let_settle(World& world) {
    for (int step = 0; step < 120; ++step) (void)world.step(dt);
    const double before = world.energy().total;
    const double moving = world.energy().kinetic;
    for (int step = 0; step < 30; ++step) (void)world.step(dt);
    const double gain = world.energy().total - before;
    if (gain > 0.05 * moving + 0.01 * std::abs(before) + 1) return {"energy from nowhere"};
    return inspect(world);
}

// A copy, treated as its original is, must stay equal to it.
Failure compare_copy(World& world, Dice& dice) {
    World copy = world;
    for (int step = 0; step < 60; ++step) {
        const Dice shared(dice.next());
        if (step % 7 == 0) {
            change(world, shared);
            change(copy, shared);
        }
        (void)world.step(dt);
        (void)copy.step(dt);
        if (world.state_hash() != copy.state_hash()) return {"a copy took another future"};
    }
    return {};
}

// The life of one world; `step` is where something failed. A whole life's last state goes into
// `hash`.
Failure run_world(std::uint64_t seed, int& step, double seconds_left, std::uint64_t& hash) {
    const auto begin = std::chrono::steady_clock::now();
    Dice dice(seed);
    World world = make_pit(dice);
    Failure failure;
    for (step = 0; step < steps_a_world; ++step) {
        if (dice.below(6) == 0) change(world, Dice(dice.next()));
        if (!world.step(dt).ok()) return {"a step was refused"};
        failure = inspect(world);
        if (failure.what == nullptr && step % copy_period == 0) failure = compare_copy(world, dice);
        if (failure.what == nullptr && step % copy_period == copy_period / 2) {
            failure = let_settle(world);
        }
        if (failure.what != nullptr) return failure;
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
        if (spent.count() > seconds_left) return {};
    }
    hash = 31 * hash + world.state_hash();
    return {};
}

}  // namespace

int main(int argc, char** argv) {
    double seconds = 10;
    std::uint64_t seed = 1;
    std::uint64_t only_world = 0;
    bool is_only_one = false;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string_view name = argv[i];
        if (name == "--seconds") seconds = std::atof(argv[i + 1]);
        if (name == "--seed") seed = std::strtoull(argv[i + 1], nullptr, 10);
        if (name == "--world") {
            only_world = std::strtoull(argv[i + 1], nullptr, 10);
            is_only_one = true;
        }
    }
    const auto begin = std::chrono::steady_clock::now();
    std::uint64_t worlds = 0;
    std::uint64_t steps = 0;
    std::uint64_t hash = 0;
    for (std::uint64_t world = only_world;; ++world) {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
        if (spent.count() >= seconds) break;
        int step = 0;
        const Failure failure =
            run_world(seed + 1000003 * world, step, seconds - spent.count(), hash);
        ++worlds;
        steps += static_cast<std::uint64_t>(step);
        if (failure.what != nullptr) {
            std::printf("FAILED: %s; step %d of --seed %" PRIu64 " --world %" PRIu64 "\n",
                        failure.what, step, seed, world);
            return 1;
        }
        if (is_only_one) break;
    }
    // The hash is of whole lives, so that two builds given the same world can be compared.
    std::printf("soaked: %" PRIu64 " worlds, %" PRIu64 " steps, seed %" PRIu64
                ", states %016" PRIx64 "\n",
                worlds, steps, seed, hash);
    return 0;
}

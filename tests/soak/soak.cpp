// Does anything give way when a world is used for a long time and by surprise?
//
//   test_soak --seconds N --seed S
//
// Steps worlds into which bodies and shapes come, go, are pushed, thrown, moved, locked, put to
// sleep and changed in kind, while solver, narrow phase, budget, threads, lanes and broad phase
// change between steps, until the time is over. What must hold throughout: no number that is not
// finite, no energy from nowhere, contacts only between living bodies, what sleeps stands still,
// and a copy taken at any time goes through exactly its original's states when it is treated alike,
// on whatever threads. Every other world is a crowd, whose steps threads share; the others live
// longer. A seed gives the same worlds on every machine, so a failure, which prints seed, world and
// step, can be had again with `--seed S --world W`.

#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "user.h"
#include "ways.h"

namespace {

using namespace cairn;
using namespace cairn::soak;

struct Failure {
    const char* what = nullptr;
    BodyId body = {};  // where one is to blame
};

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
    std::size_t asleep = 0;
    for (const BodyId body : world.bodies()) {
        const BodyState state = world.state(body);
        if (!is_finite(state)) return {"a state that is not finite, and nobody said so", body};
        if (state.position.y < -1 || std::abs(state.position.x) > pit_half_width + 1 ||
            std::abs(state.position.z) > pit_half_width + 1) {
            return {"a body left the pit through a wall or the floor", body};
        }
        if (!state.asleep) continue;
        ++asleep;
        if (state.linear_velocity != Vec3{} || state.angular_velocity != Vec3{})
            return {"a body moves in its sleep", body};
    }
    if (asleep != world.last_step().asleep_count) return {"sleepers that nobody counted"};
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
constexpr int settling_steps = 120, still_steps = 30;
Failure let_settle(World& world) {
    for (int step = 0; step < settling_steps; ++step) (void)world.step(dt);
    const double before = world.energy().total;
    const double moving = world.energy().kinetic;
    for (int step = 0; step < still_steps; ++step) (void)world.step(dt);
    const double gain = world.energy().total - before;
    if (gain > 0.05 * moving + 0.01 * std::abs(before) + 1) return {"energy from nowhere"};
    return inspect(world);
}

// A copy, treated as its original is, must stay equal to it, whoever does the work of the two.
Failure compare_copy(World& world, const Kind& kind, Dice& dice) {
    World copy = world;
    const int steps = kind.steps_a_copy / 7 + 3;
    for (int step = 0; step < steps; ++step) {
        const Dice shared(dice.next());
        if (step % 7 == 0) {
            change(world, kind, shared);
            change(copy, kind, shared);
        }
        if (step % 10 == 0) change_way(copy, dice);
        (void)world.step(dt);
        (void)copy.step(dt);
        if (world.state_hash() != copy.state_hash()) return {"a copy took another future"};
    }
    return {};
}

// What a world goes through beside its steps and changes, at this one of them. It is left to settle
// only where that is over before the time is.
Failure look_closer(World& world, const Kind& kind, int step, int steps_left, Dice& dice) {
    const int part = step % kind.steps_a_copy;
    if (part == 0) return compare_copy(world, kind, dice);
    if (part == kind.steps_a_copy / 4) return {step_together(world, dice)};
    if (part == kind.steps_a_copy / 2 && steps_left > settling_steps + still_steps)
        return let_settle(world);
    return {};
}

void describe(const World& world, const Failure& failure) {
    const StepSettings& step = world.settings().step;
    std::printf("  solver %d, %d substeps of %d iterations, narrow phase %d, reuse %d\n",
                static_cast<int>(step.solver), step.substeps, step.iterations,
                static_cast<int>(step.narrow_phase), step.reuse_contacts ? 1 : 0);
    if (!failure.body) return;
    const BodyState s = world.state(failure.body);
    std::printf("  body %" PRIu32 " of kind %d and %g kg at (%g, %g, %g), going (%g, %g, %g) m/s\n",
                failure.body.index, static_cast<int>(s.kind),
                static_cast<double>(world.mass_properties(failure.body).mass), s.position.x,
                s.position.y, s.position.z, static_cast<double>(s.linear_velocity.x),
                static_cast<double>(s.linear_velocity.y), static_cast<double>(s.linear_velocity.z));
}

// The life of one world; `step` is where something failed. A whole life's last state goes into
// `hash`.
Failure run_world(const Kind& kind, std::uint64_t seed, int& step, double seconds_left,
                  std::uint64_t& hash) {
    const auto begin = std::chrono::steady_clock::now();
    const auto spent = [begin] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    Dice dice(seed);
    World world = make_world(kind, dice);
    change_way(world, dice);
    for (step = 0; step < kind.steps; ++step) {
        // Now and then several in a row, so that slots are used again before a step has seen them.
        const int changes = dice.one_in(kind.steps_a_change) ? 1 + 3 * (dice.below(4) / 3) : 0;
        for (int i = 0; i < changes; ++i) change(world, kind, Dice(dice.next()));
        if (!world.step(dt).ok()) return {"a step was refused"};
        Failure failure = inspect(world);
        const double left = (step + 1) * (seconds_left / spent() - 1);
        const auto steps_left = static_cast<int>(std::clamp(left, 0.0, 1e9));
        if (failure.what == nullptr) failure = look_closer(world, kind, step, steps_left, dice);
        if (failure.what != nullptr) {
            describe(world, failure);
            return failure;
        }
        if (spent() > seconds_left) return {};
    }
    hash = 31 * hash + world.state_hash();
    return {};
}

struct Flags {
    double seconds = 10;
    std::uint64_t seed = 1;
    std::uint64_t first_world = 0;
    bool is_only_one = false;
};

Flags read_flags(int argc, char** argv) {
    Flags flags;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string_view name = argv[i];
        if (name == "--seconds") flags.seconds = std::atof(argv[i + 1]);
        if (name == "--seed") flags.seed = std::strtoull(argv[i + 1], nullptr, 10);
        if (name == "--world") {
            flags.first_world = std::strtoull(argv[i + 1], nullptr, 10);
            flags.is_only_one = true;
        }
    }
    return flags;
}

}  // namespace

int main(int argc, char** argv) {
    const Flags flags = read_flags(argc, argv);
    const auto begin = std::chrono::steady_clock::now();
    std::uint64_t worlds = 0;
    std::uint64_t steps = 0;
    std::uint64_t hash = 0;
    for (std::uint64_t world = flags.first_world;; ++world) {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
        if (spent.count() >= flags.seconds) break;
        int step = 0;
        const Failure failure =
            run_world(world % 2 == 0 ? crowd : pit, flags.seed + 1000003 * world, step,
                      flags.seconds - spent.count(), hash);
        ++worlds;
        steps += static_cast<std::uint64_t>(step);
        if (failure.what != nullptr) {
            std::printf("FAILED: %s; step %d of --seed %" PRIu64 " --world %" PRIu64 "\n",
                        failure.what, step, flags.seed, world);
            return 1;
        }
        if (flags.is_only_one) break;
    }
    // The hash is of whole lives, so that two builds given the same world can be compared.
    std::printf("soaked: %" PRIu64 " worlds, %" PRIu64 " steps, %" PRIu64
                " runs of a host, seed %" PRIu64 ", states %016" PRIx64 "\n",
                worlds, steps, host_run_count(), flags.seed, hash);
    return 0;
}

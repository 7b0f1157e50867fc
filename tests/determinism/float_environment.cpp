// The bits of a step do not depend on how the host has set its processor, and the host finds it as
// it left it: rounding upward, downward or toward zero, and denormals flushed to zero, as any
// library linked with -ffast-math sets for its whole process.

#include <doctest/doctest.h>

#include <cfenv>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "determinism/pile.h"

namespace {

using namespace cairn;
using namespace cairn::test;

constexpr int step_count = 120;

// A heap, and beside it a body that slows down through the denormal numbers.
World make_heap(const Method& method) {
    World world = make_pile(method, 15);
    (void)world.create_body({.position = {50, 50, 50},
                             .linear_velocity = {2e-38f, -2e-38f, 1e-39f},
                             .shapes = {{.geometry = Sphere{}}},
                             .gravity_scale = 0,
                             .linear_damping = 1});
    return world;
}

std::uint64_t hash_under_defaults(const Method& method) {
    World world = make_heap(method);
    take_steps(world, step_count);
    return world.state_hash();
}

}  // namespace

TEST_CASE(
    "a host that rounds upward, downward or toward zero gets the same bits and keeps its mode") {
    for (const Method& method : methods) {
        CAPTURE(method.name);
        const std::uint64_t expected = hash_under_defaults(method);
        for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
            World world = make_heap(method);
            REQUIRE(std::fesetround(mode) == 0);
            take_steps(world, step_count);
            const int mode_after = std::fegetround();
            std::fesetround(FE_TONEAREST);
            CHECK(mode_after == mode);
            CHECK(world.state_hash() == expected);
        }
    }
}

TEST_CASE("a body made under another rounding mode is the same body") {
    World expected = make_pile(methods[0], 15);
    std::fesetround(FE_UPWARD);
    World world = *World::create(expected.settings());
    (void)world.create_body({.kind = BodyKind::Static, .shapes = {{.geometry = Plane{}}}});
    for (int i = 0; i < 15; ++i) {
        // The definition itself is the host's arithmetic; what the world makes of it is not.
        std::fesetround(FE_TONEAREST);
        const BodyDef def = pile_body(i);
        std::fesetround(FE_UPWARD);
        (void)world.create_body(def);
    }
    std::fesetround(FE_TONEAREST);
    take_steps(expected, step_count);
    take_steps(world, step_count);
    CHECK(world.state_hash() == expected.state_hash());
}

#if defined(__SSE2__)
TEST_CASE("a host that flushes denormals to zero gets the same bits and keeps its flags") {
    constexpr unsigned flush_to_zero = 0x8000;
    constexpr unsigned denormals_are_zero = 0x0040;
    for (const Method& method : methods) {
        CAPTURE(method.name);
        const std::uint64_t expected = hash_under_defaults(method);
        World world = make_heap(method);
        const unsigned before = _mm_getcsr();
        const unsigned flushing = before | flush_to_zero | denormals_are_zero;
        _mm_setcsr(flushing);
        take_steps(world, step_count);
        const unsigned after = _mm_getcsr();
        _mm_setcsr(before);
        // The low six bits are sticky notes of what happened, not modes.
        CHECK((after & ~0x3fu) == (flushing & ~0x3fu));
        CHECK(world.state_hash() == expected);
    }
}
#endif

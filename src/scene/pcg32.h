#pragma once
// Random numbers that are the same everywhere: PCG-XSH-RR with 64 bits of state and 32 of output
// (O'Neill 2014), on the stream whose increment is 1442695040888963407, the generator's default. A
// scene's jitter and the built-in scenes draw from it, so both are part of a scene's meaning.

#include <cstdint>

namespace cairn::scene {

class Pcg32 {
public:
    explicit Pcg32(std::uint64_t seed) : state_(seed + increment) { next(); }

    std::uint32_t next() {
        const std::uint64_t old = state_;
        state_ = old * multiplier + increment;
        const auto shifted = static_cast<std::uint32_t>(((old >> 18u) ^ old) >> 27u);
        const auto turn = static_cast<std::uint32_t>(old >> 59u);
        return (shifted >> turn) | (shifted << ((32u - turn) & 31u));
    }

    /// Uniform in [-range, range].
    double symmetric(double range) { return range * (2.0 * next() / 4294967295.0 - 1.0); }
    /// Uniform in [low, high].
    double between(double low, double high) { return low + (high - low) * (next() / 4294967295.0); }

private:
    static constexpr std::uint64_t multiplier = 6364136223846793005ull;
    static constexpr std::uint64_t increment = 1442695040888963407ull;
    std::uint64_t state_;
};

}  // namespace cairn::scene

#pragma once
// SplitMix64: small, and the same everywhere. Each roll is a statement of its own or stands in
// braces: the order in which a call's arguments are found is the compiler's choice.

#include <cstdint>

#include "cairn/cairn.h"

namespace cairn::soak {

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
    bool one_in(int chances) { return below(chances) == 0; }
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

}  // namespace cairn::soak

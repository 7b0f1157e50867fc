#pragma once
// The random numbers of the scenes: SplitMix64 (Steele, Lea, Flood 2014), the same everywhere.
// Nothing but sums, shifts, products and square roots, so that every machine builds the same scene.

#include <cmath>
#include <cstdint>

#include "scene.h"

namespace cairn::bench {

class SplitMix64 {
public:
    explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

    std::uint64_t draw() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    /// In [low, high), in steps of 2^-53 of the interval.
    double draw_between(double low, double high) {
        return low + (high - low) * (static_cast<double>(draw() >> 11) * 0x1p-53);
    }

    /// Every rotation alike: a point of the ball in four dimensions, pushed out to its surface.
    Rotation draw_rotation() {
        while (true) {
            Rotation q;
            double square = 0;
            for (double& component : q) {
                component = draw_between(-1, 1);
                square += component * component;
            }
            if (square > 1 || square < 0.01) continue;
            for (double& component : q) component /= std::sqrt(square);
            return q;
        }
    }

private:
    std::uint64_t state_;
};

}  // namespace cairn::bench

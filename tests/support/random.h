#pragma once
// Numbers by a linear congruence, the same on every machine.

#include <cstdint>

namespace cairn::test {

struct Random {
    std::uint64_t state;
    double unit() {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return double(state >> 33) / 2147483648.0;
    }
    double between(double low, double high) { return low + (high - low) * unit(); }
};

}  // namespace cairn::test

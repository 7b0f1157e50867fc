#pragma once
// The reference broad phase: every box against every other. Slow, obviously right, and kept for
// ever for the others to be tested against.

#include <cstdint>
#include <span>
#include <vector>

#include "math/aabb.h"

namespace cairn {

// A box and whose it is. Two proxies that both stand still make no pair.
struct Proxy {
    Aabb box;
    std::uint32_t id = 0;
    bool moves = false;
};

struct Pair {
    std::uint32_t a = 0;  // the smaller id
    std::uint32_t b = 0;
    friend constexpr auto operator<=>(const Pair&, const Pair&) = default;
};

class BruteForce {
public:
    // Replaces `pairs` by all pairs of overlapping boxes, sorted. The proxies come in ascending
    // order of id.
    void find_pairs(std::span<const Proxy> proxies, std::vector<Pair>& pairs);

private:
    // The boxes side by side, one array a face, so that a compiler tests several at once.
    std::vector<float> lower_x_, lower_y_, lower_z_, upper_x_, upper_y_, upper_z_;
};

}  // namespace cairn

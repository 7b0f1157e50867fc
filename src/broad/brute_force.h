#pragma once
// The reference broad phase: every box against every other. Slow, obviously right, and kept for
// ever for the others to be tested against.

#include <span>
#include <vector>

#include "base/large_array.h"
#include "broad/proxy.h"

namespace cairn {

class BruteForce {
public:
    // Replaces `pairs` by all pairs of overlapping boxes, sorted. The proxies come in ascending
    // order of id.
    void find_pairs(std::span<const Proxy> proxies, LargeArray<Pair>& pairs);

private:
    // The boxes side by side, one array a face, so that a compiler tests several at once.
    std::vector<float> lower_x_, lower_y_, lower_z_, upper_x_, upper_y_, upper_z_;
};

}  // namespace cairn

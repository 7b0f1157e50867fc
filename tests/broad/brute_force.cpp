// The reference broad phase against the definition of overlap.

#include "broad/brute_force.h"

#include <doctest/doctest.h>

using namespace cairn;

TEST_CASE("the pairs are exactly those whose boxes overlap and of which one moves, in order") {
    BruteForce broad;
    LargeArray<Pair> pairs;
    std::uint64_t random = 7;
    const auto next = [&] {
        random = random * 6364136223846793005u + 1442695040888963407u;
        return float(random >> 40) * (1.0f / float(1 << 24));
    };
    // More boxes than one block, a count that is no multiple of it, again with fewer.
    for (const std::uint32_t count : {0u, 1u, 64u, 333u, 90u}) {
        std::vector<Proxy> proxies;
        for (std::uint32_t i = 0; i < count; ++i) {
            const Vec3 center = {10 * next(), 10 * next(), 10 * next()};
            const Vec3 half = {next(), next(), next()};
            proxies.push_back({{center - half, center + half}, 3 * i, next() < 0.7f});
        }
        LargeArray<Pair> expected;
        for (std::uint32_t i = 0; i < count; ++i) {
            for (std::uint32_t j = i + 1; j < count; ++j) {
                const bool moves = proxies[i].moves || proxies[j].moves;
                if (moves && overlaps(proxies[i].box, proxies[j].box))
                    expected.push_back({3 * i, 3 * j});
            }
        }
        broad.find_pairs(proxies, pairs);
        CHECK(pairs == expected);
    }
}

TEST_CASE("boxes that share a face overlap") {
    BruteForce broad;
    LargeArray<Pair> pairs;
    const std::vector<Proxy> proxies = {{{{0, 0, 0}, {1, 1, 1}}, 0, true},
                                        {{{1, 0, 0}, {2, 1, 1}}, 1, false}};
    broad.find_pairs(proxies, pairs);
    CHECK(pairs.size() == 1);
}

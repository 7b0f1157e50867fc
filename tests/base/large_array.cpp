// Arrays of every size: what is asked for and given back must agree, whatever pages it is made of.

#include "base/large_array.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <numeric>

using namespace cairn;

TEST_CASE("an array that grows keeps its elements through every kind of page") {
    // 8 bytes each: from a heap's block to several large pages, and lengths beside each border.
    LargeArray<std::uint64_t> grown;
    for (const std::size_t size :
         {1u, 8191u, 8193u, 131071u, 131073u, 262145u, 400000u, 1u << 20u}) {
        const std::size_t before = grown.size();
        grown.resize(size);
        std::iota(grown.begin() + std::ptrdiff_t(before), grown.end(), before);
        bool all = true;
        for (std::size_t i = 0; i < size; ++i) all = all && grown[i] == i;
        CHECK(all);
        LargeArray<std::uint64_t> copy = grown;
        grown.shrink_to_fit();
        CHECK(copy == grown);
    }
}

TEST_CASE("elements lie as they want to be aligned, in small arrays too") {
    struct alignas(64) Wide {
        float numbers[16];
    };
    for (const std::size_t size : {1u, 3u, 1000u, 2000u, 40000u}) {
        const LargeArray<Wide> array(size);
        CHECK(reinterpret_cast<std::uintptr_t>(array.data()) % 64 == 0);
    }
}

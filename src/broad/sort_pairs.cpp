// Least significant digit first, over as many digits as the largest id has; see sort_pairs.h. A
// comparison sort took longer than finding the pairs.

#include "broad/sort_pairs.h"

#include <algorithm>
#include <bit>

namespace cairn {

namespace {

constexpr int digit_bits = 10;
constexpr std::uint32_t digit_count = 1u << digit_bits;
// Fewer are sorted sooner by comparisons than the digits are counted.
constexpr std::size_t few = 512;

template <std::uint32_t Pair::*id>
void sort_by_digit(LargeArray<Pair>& pairs, LargeArray<Pair>& room, int shift) {
    const auto digit = [shift](const Pair& pair) {
        return (pair.*id >> shift) & (digit_count - 1);
    };
    std::uint32_t starts[digit_count] = {};
    for (const Pair& pair : pairs) ++starts[digit(pair)];
    std::uint32_t start = 0;
    for (std::uint32_t& entry : starts) {
        const std::uint32_t count = entry;
        entry = start;
        start += count;
    }
    for (const Pair& pair : pairs) room[starts[digit(pair)]++] = pair;
    pairs.swap(room);
}

}  // namespace

void sort_pairs(LargeArray<Pair>& pairs, LargeArray<Pair>& room) {
    if (pairs.size() < few) {
        std::sort(pairs.begin(), pairs.end());
        return;
    }
    std::uint32_t ids = 0;
    for (const Pair& pair : pairs) ids |= pair.a | pair.b;
    const int bits = std::bit_width(ids);
    room.resize(pairs.size());
    for (int shift = 0; shift < bits; shift += digit_bits)
        sort_by_digit<&Pair::b>(pairs, room, shift);
    for (int shift = 0; shift < bits; shift += digit_bits)
        sort_by_digit<&Pair::a>(pairs, room, shift);
}

}  // namespace cairn

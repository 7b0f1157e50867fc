// Greedy colouring; see colouring.h.

#include "island/colouring.h"

#include <bit>

namespace cairn {

namespace {

constexpr std::uint32_t most_colours = 64;

}  // namespace

void Colouring::colour(std::span<const Edge> edges, std::size_t body_count, Colours& colours) {
    used_.assign(body_count, 0);
    colours_.resize(edges.size());
    counts_.assign(most_colours + 1, 0);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Edge& edge = edges[i];
        const std::uint64_t used =
            (edge.pushes_a ? used_[edge.body_a] : 0) | (edge.pushes_b ? used_[edge.body_b] : 0);
        const std::uint32_t colour = std::uint32_t(std::countr_one(used));
        colours_[i] = colour;
        ++counts_[colour];
        if (colour == most_colours) continue;
        const std::uint64_t bit = std::uint64_t{1} << colour;
        if (edge.pushes_a) used_[edge.body_a] |= bit;
        if (edge.pushes_b) used_[edge.body_b] |= bit;
    }
    // A counting sort: what is left over gets a colour each.
    colours.begins.clear();
    std::uint32_t begin = 0;
    std::vector<std::uint32_t>& next = counts_;
    for (std::uint32_t c = 0; c <= most_colours; ++c) {
        const std::uint32_t count = next[c];
        next[c] = begin;
        if (count > 0 && c < most_colours) colours.begins.push_back(begin);
        if (c == most_colours) {
            for (std::uint32_t k = 0; k < count; ++k) colours.begins.push_back(begin + k);
        }
        begin += count;
    }
    colours.begins.push_back(begin);
    colours.order.resize(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        colours.order[next[colours_[i]]++] = std::uint32_t(i);
    }
}

}  // namespace cairn

#pragma once
// Which contacts can be solved side by side: a colour holds contacts of which no two share a body
// that can be pushed.
//
// Greedy, in the order of the contacts: each takes the lowest colour that neither of its bodies
// has yet. Contacts of a body that has used all colours up come last, each in a colour of its
// own.

#include <cstdint>
#include <span>
#include <vector>

namespace cairn {

struct Colours {
    // Contacts, colour by colour: colour c holds order[begins[c]] to order[begins[c + 1]].
    std::vector<std::uint32_t> order;
    std::vector<std::uint32_t> begins;

    std::size_t count() const { return begins.empty() ? 0 : begins.size() - 1; }
    std::span<const std::uint32_t> operator[](std::size_t colour) const {
        return std::span(order).subspan(begins[colour], begins[colour + 1] - begins[colour]);
    }
};

class Colouring {
public:
    struct Edge {
        std::uint32_t body_a = 0, body_b = 0;
        bool pushes_a = false, pushes_b = false;
    };
    // Colours edges 0, 1, ... of a world of `body_count` bodies.
    void colour(std::span<const Edge> edges, std::size_t body_count, Colours& colours);

private:
    std::vector<std::uint64_t> used_;     // by body: a bit a colour
    std::vector<std::uint32_t> colours_;  // by edge
    std::vector<std::uint32_t> counts_;   // by colour
};

}  // namespace cairn

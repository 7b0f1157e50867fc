// Colouring: what is solved side by side shares nothing that can be pushed.

#include "island/colouring.h"

#include <doctest/doctest.h>

#include <set>

namespace {

using namespace cairn;

// A deterministic sequence, good enough to mix edges with.
std::uint32_t next(std::uint64_t& state) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return std::uint32_t(state >> 33u);
}

void check_colours(const std::vector<Colouring::Edge>& edges, const Colours& colours) {
    std::vector<bool> seen(edges.size(), false);
    for (std::size_t c = 0; c < colours.count(); ++c) {
        std::set<std::uint32_t> pushed;
        for (const std::uint32_t e : colours[c]) {
            CHECK(!seen[e]);
            seen[e] = true;
            if (edges[e].pushes_a) CHECK(pushed.insert(edges[e].body_a).second);
            if (edges[e].pushes_b) CHECK(pushed.insert(edges[e].body_b).second);
        }
    }
    for (const bool s : seen) CHECK(s);
}

}  // namespace

TEST_CASE("no two contacts of a colour share a body that can be pushed, and none is left out") {
    Colouring colouring;
    Colours colours;
    std::uint64_t state = 1;
    for (int round = 0; round < 50; ++round) {
        const std::uint32_t bodies = 2 + next(state) % 60;
        std::vector<Colouring::Edge> edges;
        for (std::uint32_t k = next(state) % 300; k > 0; --k) {
            const std::uint32_t a = next(state) % bodies;
            const std::uint32_t b = (a + 1 + next(state) % (bodies - 1)) % bodies;
            // Every fifth body cannot be pushed.
            if (a % 5 == 0 && b % 5 == 0) continue;
            edges.push_back({a, b, a % 5 != 0, b % 5 != 0});
        }
        colouring.colour(edges, bodies, colours);
        check_colours(edges, colours);
    }
}

TEST_CASE("a body with more contacts than there are colours keeps them all, one after another") {
    std::vector<Colouring::Edge> edges;
    for (std::uint32_t k = 1; k <= 400; ++k) edges.push_back({0, k, true, true});
    Colouring colouring;
    Colours colours;
    colouring.colour(edges, 401, colours);
    check_colours(edges, colours);
    CHECK(colours.count() == 400);
}

TEST_CASE("contacts with the ground alone all go side by side") {
    std::vector<Colouring::Edge> edges;
    for (std::uint32_t k = 1; k <= 100; ++k) edges.push_back({0, k, false, true});
    Colouring colouring;
    Colours colours;
    colouring.colour(edges, 101, colours);
    CHECK(colours.count() == 1);
    colouring.colour({}, 101, colours);
    CHECK(colours.count() == 0);
}

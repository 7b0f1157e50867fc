// Islands: what is linked lies in one, and after a split nothing else does.

#include "island/islands.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace {

using namespace cairn;

constexpr std::uint32_t none = Islands::none;

// A deterministic sequence, good enough to walk by.
std::uint32_t next(std::uint64_t& state) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return std::uint32_t(state >> 33u);
}

std::vector<std::uint32_t> list(const Islands& islands, std::uint32_t island) {
    std::vector<std::uint32_t> bodies;
    islands.visit_bodies(island, [&](std::uint32_t body) { bodies.push_back(body); });
    return bodies;
}

// All islands and what is in them, in their order: two that are equal behave alike.
std::vector<std::vector<std::uint32_t>> list_all(const Islands& islands) {
    std::vector<std::vector<std::uint32_t>> all;
    for (std::uint32_t i = 0; i < islands.island_end(); ++i) all.push_back(list(islands, i));
    return all;
}

// Bodies and links in sets, and connectivity found from the beginning each time.
struct Reference {
    std::set<std::uint32_t> bodies;
    std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> links;

    // The least body of what each body hangs together with.
    std::map<std::uint32_t, std::uint32_t> components() const {
        std::map<std::uint32_t, std::uint32_t> root;
        for (const std::uint32_t body : bodies) root[body] = body;
        for (bool changed = true; changed;) {
            changed = false;
            for (const auto& [link, ends] : links) {
                const std::uint32_t least = std::min(root[ends.first], root[ends.second]);
                changed = changed || root[ends.first] != least || root[ends.second] != least;
                root[ends.first] = root[ends.second] = least;
            }
        }
        return root;
    }
};

// One step of the walk, taken by both.
void walk(Islands& islands, Reference& reference, std::uint64_t& state, std::uint32_t bodies) {
    const std::uint32_t what = next(state) % 100;
    const std::uint32_t a = next(state) % bodies;
    const std::uint32_t b = next(state) % bodies;
    if (what < 12) {
        CHECK(islands.add_body(a) == reference.bodies.insert(a).second);
    } else if (what < 18) {
        CHECK(islands.remove_body(a) == (reference.bodies.erase(a) > 0));
        std::erase_if(reference.links, [&](const auto& link) {
            return link.second.first == a || link.second.second == a;
        });
    } else if (what < 62) {
        const std::uint32_t link = islands.add_link(a, b);
        const bool possible =
            a != b && reference.bodies.contains(a) && reference.bodies.contains(b);
        CHECK((link != none) == possible);
        if (link == none) return;
        CHECK(!reference.links.contains(link));
        reference.links[link] = {a, b};
    } else if (!reference.links.empty()) {
        auto link = reference.links.begin();
        std::advance(link, next(state) % reference.links.size());
        CHECK(islands.remove_link(link->first));
        reference.links.erase(link);
    }
}

void check_against(const Islands& islands, const Reference& reference) {
    CHECK(islands.is_sound());
    const auto root = reference.components();
    for (const auto& [link, ends] : reference.links) {
        CHECK(islands.has_link(link));
        CHECK(islands.island_of(ends.first) == islands.island_of(ends.second));
    }
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < islands.island_end(); ++i) {
        if (!islands.is_island(i)) continue;
        const auto bodies = list(islands, i);
        CHECK(bodies.size() == islands.body_count(i));
        count += bodies.size();
        // One that has not parted holds one component; what has may hold several, but whole ones.
        std::set<std::uint32_t> roots;
        for (const std::uint32_t body : bodies) roots.insert(root.at(body));
        if (!islands.may_have_parted(i)) CHECK(roots.size() == 1);
        if (bodies.size() == 1) CHECK(!islands.may_have_parted(i));
    }
    CHECK(count == reference.bodies.size());
    CHECK(count == islands.body_count());
    std::set<std::uint32_t> places;
    for (const std::uint32_t body : reference.bodies) {
        CHECK(islands.place_of(body) < islands.place_end());
        CHECK(places.insert(islands.place_of(body)).second);
    }
}

}  // namespace

TEST_CASE("over long walks what is linked lies together, and after a split nothing else does") {
    for (const std::uint32_t bodies : {3u, 12u, 60u, 300u}) {
        std::uint64_t state = bodies;
        Islands islands;
        Reference reference;
        std::vector<std::uint32_t> parts;
        for (int step = 0; step < 4000; ++step) {
            walk(islands, reference, state, bodies);
            if (step % 29 == 0) check_against(islands, reference);
            if (next(state) % 10 != 0 || reference.bodies.empty()) continue;
            const std::uint32_t body = *reference.bodies.begin();
            const std::uint32_t island = islands.island_of(body);
            const auto before = list(islands, island);
            islands.split(island, parts);
            CHECK(!islands.may_have_parted(island));
            std::vector<std::uint32_t> after;
            std::size_t largest = 0;
            for (const std::uint32_t part : parts) {
                const auto members = list(islands, part);
                after.insert(after.end(), members.begin(), members.end());
                largest = std::max(largest, members.size());
            }
            CHECK(std::is_permutation(before.begin(), before.end(), after.begin(), after.end()));
            CHECK(islands.body_count(island) == largest);
        }
        check_against(islands, reference);
    }
}

TEST_CASE("a copy taken in the middle of a walk goes on as the original does, number for number") {
    std::uint64_t state = 77;
    Islands original;
    Reference reference;
    for (int step = 0; step < 1500; ++step) walk(original, reference, state, 80);
    Islands copy = original;
    Reference other = reference;
    std::uint64_t other_state = state;
    std::vector<std::uint32_t> parts, other_parts;
    for (int step = 0; step < 1500; ++step) {
        walk(original, reference, state, 80);
        walk(copy, other, other_state, 80);
        if (step % 10 == 0 && !reference.bodies.empty()) {
            const std::uint32_t island = original.island_of(*reference.bodies.begin());
            original.split(island, parts);
            copy.split(island, other_parts);
            CHECK(parts == other_parts);
        }
        if (step % 50 == 0) CHECK(list_all(original) == list_all(copy));
    }
    CHECK(list_all(original) == list_all(copy));
}

TEST_CASE("what names nothing is refused and changes nothing") {
    Islands islands;
    CHECK(!islands.is_there(0));
    CHECK(!islands.add_body(none));
    CHECK(!islands.remove_body(5));
    CHECK(!islands.remove_link(0));
    CHECK(!islands.remove_link(none));
    CHECK(!islands.has_link(none));
    CHECK(islands.add_body(7));
    CHECK(!islands.add_body(7));
    CHECK(islands.add_link(7, 7) == none);
    CHECK(islands.add_link(7, 8) == none);
    CHECK(islands.add_link(none, 7) == none);
    CHECK(islands.add_body(8));
    const std::uint32_t link = islands.add_link(8, 7);
    CHECK(islands.remove_link(link));
    CHECK(!islands.remove_link(link));
    CHECK(islands.is_sound());
    CHECK(islands.body_count(islands.island_of(7)) == 1);
}

TEST_CASE("a link too many between the same two keeps them together without a look at the rest") {
    Islands islands;
    for (std::uint32_t body = 0; body < 4; ++body) islands.add_body(body);
    for (std::uint32_t body = 0; body < 3; ++body) islands.add_link(body, body + 1);
    const std::uint32_t second = islands.add_link(1, 2);
    CHECK(islands.remove_link(second));
    const std::uint32_t island = islands.island_of(0);
    CHECK(islands.body_count(island) == 4);
    CHECK(!islands.may_have_parted(island));
}

TEST_CASE("a body that has lost its last link is alone at once, and the pile is still one") {
    Islands islands;
    for (std::uint32_t body = 0; body < 101; ++body) islands.add_body(body);
    for (std::uint32_t body = 0; body < 99; ++body) islands.add_link(body, body + 1);
    const std::uint32_t touch = islands.add_link(40, 100);
    CHECK(islands.body_count(islands.island_of(0)) == 101);
    islands.remove_link(touch);
    CHECK(islands.body_count(islands.island_of(100)) == 1);
    CHECK(islands.body_count(islands.island_of(0)) == 100);
    CHECK(!islands.may_have_parted(islands.island_of(0)));
}

TEST_CASE("a chain cut in the middle parts in two when asked, and the longer part keeps its name") {
    Islands islands;
    std::vector<std::uint32_t> links;
    for (std::uint32_t body = 0; body < 100; ++body) islands.add_body(body);
    for (std::uint32_t body = 0; body < 99; ++body)
        links.push_back(islands.add_link(body, body + 1));
    const std::uint32_t whole = islands.island_of(0);
    islands.remove_link(links[29]);
    CHECK(islands.island_of(0) == islands.island_of(99));
    CHECK(islands.may_have_parted(whole));
    std::vector<std::uint32_t> parts;
    islands.split(whole, parts);
    REQUIRE(parts.size() == 2);
    CHECK(parts[0] == whole);
    CHECK(islands.island_of(99) == whole);
    CHECK(islands.body_count(whole) == 70);
    CHECK(islands.island_of(29) == parts[1]);
    CHECK(islands.body_count(parts[1]) == 30);
}

TEST_CASE(
    "a hundred thousand bodies in one island cost 44 bytes each with a link, and 4 if static") {
    Islands islands;
    // Every other body is static and never told.
    for (std::uint32_t body = 0; body < 200000; body += 2) islands.add_body(body);
    for (std::uint32_t body = 2; body < 200000; body += 2) islands.add_link(body - 2, body);
    CHECK(islands.body_count(islands.island_of(0)) == 100000);
    // Vectors that grow may have twice the room that they use.
    CHECK(islands.byte_count() < 2 * (100000 * (44 + 2 * 16 + 4)) + 2 * 200000 * 4);
}

TEST_CASE("an island that has come apart is still known to when a larger one takes it in") {
    Islands islands;
    std::vector<std::uint32_t> links;
    for (std::uint32_t body = 0; body < 12; ++body) islands.add_body(body);
    for (std::uint32_t body = 0; body < 11; ++body)
        links.push_back(body == 3 ? none : islands.add_link(body, body + 1));
    islands.remove_link(links[1]);
    islands.add_link(0, 11);
    const std::uint32_t island = islands.island_of(0);
    CHECK(islands.body_count(island) == 12);
    std::vector<std::uint32_t> parts;
    islands.split(island, parts);
    CHECK(parts.size() == 2);
    CHECK(islands.body_count(islands.island_of(2)) == 2);
}

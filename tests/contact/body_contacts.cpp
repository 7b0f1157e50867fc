// The contacts of a body: all of them, and no others, however they come and go.

#include "contact/body_contacts.h"

#include <doctest/doctest.h>

#include <map>
#include <set>

namespace {

using namespace cairn;

std::uint32_t next(std::uint64_t& state) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return std::uint32_t(state >> 33u);
}

std::multiset<std::uint32_t> list(const BodyContacts& contacts, std::uint32_t body) {
    std::multiset<std::uint32_t> slots;
    contacts.visit(body, [&](std::uint32_t slot) { slots.insert(slot); });
    return slots;
}

}  // namespace

TEST_CASE("over a long walk a body is told exactly the contacts that it has") {
    constexpr std::uint32_t bodies = 20, slots = 150;
    std::uint64_t state = 3;
    BodyContacts contacts;
    std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> attached;
    for (int step = 0; step < 5000; ++step) {
        const std::uint32_t slot = next(state) % slots;
        if (attached.erase(slot) > 0) {
            contacts.detach(slot);
        } else {
            const std::uint32_t a = next(state) % bodies;
            const std::uint32_t b = (a + 1 + next(state) % (bodies - 1)) % bodies;
            contacts.attach(slot, a, b);
            attached[slot] = {a, b};
        }
        const std::uint32_t body = next(state) % bodies;
        std::multiset<std::uint32_t> expected;
        for (const auto& [one, ends] : attached) {
            if (ends.first == body || ends.second == body) expected.insert(one);
        }
        CHECK(list(contacts, body) == expected);
    }
}

TEST_CASE("a body's contacts can all be detached while they are visited") {
    BodyContacts contacts;
    for (std::uint32_t slot = 0; slot < 10; ++slot) contacts.attach(slot, 0, slot + 1);
    contacts.visit(0, [&](std::uint32_t slot) { contacts.detach(slot); });
    for (std::uint32_t body = 0; body < 12; ++body) CHECK(list(contacts, body).empty());
}

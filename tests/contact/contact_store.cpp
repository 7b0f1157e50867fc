// The life of contacts: found again, carried over by feature, ended with their keys.

#include "contact/contact_store.h"

#include <doctest/doctest.h>

using namespace cairn;

namespace {

using Keys = std::vector<std::uint64_t>;

// Lists the pairs, each with a contact; the keys of the contacts that end.
Keys renew(ContactStore& store, std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs) {
    Keys ended;
    store.begin_renewal();
    for (const auto& [a, b] : pairs) store.renew(a, b);
    store.end_renewal([&](const Contact& contact) { ended.push_back(contact.key); });
    for (PairRecord& pair : store.pairs()) {
        if (pair.contact == ContactStore::none) store.add_contact(pair);
    }
    return ended;
}

ContactPoint point(std::uint32_t feature, float force = 0) {
    ContactPoint p;
    p.feature = feature;
    p.normal_force = force;
    return p;
}

}  // namespace

TEST_CASE("a pair that ends leaves with its contact, and its slot begins anew") {
    ContactStore store;
    renew(store, {{0, 1}, {0, 2}, {1, 2}});
    const std::uint32_t slot = store.find(0, 2);
    store[slot].points[0].normal_force = 5;
    store[slot].point_count = 1;
    CHECK(renew(store, {{0, 1}, {1, 2}}) == Keys{pair_key(0, 2)});
    CHECK(store.find(0, 2) == ContactStore::none);
    CHECK(store.find_pair(0, 2) == nullptr);
    CHECK(store.contact_count() == 2);
    // The freed slot goes to the next new contact and remembers nothing.
    renew(store, {{0, 1}, {1, 2}, {3, 4}});
    CHECK(store.find(3, 4) == slot);
    CHECK(store[slot].point_count == 0);
}

TEST_CASE("a pair without a contact ends in silence, and keeps what is known of it until then") {
    ContactStore store;
    store.begin_renewal();
    store.renew(1, 2);
    store.end_renewal([](const Contact&) { FAIL("there is no contact"); });
    store.pairs()[0].apart_until = 7;
    store.begin_renewal();
    store.renew(0, 9);
    store.renew(1, 2);
    store.end_renewal([](const Contact&) { FAIL("there is no contact"); });
    REQUIRE(store.find_pair(1, 2) != nullptr);
    CHECK(store.find_pair(1, 2)->apart_until == 7);
    CHECK(renew(store, {}).empty());
    CHECK(store.pairs().empty());
}

TEST_CASE("a contact that stays keeps its slot") {
    ContactStore store;
    renew(store, {{0, 1}, {5, 9}});
    const std::uint32_t slot = store.find(5, 9);
    for (int i = 0; i < 10; ++i) renew(store, {{0, 1}, {0, 3}, {5, 9}});
    CHECK(store.find(5, 9) == slot);
}

TEST_CASE("an impulse follows its feature, wherever the point stands in the list") {
    Contact contact;
    const std::array first = {point(10, 1), point(20, 2), point(30, 3)};
    contact.point_count = 3;
    for (std::size_t i = 0; i < 3; ++i) contact.points[i] = first[i];
    match_points(contact, std::array{point(30), point(40), point(10)});
    CHECK(contact.point_count == 3);
    CHECK(contact.points[0].normal_force == 3);
    CHECK(contact.points[1].normal_force == 0);
    CHECK(contact.points[2].normal_force == 1);
}

// The life of contacts: found again, carried over by feature, ended with their keys.

#include "contact/contact_store.h"

#include <doctest/doctest.h>

using namespace cairn;

namespace {

using Keys = std::vector<std::uint64_t>;

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

// Lists the pairs, each with a contact; the keys of the contacts that end. A shape is its own body,
// and those from `idle` on rest.
Keys renew(ContactStore& store, const Pairs& pairs, std::uint32_t idle = 1000) {
    Keys ended;
    store.begin_renewal(pairs.size());
    for (const auto& [a, b] : pairs) store.renew(a, b);
    store.end_renewal([&](const Contact& c) { return c.body_a >= idle && c.body_b >= idle; },
                      [&](std::uint32_t slot) { ended.push_back(store[slot].key); });
    for (PairRecord& pair : store.pairs()) {
        if (pair.contact == ContactStore::none) store.add_contact(pair, pair.shape_a, pair.shape_b);
    }
    return ended;
}

Pairs list(const ContactStore& store) {
    Pairs pairs;
    for (const PairRecord& pair : store.pairs()) pairs.push_back({pair.shape_a, pair.shape_b});
    return pairs;
}

// The slot of the pair's contact.
std::uint32_t find(const ContactStore& store, std::uint32_t shape_a, std::uint32_t shape_b) {
    const PairRecord* const pair = store.find_pair(shape_a, shape_b);
    return pair != nullptr ? pair->contact : ContactStore::none;
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
    const std::uint32_t slot = find(store, 0, 2);
    store[slot].points[0].normal_force = 5;
    store[slot].point_count = 1;
    CHECK(renew(store, {{0, 1}, {1, 2}}) == Keys{pair_key(0, 2)});
    CHECK(find(store, 0, 2) == ContactStore::none);
    CHECK(store.find_pair(0, 2) == nullptr);
    CHECK(store.contact_count() == 2);
    // The freed slot goes to the next new contact and remembers nothing.
    renew(store, {{0, 1}, {1, 2}, {3, 4}});
    CHECK(find(store, 3, 4) == slot);
    CHECK(store[slot].point_count == 0);
}

TEST_CASE("a pair without a contact ends in silence, and keeps what is known of it until then") {
    ContactStore store;
    const auto never = [](const Contact&) { return false; };
    const auto fail = [](std::uint32_t) { FAIL("there is no contact"); };
    store.begin_renewal(1);
    store.renew(1, 2);
    store.end_renewal(never, fail);
    store.pairs()[0].apart_until = 7;
    store.begin_renewal(2);
    store.renew(0, 9);
    store.renew(1, 2);
    store.end_renewal(never, fail);
    REQUIRE(store.find_pair(1, 2) != nullptr);
    CHECK(store.find_pair(1, 2)->apart_until == 7);
    CHECK(renew(store, {}).empty());
    CHECK(store.pairs().empty());
}

TEST_CASE("a contact that stays keeps its slot") {
    ContactStore store;
    renew(store, {{0, 1}, {5, 9}});
    const std::uint32_t slot = find(store, 5, 9);
    for (int i = 0; i < 10; ++i) renew(store, {{0, 1}, {0, 3}, {5, 9}});
    CHECK(find(store, 5, 9) == slot);
}

TEST_CASE("a contact whose bodies rest is put aside as it is, and comes back in its place") {
    ContactStore store;
    renew(store, {{0, 1}, {5, 9}, {6, 7}});
    const std::uint32_t slot = find(store, 5, 9);
    store[slot].points[0].normal_force = 5;
    store.pairs()[1].hint.kind = 3;
    CHECK(renew(store, {{0, 1}}, 5).empty());
    CHECK(list(store) == Pairs{{0, 1}});
    CHECK(store.contact_count() == 3);
    for (int i = 0; i < 3; ++i) CHECK(renew(store, {{0, 1}, {0, 2}}, 5).empty());
    REQUIRE(store.find_pair(5, 9) != nullptr);
    CHECK(store.find_pair(5, 9)->contact == slot);
    CHECK(store.has_contacts(9));

    // At once, or with the next renewal, in whatever order they were asked for.
    store.take_back(find(store, 6, 7));
    store.take_back(slot);
    store.take_back(slot);
    ContactStore copy = store;
    store.list_returned();
    CHECK(list(store) == Pairs{{0, 1}, {0, 2}, {5, 9}, {6, 7}});
    CHECK(renew(copy, {{0, 1}, {5, 9}, {6, 7}}) == Keys{pair_key(0, 2)});
    CHECK(list(copy) == Pairs{{0, 1}, {5, 9}, {6, 7}});
    CHECK(find(copy, 5, 9) == slot);
    CHECK(copy[slot].points[0].normal_force == 5);
    CHECK(copy.find_pair(5, 9)->hint.kind == 3);
    // Taken back and not renewed, it ends like any other.
    CHECK(renew(store, {{0, 1}}) == Keys{pair_key(0, 2), pair_key(5, 9), pair_key(6, 7)});
    CHECK(!store.has_contacts(9));
}

TEST_CASE("what was taken back can be removed before it is listed") {
    ContactStore store;
    renew(store, {{0, 1}, {5, 9}});
    renew(store, {{0, 1}}, 5);
    store.take_back(find(store, 5, 9));
    int removed = 0;
    store.remove_if([](const PairRecord& pair) { return pair.shape_b == 9; },
                    [&](std::uint32_t) { ++removed; });
    CHECK(removed == 1);
    CHECK(find(store, 5, 9) == ContactStore::none);
    CHECK(list(store) == Pairs{{0, 1}});
}

TEST_CASE("an impulse follows its feature, wherever the point stands in the list") {
    Contact contact;
    const std::array first = {point(10, 1), point(20, 2), point(30, 3)};
    contact.point_count = 3;
    for (std::size_t i = 0; i < 3; ++i) contact.points[i] = first[i];
    const PointForces before = forces_of(contact);
    const std::array then = {point(30), point(40), point(10)};
    for (std::size_t i = 0; i < 3; ++i) contact.points[i] = then[i];
    match_points(before, contact);
    CHECK(contact.point_count == 3);
    CHECK(contact.points[0].normal_force == 3);
    CHECK(contact.points[1].normal_force == 0);
    CHECK(contact.points[2].normal_force == 1);
}

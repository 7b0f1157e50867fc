// The pair table against an ordered map, over a long walk of insertions and removals.

#include "base/pair_table.h"

#include <doctest/doctest.h>

#include <map>

using cairn::PairTable;

TEST_CASE("a pair is found if and only if it was put in and not taken out") {
    PairTable table;
    std::map<std::uint64_t, std::uint32_t> expected;
    std::uint64_t random = 1;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        // Few distinct keys, in both halves: the walk meets each many times, and probes collide.
        const std::uint64_t key = ((random >> 40) % 40) << 32 | (random >> 50) % 40;
        const auto known = expected.find(key);
        REQUIRE(table.find(key) == (known == expected.end() ? PairTable::none : known->second));
        if (known == expected.end()) {
            table.insert(key, i);
            expected[key] = i;
        } else {
            table.remove(key);
            expected.erase(known);
        }
        REQUIRE(table.size() == expected.size());
    }
    for (const auto& [key, slot] : expected) CHECK(table.find(key) == slot);
}

TEST_CASE("an empty table holds nothing") { CHECK(PairTable().find(0) == PairTable::none); }

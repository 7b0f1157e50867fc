// Values kept once, against a map that counts their holders, over a long walk of takings and
// givings back.

#include "base/shared_values.h"

#include <doctest/doctest.h>

#include <map>
#include <vector>

using cairn::SharedValues;

namespace {

struct Value {
    float a = 0, b = 0;
};

}  // namespace

TEST_CASE("equal values share a number until the last holder gives it back") {
    SharedValues<Value> shared;
    std::map<int, std::vector<std::uint32_t>> held;  // the numbers given out, by value
    std::uint64_t random = 1;
    for (int i = 0; i < 20000; ++i) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        const int value = int((random >> 40) % 300);
        std::vector<std::uint32_t>& numbers = held[value];
        if ((random >> 60) % 2 == 0) {
            const std::uint32_t number = shared.take({float(value), 1});
            REQUIRE(shared[number].a == float(value));
            if (!numbers.empty()) REQUIRE(number == numbers.front());
            numbers.push_back(number);
        } else if (!numbers.empty()) {
            shared.give_back(numbers.back());
            numbers.pop_back();
        }
    }
    std::size_t distinct = 0;
    for (const auto& [value, numbers] : held) {
        for (const std::uint32_t number : numbers) CHECK(shared[number].a == float(value));
        distinct += numbers.empty() ? 0 : 1;
    }
    CHECK(distinct > 100);
    CHECK(shared.size() == distinct);
}

TEST_CASE("zeros of different sign are different values") {
    SharedValues<Value> shared;
    CHECK(shared.take({0.0f, 0}) != shared.take({-0.0f, 0}));
}

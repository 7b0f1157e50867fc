#pragma once
// What every broad phase is given and what it answers: boxes with their owners' ids, and pairs.

#include <cstdint>

#include "math/aabb.h"

namespace cairn {

// A box and whose it is. Two proxies that both stand still make no pair.
struct Proxy {
    Aabb box;
    std::uint32_t id = 0;
    bool moves = false;
};

struct Pair {
    std::uint32_t a = 0;  // the smaller id
    std::uint32_t b = 0;
    friend constexpr auto operator<=>(const Pair&, const Pair&) = default;
};

}  // namespace cairn

#pragma once
// Typed ids with a generation: an id whose object is gone is an error, never another object.

#include <compare>
#include <cstdint>

namespace cairn {

/// Names one object of a world. `Kind` only keeps the types apart. A default-made id names nothing.
template <class Kind>
struct Id {
    std::uint32_t index = 0xffffffffu;
    std::uint32_t generation = 0;

    /// False for the id that names nothing; a stale id still answers true (ask `World::is_valid`).
    constexpr explicit operator bool() const { return index != 0xffffffffu; }
    friend constexpr auto operator<=>(const Id&, const Id&) = default;
};

using BodyId = Id<struct BodyTag>;
using ShapeId = Id<struct ShapeTag>;

}  // namespace cairn

#pragma once
// The bodies that a solver has to do with, close together: where most of a world rests, nothing
// that a solver does once a body may be done for all of them.
//
// Reads the moving bodies and the contacts with points. While a problem is dense, those contacts
// name bodies by their place in it; the places keep the order of the slots, so that a solver does
// the same to the bit either way.

#include <cstdint>

#include "base/large_array.h"
#include "body/body.h"

namespace cairn {

struct WorldState;

class DenseBodies {
public:
    // Whether it is worth it: most bodies are neither moving nor touched.
    static bool pays(const WorldState& world);

    void gather(WorldState& world);
    // Hands back what moved, and gives the contacts their bodies' slots.
    void scatter(WorldState& world) const;

    LargeArray<BodyMotion> motions;
    LargeArray<BodyInertia> inertias;
    LargeArray<BodyDrive> drives;
    LargeArray<float> heights;
    LargeArray<std::uint32_t> moving;  // places

private:
    bool is_listed(std::uint32_t body) const {
        return places_[body] < slots_.size() && slots_[places_[body]] == body;
    }
    void list(std::uint32_t body);

    LargeArray<std::uint32_t> slots_;   // by place
    LargeArray<std::uint32_t> places_;  // by slot; means something where slots_ agrees
};

}  // namespace cairn

#pragma once
// The bodies of one group of a step, close together: a problem of its own that a solver can work on
// while others work on theirs.
//
// Bodies are copied, the group's own first and in the order of their slots. What cannot be pushed
// is copied into every group that touches it; kinematic bodies go their way in each, as guests.
// While a problem is dense, its contacts name bodies by their place in it.

#include <cstdint>

#include "base/large_array.h"
#include "body/body.h"
#include "constraint/step_problem.h"

namespace cairn {

struct StepGroup;
struct WorldState;

class DenseBodies {
public:
    // Takes the group out of the world and makes `problem` be about it.
    void gather(WorldState& world, const StepGroup& group, StepProblem& problem);
    // Hands back what moved, and gives the contacts their bodies' slots.
    void scatter(WorldState& world, const StepGroup& group, const StepProblem& problem) const;

private:
    bool is_listed(std::uint32_t body) const {
        return places_[body] < slots_.size() && slots_[places_[body]] == body;
    }
    void resize(std::size_t count);
    void copy(const WorldState& world, std::uint32_t body, std::size_t place);
    std::uint32_t place_guest(const WorldState& world, std::uint32_t body);

    LargeArray<std::uint32_t> slots_;   // by place
    LargeArray<std::uint32_t> places_;  // by slot; means something where slots_ agrees
    LargeArray<BodyMotion> motions_;
    LargeArray<BodyInertia> inertias_;
    LargeArray<BodyDrive> drives_;
    Vec3 up_;  // against gravity
    LargeArray<float> heights_;
    LargeArray<std::uint32_t> moving_;  // places
    // By place in the group's contacts: whether a body of it is none of the group's own.
    LargeArray<std::uint8_t> has_guest_;
};

}  // namespace cairn

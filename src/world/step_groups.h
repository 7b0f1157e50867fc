#pragma once
// Cuts a step into groups of islands that have nothing to do with each other, so that a solver's
// passes over a group stay in a near cache, and threads take groups instead of meeting at every
// pass.
//
// An island is what contacts hold together, whatever cannot be pushed left out. A large island is a
// group of its own; small ones are grouped with others of their kind, so that a method may treat a
// group alike: those whose smallest shapes are of a size, and those in which a contact has yet
// to close. What touches nothing forms groups too. Kinematic bodies are read by all and form the
// last group.
//
// Groups follow from the bodies and contacts alone, never from who works on them.

#include <cstdint>
#include <span>
#include <vector>

#include "base/large_array.h"

namespace cairn {

class Team;
struct WorldState;

struct StepGroup {
    // As in StepProblem, of the world's slots: bodies that are the group's own, and contacts.
    std::span<const std::uint32_t> moving, active;
    bool is_one_island = false;  // certainly; a small one may be without being said so
};

class StepGroups {
public:
    // Reads the step's moving bodies and contacts with points.
    void form(const WorldState& world, Team& team);

    // Groups of bodies that can be pushed.
    std::size_t count() const { return group_count_; }
    StepGroup operator[](std::size_t group) const;
    StepGroup kinematic_group() const { return (*this)[count()]; }

private:
    static constexpr std::uint32_t none = 0xffffffffu;

    struct Island {
        std::uint32_t bodies = 0, contacts = 0;
        float smallest = 0;   // size of a contact
        bool is_new = false;  // some contact has yet to close
        std::uint32_t group = none;
    };
    // Where a group begins in the lists.
    struct Range {
        std::uint32_t moving = 0, active = 0;
    };
    // What islands of one kind have in common, and the group that still takes them.
    struct OpenGroup {
        std::uint32_t kind = 0;
        std::uint32_t group = 0;
        std::uint32_t bodies = 0, contacts = 0;
    };

    // What groups follow from of a contact; `none` for a body that cannot be pushed.
    struct Edge {
        std::uint32_t mobile_a = none, mobile_b = none;
        float size = 0;
        bool touching = false;
    };

    void read_contacts(const WorldState& world, Team& team);
    std::uint32_t find_root(std::uint32_t mobile);
    void join_bodies(const WorldState& world);
    void measure_islands(const WorldState& world);
    void give_groups();
    void fill_lists(const WorldState& world);
    std::uint32_t island_of(const Edge& edge) const;

    LargeArray<Edge> edges_;              // by place in the list of contacts
    std::vector<std::uint32_t> parents_;  // by mobile, of those that move
    std::vector<std::uint32_t> island_;   // likewise; none for kinematic ones
    std::vector<Island> islands_;
    std::vector<OpenGroup> open_;
    std::vector<Range> groups_, next_;  // and one more: where the lists end
    std::uint32_t group_count_ = 0;
    LargeArray<std::uint32_t> moving_, active_;
};

}  // namespace cairn

#pragma once
// What moves together: bodies that can be pushed, joined by links (contacts, later joints), in
// islands that last from step to step. An island is what falls asleep and wakes as one.
//
// Linking two islands makes them one at once: the smaller is written over as part of the larger.
// Unlinking only notes that the island may have come apart, and a body that has lost its last
// link leaves alone; split() looks the rest over when somebody wants to know. Between two splits
// an island may thus be larger than what hangs together, never smaller.
//
// Bodies that nothing pushes join nothing and are never told to this class: a pile on the ground
// is not linked with the next one. All numbers and orders follow from the sequence of calls alone.
// A value: a copy is complete.
//
// Cost: add_link amortised O(log n) a body; remove_link O(1); split O(bodies and links of the
// island). 20 bytes a body, 24 a link, 16 an island, 4 a slot below the highest body.

#include <cstdint>
#include <span>

#include "base/large_array.h"

namespace cairn {

class Islands {
public:
    static constexpr std::uint32_t none = 0xffffffffu;

    // An island of its own. False, and nothing done, where the body is there already.
    bool add_body(std::uint32_t body);
    // Its links go with it. False where it is not there.
    bool remove_body(std::uint32_t body);
    bool is_there(std::uint32_t body) const {
        return body < places_.size() && places_[body] != none;
    }

    // Room for so many links in all.
    void reserve_links(std::size_t count) { make_room(links_, count); }
    // The link's number, for remove_link(). `none`, and nothing done, where one of the two is not
    // there or both are the same. Two bodies may be linked more than once.
    std::uint32_t add_link(std::uint32_t body_a, std::uint32_t body_b);
    // False where there is no such link.
    bool remove_link(std::uint32_t link);
    bool has_link(std::uint32_t link) const {
        return link < links_.size() && links_[link].ends[0].node != none;
    }

    std::size_t body_count() const { return nodes_.size() - free_nodes_.size(); }
    // A small number that is the body's own while it is there, below place_end(); the body must be
    // there, here and below.
    std::uint32_t place_of(std::uint32_t body) const { return places_[body]; }
    std::uint32_t place_end() const { return std::uint32_t(nodes_.size()); }
    std::uint32_t island_of(std::uint32_t body) const { return nodes_[places_[body]].island; }
    // Below island_end(); not every number there is an island.
    bool is_island(std::uint32_t island) const {
        return island < islands_.size() && islands_[island].count > 0;
    }
    std::uint32_t island_end() const { return std::uint32_t(islands_.size()); }
    std::uint32_t body_count(std::uint32_t island) const { return islands_[island].count; }
    // visit(body) for each body of the island, in the order in which they came to it.
    template <class Visit>
    void visit_bodies(std::uint32_t island, Visit&& visit) const {
        for (std::uint32_t n = islands_[island].first; n != none; n = nodes_[n].next)
            visit(nodes_[n].body);
    }

    // Whether it has lost a link that may have held it together.
    bool may_have_parted(std::uint32_t island) const { return islands_[island].parted; }
    // Divides the island into what hangs together and replaces `parts` by those islands: the
    // largest keeps the number, the others follow in the order of their first bodies.
    void split(std::uint32_t island, std::vector<std::uint32_t>& parts);

    // For tests and figures.
    std::size_t byte_count() const;
    bool is_sound() const;

private:
    // A place in the list of a node's links: the link, and which of its two ends.
    using End = std::uint32_t;
    static std::uint32_t link_of(End end) { return end >> 1u; }
    static std::uint32_t side_of(End end) { return end & 1u; }

    struct Node {
        std::uint32_t body = none;
        std::uint32_t island = none;
        std::uint32_t next = none, previous = none;  // in the island
        End first = none;
    };
    struct LinkEnd {
        std::uint32_t node = none;
        End next = none, previous = none;
    };
    struct Link {
        LinkEnd ends[2];
    };
    struct Island {
        std::uint32_t first = none, last = none;
        std::uint32_t count = 0;
        bool parted = false;
    };

    LinkEnd& at(End end) { return links_[link_of(end)].ends[side_of(end)]; }
    const LinkEnd& at(End end) const { return links_[link_of(end)].ends[side_of(end)]; }
    std::uint32_t make_island();
    void append(std::uint32_t island, std::uint32_t node);
    void take_out(std::uint32_t node);
    void merge(std::uint32_t into, std::uint32_t from);
    void attach(std::uint32_t link, std::uint32_t side, std::uint32_t node);
    void detach(std::uint32_t link, std::uint32_t side);
    void leave_alone(std::uint32_t node);
    bool are_linked(std::uint32_t node_a, std::uint32_t node_b) const;
    void find_part(std::uint32_t from, std::uint32_t part);

    LargeArray<std::uint32_t> places_;  // node by body
    LargeArray<Node> nodes_;
    LargeArray<Link> links_;
    LargeArray<Island> islands_;
    LargeArray<std::uint32_t> free_nodes_, free_links_, free_islands_;

    // Room that split() uses again, of no meaning between its calls.
    LargeArray<std::uint32_t> members_, labels_, queue_, sizes_;
};

}  // namespace cairn

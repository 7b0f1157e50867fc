#pragma once
// Which contacts a body has: what must be told when it is changed, moved or destroyed, without a
// look at all the others.
//
// A list a body, woven through the contacts' slots: attach and detach in constant time, also for
// the ground that bears ten thousand. A list's order follows from the sequence of calls.

#include <array>
#include <cstdint>

#include "base/large_array.h"

namespace cairn {

class BodyContacts {
public:
    static constexpr std::uint32_t none = 0xffffffffu;

    // Room for so many slots.
    void reserve(std::size_t slots) { links_.reserve(slots); }

    // The slot must not be attached, the bodies must differ.
    void attach(std::uint32_t slot, std::uint32_t body_a, std::uint32_t body_b) {
        if (slot >= links_.size()) links_.resize(std::size_t{slot} + 1);
        for (const std::uint32_t side : {0u, 1u}) {
            const std::uint32_t body = side == 0 ? body_a : body_b;
            if (body >= firsts_.size()) firsts_.resize(std::size_t{body} + 1, none);
            const std::uint32_t end = 2 * slot + side;
            at(end) = {.body = body, .next = firsts_[body]};
            if (firsts_[body] != none) at(firsts_[body]).previous = end;
            firsts_[body] = end;
        }
    }

    // The slot must be attached.
    void detach(std::uint32_t slot) {
        for (End& end : links_[slot]) {
            (end.previous == none ? firsts_[end.body] : at(end.previous).next) = end.next;
            if (end.next != none) at(end.next).previous = end.previous;
            end = {};
        }
    }

    // visit(slot) for each contact of the body; it may detach the one that it is given.
    template <class Visit>
    void visit(std::uint32_t body, Visit&& visit_slot) const {
        if (body >= firsts_.size()) return;
        for (std::uint32_t end = firsts_[body]; end != none;) {
            const std::uint32_t next = links_[end / 2][end % 2].next;
            visit_slot(end / 2);
            end = next;
        }
    }

    bool has_any(std::uint32_t body) const {
        return body < firsts_.size() && firsts_[body] != none;
    }

private:
    struct End {
        std::uint32_t body = none;
        std::uint32_t next = none, previous = none;  // twice the slot, and one for its second end
    };
    End& at(std::uint32_t end) { return links_[end / 2][end % 2]; }

    LargeArray<std::array<End, 2>> links_;  // by slot
    LargeArray<std::uint32_t> firsts_;      // by body
};

}  // namespace cairn

#pragma once
// The pairs of shapes that may touch, in ascending order of their keys, and the contacts of those
// that do: found by pair in constant time, in slots that do not move. A pair that ends leaves with
// its contact. Most pairs have none, so what is kept of a pair is small.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/pair_table.h"
#include "contact/contact.h"
#include "contact/manifold.h"
#include "contact/reuse.h"
#include "narrow/axis.h"

namespace cairn {

constexpr std::uint64_t pair_key(std::uint32_t shape_a, std::uint32_t shape_b) {
    return (std::uint64_t{shape_a} << 32) | shape_b;
}

struct PairRecord {
    std::uint32_t shape_a = 0, shape_b = 0;
    std::uint32_t contact = PairTable::none;  // its slot
    AxisHint hint;
    bool meets = false;  // has contact points in this step
    // The shapes have stayed apart while the ways that the two bodies have gone together are less
    // than this (world/detect.h).
    double apart_until = -1;
};

class ContactStore {
public:
    static constexpr std::uint32_t none = PairTable::none;

    // A renewal lists all pairs of the step, in ascending order of key; those not listed end.
    void begin_renewal();
    void renew(std::uint32_t shape_a, std::uint32_t shape_b);
    // Ends what was not renewed, calling on_end(contact) for each that has a contact, in ascending
    // order of key.
    template <class OnEnd>
    void end_renewal(OnEnd&& on_end);

    // Ends pairs outside a renewal: those of a body that is gone, say.
    template <class Unwanted>
    void remove_if(Unwanted&& unwanted);

    // Ascending.
    std::span<PairRecord> pairs() { return pairs_; }
    std::span<const PairRecord> pairs() const { return pairs_; }
    const PairRecord* find_pair(std::uint32_t shape_a, std::uint32_t shape_b) const;

    // Gives the pair a contact, as new.
    Contact& add_contact(PairRecord& pair);
    void remove_contact(PairRecord& pair);
    std::uint32_t find(std::uint32_t shape_a, std::uint32_t shape_b) const {
        return table_.find(pair_key(shape_a, shape_b));
    }
    std::span<Contact> slots() { return slots_; }
    Contact& operator[](std::uint32_t slot) { return slots_[slot]; }
    const Contact& operator[](std::uint32_t slot) const { return slots_[slot]; }
    FaceSighting& sighting(std::uint32_t slot) { return sightings_[slot]; }
    std::size_t contact_count() const { return table_.size(); }

private:
    std::vector<PairRecord> pairs_, previous_;
    std::size_t place_ = 0;          // in previous_: what comes before has been renewed or ended
    std::vector<PairRecord> ended_;  // with contacts
    std::vector<Contact> slots_;
    std::vector<FaceSighting> sightings_;  // likewise
    std::vector<std::uint32_t> free_;
    PairTable table_;
};

// Carries the impulses of `contact`'s points over to the new points where the feature is the same;
// then the new points take the old ones' place.
void match_points(Contact& contact, std::span<const ContactPoint> renewed);

template <class Unwanted>
void ContactStore::remove_if(Unwanted&& unwanted) {
    std::erase_if(pairs_, [&](PairRecord& pair) {
        if (!unwanted(std::as_const(pair))) return false;
        if (pair.contact != none) remove_contact(pair);
        return true;
    });
}

template <class OnEnd>
void ContactStore::end_renewal(OnEnd&& on_end) {
    for (; place_ < previous_.size(); ++place_) {
        if (previous_[place_].contact != none) ended_.push_back(previous_[place_]);
    }
    for (PairRecord& pair : ended_) {
        on_end(slots_[pair.contact]);
        remove_contact(pair);
    }
}

}  // namespace cairn

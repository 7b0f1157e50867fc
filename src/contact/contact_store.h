#pragma once
// The pairs of shapes that may touch, in ascending order of their keys, and the contacts of those
// that do, in slots that do not move: a step's pairs find theirs in one walk through both lists. A
// pair that ends leaves with its contact. Most pairs have none, so what is kept of a pair is small.
//
// A contact that nobody looks at for the time being (both bodies rest) is put aside with its pair,
// as it is, and costs nothing until it is taken back.

#include <cstdint>
#include <span>
#include <utility>

#include "base/large_array.h"
#include "base/pair_table.h"
#include "contact/body_contacts.h"
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
    bool meets = false;       // has contact points in this step
    bool is_found = false;    // and they are found anew
    bool has_news = false;    // its contact began, ended or has no points
    bool shows_face = false;  // its contact's sighting is of a face that can be followed
    // The shapes have stayed apart while the ways that the two bodies have gone together are less
    // than this (world/detect.h).
    double apart_until = -1;
};

class ContactStore {
public:
    static constexpr std::uint32_t none = PairTable::none;

    // Whether a renewal by these pairs, ascending, would leave all as it is.
    template <class Pairs>
    bool lists(const Pairs& pairs) const;
    // A renewal lists all pairs of the step, so many, in ascending order of key; those not listed
    // end, or are put aside.
    void begin_renewal(std::size_t pair_count);
    void renew(std::uint32_t shape_a, std::uint32_t shape_b);
    // Ends what was not renewed, calling on_end(slot) for each that has a contact, in ascending
    // order of key. Those whose contact is_idle(contact) are put aside.
    template <class IsIdle, class OnEnd>
    void end_renewal(IsIdle&& is_idle, OnEnd&& on_end);

    // Has a contact that was put aside listed again, from the next renewal on, or from
    // list_returned() on.
    void take_back(std::uint32_t slot);
    void list_returned();

    // Ends listed pairs outside a renewal: those of a body that is gone, say. Calls on_end(slot) as
    // above.
    template <class Unwanted, class OnEnd>
    void remove_if(Unwanted&& unwanted, OnEnd&& on_end);

    // Ascending, without what was put aside.
    std::span<PairRecord> pairs() { return pairs_; }
    std::span<const PairRecord> pairs() const { return pairs_; }
    // Put aside or not.
    const PairRecord* find_pair(std::uint32_t shape_a, std::uint32_t shape_b) const;

    // Gives the pair a contact, as new, of these two bodies. Many at once want room for so many
    // more first: what grows by and by is copied again and again.
    Contact& add_contact(PairRecord& pair, std::uint32_t body_a, std::uint32_t body_b);
    void make_room(std::size_t more);
    void remove_contact(PairRecord& pair);
    std::span<Contact> slots() { return slots_; }
    std::span<const Contact> slots() const { return slots_; }
    Contact& operator[](std::uint32_t slot) { return slots_[slot]; }
    const Contact& operator[](std::uint32_t slot) const { return slots_[slot]; }
    FaceSighting& sighting(std::uint32_t slot) { return sightings_[slot]; }
    // The contact and what is needed to follow its face; any slot will do.
    [[gnu::always_inline]] void prefetch(std::uint32_t slot, std::size_t points) const {
        if (slot < slots_.size()) prefetch_contact(slots_[slot], points);
    }
    [[gnu::always_inline]] void prefetch_sighting(std::uint32_t slot) const {
        const auto* bytes = reinterpret_cast<const char*>(&sightings_[slot]);
        for (std::size_t i = 0; i < sizeof(FaceSighting); i += 64) __builtin_prefetch(bytes + i);
    }
    std::size_t contact_count() const { return slots_.size() - free_.size(); }

    // visit(slot) for each contact of the body, put aside or not.
    template <class Visit>
    void visit_contacts(std::uint32_t body, Visit&& visit) const {
        by_body_.visit(body, visit);
    }
    bool has_contacts(std::uint32_t body) const { return by_body_.has_any(body); }

private:
    enum class Listing : std::uint8_t { Listed, Aside, Returning };
    void put_aside(const PairRecord& pair);

    LargeArray<PairRecord> pairs_, previous_;
    std::size_t place_ = 0;         // in previous_: what comes before has been renewed or ended
    LargeArray<PairRecord> ended_;  // with contacts
    LargeArray<Contact> slots_;
    LargeArray<FaceSighting> sightings_;  // likewise, and the next two
    LargeArray<Listing> listings_;
    LargeArray<PairRecord> asides_;        // of contacts that are not listed
    PairTable asides_by_key_;              // their slots
    LargeArray<std::uint32_t> returning_;  // slots
    BodyContacts by_body_;
    LargeArray<std::uint32_t> free_;
};

// What a contact's points bore, by feature.
struct PointForces {
    int count;
    std::uint32_t feature[4];
    float normal[4];
    Vec3 friction[4];
};
PointForces forces_of(const Contact& contact);
// Carries the forces over to the points that took the place of those, where the feature is the
// same; nothing has passed through them yet in this step.
void match_points(const PointForces& before, Contact& contact);

template <class Pairs>
bool ContactStore::lists(const Pairs& pairs) const {
    if (!returning_.empty() || pairs.size() != pairs_.size()) return false;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        if (pairs[i].a != pairs_[i].shape_a || pairs[i].b != pairs_[i].shape_b) return false;
    }
    return true;
}

template <class Unwanted, class OnEnd>
void ContactStore::remove_if(Unwanted&& unwanted, OnEnd&& on_end) {
    list_returned();
    std::erase_if(pairs_, [&](PairRecord& pair) {
        if (!unwanted(std::as_const(pair))) return false;
        if (pair.contact != none) {
            on_end(pair.contact);
            remove_contact(pair);
        }
        return true;
    });
}

template <class IsIdle, class OnEnd>
void ContactStore::end_renewal(IsIdle&& is_idle, OnEnd&& on_end) {
    for (; place_ < previous_.size(); ++place_) {
        if (previous_[place_].contact != none) ended_.push_back(previous_[place_]);
    }
    for (PairRecord& pair : ended_) {
        if (is_idle(std::as_const(slots_[pair.contact]))) {
            put_aside(pair);
            continue;
        }
        on_end(pair.contact);
        remove_contact(pair);
    }
}

}  // namespace cairn

#pragma once
// Where contacts live: found by pair in constant time, kept in slots that do not move, listed in
// the order of their keys. A pair that ends leaves with its key.

#include <cstdint>
#include <span>
#include <vector>

#include "base/pair_table.h"
#include "contact/contact.h"
#include "contact/manifold.h"

namespace cairn {

constexpr std::uint64_t pair_key(std::uint32_t shape_a, std::uint32_t shape_b) {
    return (std::uint64_t{shape_a} << 32) | shape_b;
}

class ContactStore {
public:
    static constexpr std::uint32_t none = PairTable::none;

    // A renewal lists all pairs of the step, in ascending order of key; the contacts of those not
    // listed end.
    void begin_renewal();
    // The slot of the pair's contact, a new one where there was none.
    std::uint32_t renew(std::uint32_t shape_a, std::uint32_t shape_b);
    // Ends what was not renewed, calling on_end(contact) for each, in ascending order of key.
    template <class OnEnd>
    void end_renewal(OnEnd&& on_end);

    // Ends contacts outside a renewal: those of a body that is gone, say.
    template <class Unwanted>
    void remove_if(Unwanted&& unwanted);

    // Slots in ascending order of key.
    std::span<const std::uint32_t> listed() const { return listed_; }
    std::span<Contact> slots() { return slots_; }
    Contact& operator[](std::uint32_t slot) { return slots_[slot]; }
    const Contact& operator[](std::uint32_t slot) const { return slots_[slot]; }
    std::uint32_t find(std::uint32_t shape_a, std::uint32_t shape_b) const {
        return table_.find(pair_key(shape_a, shape_b));
    }
    std::size_t size() const { return table_.size(); }

private:
    std::vector<Contact> slots_;
    std::vector<std::uint32_t> free_;
    std::vector<std::uint32_t> listed_, previous_;
    PairTable table_;
};

// Carries the impulses of `contact`'s points over to the new points where the feature is the same;
// then the new points take the old ones' place.
void match_points(Contact& contact, std::span<const ContactPoint> renewed);

template <class Unwanted>
void ContactStore::remove_if(Unwanted&& unwanted) {
    std::erase_if(listed_, [&](std::uint32_t slot) {
        if (!unwanted(slots_[slot])) return false;
        table_.remove(slots_[slot].key);
        free_.push_back(slot);
        return true;
    });
}

template <class OnEnd>
void ContactStore::end_renewal(OnEnd&& on_end) {
    // Both lists ascend: one walk finds what is missing from the new one.
    std::size_t i = 0;
    for (const std::uint32_t slot : previous_) {
        const std::uint64_t key = slots_[slot].key;
        while (i < listed_.size() && slots_[listed_[i]].key < key) ++i;
        if (i < listed_.size() && listed_[i] == slot) continue;
        on_end(slots_[slot]);
        table_.remove(key);
        free_.push_back(slot);
    }
}

}  // namespace cairn

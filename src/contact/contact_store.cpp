// Renewal of contacts and matching of their points; see contact_store.h.

#include "contact/contact_store.h"

namespace cairn {

void ContactStore::begin_renewal() {
    previous_.swap(listed_);
    listed_.clear();
}

std::uint32_t ContactStore::renew(std::uint32_t shape_a, std::uint32_t shape_b) {
    const std::uint64_t key = pair_key(shape_a, shape_b);
    std::uint32_t slot = table_.find(key);
    if (slot == none) {
        if (free_.empty()) {
            slot = std::uint32_t(slots_.size());
            slots_.emplace_back();
        } else {
            slot = free_.back();
            free_.pop_back();
            slots_[slot] = Contact{};
        }
        slots_[slot].key = key;
        slots_[slot].shape_a = shape_a;
        slots_[slot].shape_b = shape_b;
        table_.insert(key, slot);
    }
    listed_.push_back(slot);
    return slot;
}

void match_points(Contact& contact, std::span<const ContactPoint> renewed) {
    std::array<ContactPoint, 4> points;
    for (std::size_t i = 0; i < renewed.size(); ++i) {
        points[i] = renewed[i];
        for (int j = 0; j < contact.point_count; ++j) {
            const ContactPoint& old = contact.points[std::size_t(j)];
            if (old.feature != points[i].feature) continue;
            points[i].normal_force = old.normal_force;
            points[i].friction_force = old.friction_force;
            break;
        }
    }
    contact.points = points;
    contact.point_count = int(renewed.size());
}

}  // namespace cairn

// Renewal of contacts and matching of their points; see contact_store.h.

#include "contact/contact_store.h"

#include <algorithm>

namespace cairn {

namespace {

std::uint64_t key_of(const PairRecord& pair) { return pair_key(pair.shape_a, pair.shape_b); }

}  // namespace

void ContactStore::begin_renewal(std::size_t pair_count) {
    list_returned();
    previous_.swap(pairs_);
    pairs_.clear();
    cairn::make_room(pairs_, pair_count);
    ended_.clear();
    place_ = 0;
}

void ContactStore::renew(std::uint32_t shape_a, std::uint32_t shape_b) {
    // Both lists ascend: one walk tells what stays, what is new and what is missing.
    const std::uint64_t key = pair_key(shape_a, shape_b);
    for (; place_ < previous_.size() && key_of(previous_[place_]) < key; ++place_) {
        if (previous_[place_].contact != none) ended_.push_back(previous_[place_]);
    }
    if (place_ < previous_.size() && key_of(previous_[place_]) == key) {
        pairs_.push_back(previous_[place_++]);
    } else {
        PairRecord& pair = pairs_.emplace_back();
        pair.shape_a = shape_a;
        pair.shape_b = shape_b;
    }
}

void ContactStore::put_aside(const PairRecord& pair) {
    if (asides_.size() < slots_.size()) asides_.resize(slots_.size());
    listings_[pair.contact] = Listing::Aside;
    asides_[pair.contact] = pair;
    asides_[pair.contact].is_found = false;
    asides_by_key_.insert(key_of(pair), pair.contact);
}

void ContactStore::take_back(std::uint32_t slot) {
    if (listings_[slot] != Listing::Aside) return;
    listings_[slot] = Listing::Returning;
    returning_.push_back(slot);
}

void ContactStore::list_returned() {
    if (returning_.empty()) return;
    std::sort(returning_.begin(), returning_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return slots_[a].key < slots_[b].key; });
    previous_.swap(pairs_);
    pairs_.clear();
    std::size_t place = 0;
    for (const std::uint32_t slot : returning_) {
        for (; place < previous_.size() && key_of(previous_[place]) < slots_[slot].key; ++place)
            pairs_.push_back(previous_[place]);
        pairs_.push_back(asides_[slot]);
        listings_[slot] = Listing::Listed;
        asides_by_key_.remove(slots_[slot].key);
    }
    pairs_.insert(pairs_.end(), previous_.begin() + std::ptrdiff_t(place), previous_.end());
    returning_.clear();
}

const PairRecord* ContactStore::find_pair(std::uint32_t shape_a, std::uint32_t shape_b) const {
    const std::uint64_t key = pair_key(shape_a, shape_b);
    const auto found = std::lower_bound(
        pairs_.begin(), pairs_.end(), key,
        [](const PairRecord& pair, std::uint64_t wanted) { return key_of(pair) < wanted; });
    if (found != pairs_.end() && key_of(*found) == key) return &*found;
    const std::uint32_t slot = asides_by_key_.find(key);
    return slot != none ? &asides_[slot] : nullptr;
}

void ContactStore::make_room(std::size_t more) {
    const std::size_t wanted = contact_count() + more;
    if (wanted <= slots_.capacity()) return;
    // Twice as much as before at least, so that a heap that grows is not copied every time.
    const std::size_t room = std::max(wanted, 2 * slots_.size());
    slots_.reserve(room);
    sightings_.reserve(room);
    listings_.reserve(room);
    by_body_.reserve(room);
}

Contact& ContactStore::add_contact(PairRecord& pair, std::uint32_t body_a, std::uint32_t body_b) {
    if (free_.empty()) {
        pair.contact = std::uint32_t(slots_.size());
        slots_.emplace_back();
        sightings_.emplace_back();
        listings_.push_back(Listing::Listed);
    } else {
        pair.contact = free_.back();
        free_.pop_back();
        slots_[pair.contact] = Contact{};
    }
    pair.shows_face = false;
    Contact& contact = slots_[pair.contact];
    contact.key = key_of(pair);
    contact.shape_a = pair.shape_a;
    contact.shape_b = pair.shape_b;
    contact.body_a = body_a;
    contact.body_b = body_b;
    by_body_.attach(pair.contact, body_a, body_b);
    return contact;
}

void ContactStore::remove_contact(PairRecord& pair) {
    by_body_.detach(pair.contact);
    free_.push_back(pair.contact);
    pair.contact = none;
    pair.meets = pair.shows_face = false;
}

void clear_impulses(Contact& contact) {
    for (int i = 0; i < contact.point_count; ++i) {
        contact.points[std::size_t(i)].normal_impulse = 0;
        contact.points[std::size_t(i)].friction_impulse = {};
    }
    contact.rolling_impulse = {};
    contact.spinning_impulse = 0;
}

PointForces forces_of(const Contact& contact) {
    PointForces forces;
    forces.count = contact.point_count;
    for (int i = 0; i < contact.point_count; ++i) {
        const ContactPoint& point = contact.points[std::size_t(i)];
        forces.feature[i] = point.feature;
        forces.normal[i] = point.normal_force;
        forces.friction[i] = point.friction_force;
    }
    return forces;
}

void match_points(const PointForces& before, Contact& contact) {
    for (int i = 0; i < contact.point_count; ++i) {
        ContactPoint& point = contact.points[std::size_t(i)];
        for (int j = 0; j < before.count; ++j) {
            if (before.feature[j] != point.feature) continue;
            point.normal_force = before.normal[j];
            point.friction_force = before.friction[j];
            break;
        }
    }
    contact.rolling_impulse = {};
    contact.spinning_impulse = 0;
}

}  // namespace cairn

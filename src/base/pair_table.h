#pragma once
// A hash table from a pair's 64-bit key to a 32-bit slot: insertion, look-up and removal in
// constant time, and no order of its own that anything could depend on.
//
// Open addressing with linear probing; removal shifts the followers back, so that no tombstones
// gather.

#include <bit>
#include <cstddef>
#include <cstdint>

#include "base/large_array.h"

namespace cairn {

class PairTable {
public:
    static constexpr std::uint32_t none = 0xffffffffu;

    std::size_t size() const { return size_; }

    std::uint32_t find(std::uint64_t key) const {
        if (entries_.empty()) return none;
        for (std::size_t i = home(key);; i = next(i)) {
            if (entries_[i].slot == none) return none;
            if (entries_[i].key == key) return entries_[i].slot;
        }
    }

    // The key must not be there yet.
    void insert(std::uint64_t key, std::uint32_t slot) {
        if (2 * (size_ + 1) > entries_.size()) grow();
        place({key, slot});
        ++size_;
    }

    // The key must be there.
    void remove(std::uint64_t key) {
        std::size_t hole = home(key);
        while (entries_[hole].key != key || entries_[hole].slot == none) hole = next(hole);
        for (std::size_t i = next(hole); entries_[i].slot != none; i = next(i)) {
            // An entry may fill the hole unless its home lies between the hole and itself.
            const std::size_t from_home = (i - home(entries_[i].key)) & mask();
            const std::size_t from_hole = (i - hole) & mask();
            if (from_home >= from_hole) {
                entries_[hole] = entries_[i];
                hole = i;
            }
        }
        entries_[hole] = {};
        --size_;
    }

private:
    struct Entry {
        std::uint64_t key = 0;
        std::uint32_t slot = none;
    };

    std::size_t mask() const { return entries_.size() - 1; }
    std::size_t next(std::size_t i) const { return (i + 1) & mask(); }
    std::size_t home(std::uint64_t key) const {
        // Fibonacci hashing: the product's high bits mix both halves of the key.
        return std::size_t((key * 0x9e3779b97f4a7c15u) >> shift_) & mask();
    }
    void place(Entry entry) {
        std::size_t i = home(entry.key);
        while (entries_[i].slot != none) i = next(i);
        entries_[i] = entry;
    }
    void grow() {
        LargeArray<Entry> old(entries_.empty() ? 64 : 2 * entries_.size());
        old.swap(entries_);
        shift_ = 64 - std::bit_width(mask());
        for (const Entry& entry : old) {
            if (entry.slot != none) place(entry);
        }
    }

    LargeArray<Entry> entries_;
    std::size_t size_ = 0;
    int shift_ = 63;
};

}  // namespace cairn

#pragma once
// Values that many have alike, each kept once: a number stands for a value as long as somebody
// holds it.
//
// Two values are alike if their bytes are, so the type must have no padding. Numbers follow from
// the sequence of calls alone. A value: a copy is complete.
//
// Cost: take() and give_back() in constant time.

#include <cstdint>
#include <cstring>

#include "base/large_array.h"
#include "base/pair_table.h"

namespace cairn {

template <class Value>
class SharedValues {
public:
    // The value's number, which its holder is to give back.
    std::uint32_t take(const Value& value) {
        const std::uint64_t key = key_of(value);
        std::uint32_t number = numbers_.find(key);
        if (number != PairTable::none && is_alike(entries_[number].value, value)) {
            ++entries_[number].holders;
            return number;
        }
        // Of different values with one key only the first is found again.
        const bool is_listed = number == PairTable::none;
        number = take_entry();
        entries_[number] = {value, 1, is_listed};
        if (is_listed) numbers_.insert(key, number);
        return number;
    }
    void give_back(std::uint32_t number) {
        Entry& entry = entries_[number];
        if (--entry.holders > 0) return;
        if (entry.is_listed) numbers_.remove(key_of(entry.value));
        free_.push_back(number);
    }

    const Value& operator[](std::uint32_t number) const { return entries_[number].value; }
    // How many are held.
    std::size_t size() const { return entries_.size() - free_.size(); }

private:
    struct Entry {
        Value value;
        std::uint32_t holders = 0;
        bool is_listed = false;
    };

    static bool is_alike(const Value& a, const Value& b) {
        const void *bytes_a = &a, *bytes_b = &b;
        return std::memcmp(bytes_a, bytes_b, sizeof(Value)) == 0;
    }
    // Fowler, Noll and Vo's hash, a word at a time.
    static std::uint64_t key_of(const Value& value) {
        static_assert(sizeof(Value) % sizeof(std::uint32_t) == 0);
        std::uint32_t words[sizeof(Value) / sizeof(std::uint32_t)];
        std::memcpy(words, &value, sizeof(Value));
        std::uint64_t key = 0xcbf29ce484222325u;
        for (const std::uint32_t word : words) key = (key ^ word) * 0x100000001b3u;
        return key;
    }
    std::uint32_t take_entry() {
        if (free_.empty()) {
            entries_.emplace_back();
            return std::uint32_t(entries_.size() - 1);
        }
        const std::uint32_t number = free_.back();
        free_.pop_back();
        return number;
    }

    LargeArray<Entry> entries_;  // by number
    LargeArray<std::uint32_t> free_;
    PairTable numbers_;  // by key
};

}  // namespace cairn

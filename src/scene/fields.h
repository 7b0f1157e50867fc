#pragma once
// Typed reading of a JSON tree: every accessor checks kind, range and finiteness, and throws a
// Fault that names the place, what was found and what is allowed.
//
// Numbers are read as binary64 and rounded once to binary32 where the engine keeps binary32.

#include <initializer_list>
#include <span>

#include "cairn/types.h"
#include "scene/json_tree.h"

namespace cairn::scene {

/// Where a value stands, as a chain of steps up to the root. Lives on the stack of the reader.
struct Place {
    const Place* parent = nullptr;
    std::string_view key = {};  // a step into an object; else `index` is a step into an array
    std::size_t index = 0;

    std::string path() const;
    [[noreturn]] void fail(std::string message) const;
};

/// What a number may be.
struct Range {
    double low;
    double high;
    bool low_is_open;
    const char* words;
};
inline constexpr double no_limit = 1.7976931348623157e308;
inline constexpr Range any_number = {-no_limit, no_limit, false, "a finite number"};
inline constexpr Range positive = {0, no_limit, true, "a number greater than 0"};
inline constexpr Range not_negative = {0, no_limit, false, "a number of at least 0"};
inline constexpr Range zero_to_one = {0, 1, false, "a number from 0 to 1"};

double read_double(const JsonValue& value, const Place& at, const Range& range = any_number);
float read_float(const JsonValue& value, const Place& at, const Range& range = any_number);
bool read_bool(const JsonValue& value, const Place& at);
const std::string& read_string(const JsonValue& value, const Place& at);
std::int64_t read_integer(const JsonValue& value, const Place& at, std::int64_t low,
                          std::int64_t high);
const JsonValue& read_array(const JsonValue& value, const Place& at, const char* words,
                            std::size_t count = 0);
Vec3 read_vec3(const JsonValue& value, const Place& at, const Range& range = any_number);
Position read_position(const JsonValue& value, const Place& at);
/// [x, y, z, w], normalised, or {"axis", "degrees"}.
Quat read_rotation(const JsonValue& value, const Place& at);

/// An object whose keys are known: makes sure that it is one, and that it has no other key.
class Fields {
public:
    Fields(const JsonValue& value, const Place& at, std::span<const std::string_view> allowed);

    /// Null where the key is absent.
    const JsonValue* find(std::string_view key) const;
    /// Fails where the key is absent.
    const JsonValue& require(std::string_view key, const char* words) const;
    Place place(std::string_view key) const { return {at_, key, 0}; }
    const Place& at() const { return *at_; }

    void read(std::string_view key, double& out, const Range& range = any_number) const;
    void read(std::string_view key, float& out, const Range& range = any_number) const;
    void read(std::string_view key, bool& out) const;
    void read(std::string_view key, std::string& out) const;
    void read(std::string_view key, Vec3& out) const;
    void read(std::string_view key, Position& out) const;
    void read(std::string_view key, Quat& out) const;

private:
    const JsonValue* object_;
    const Place* at_;
};

/// Of the words, the one that a person most likely meant; empty where none is near.
std::string_view find_nearest(std::string_view word, std::span<const std::string_view> words);
/// "a, b, c".
std::string list_words(std::span<const std::string_view> words);

}  // namespace cairn::scene

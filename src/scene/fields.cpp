// Typed reading of a JSON tree, see fields.h.
//
// Rotations given by axis and angle go through the library's own sine and cosine: no libm beyond
// sqrt touches a value that reaches a world.

#include "scene/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "cairn/math.h"

namespace cairn::scene {

std::string Place::path() const {
    if (parent == nullptr) return {};
    std::string path = parent->path();
    if (key.empty()) return path + fmt::format("[{}]", index);
    if (!path.empty()) path += '.';
    return path + make_printable(key);
}

void Place::fail(std::string message) const { throw Fault{path(), std::move(message)}; }

namespace {

[[noreturn]] void fail_found(const JsonValue& value, const Place& at, std::string_view allowed) {
    at.fail(fmt::format("found {}; allowed: {}", describe(value), allowed));
}

bool is_inside(double number, const Range& range) {
    return number <= range.high && (range.low_is_open ? number > range.low : number >= range.low);
}

}  // namespace

double read_double(const JsonValue& value, const Place& at, const Range& range) {
    if (value.kind != JsonValue::Kind::Number || !is_inside(value.number, range)) {
        fail_found(value, at, range.words);
    }
    return value.number;
}

float read_float(const JsonValue& value, const Place& at, const Range& range) {
    const double number = read_double(value, at, range);
    // Halfway between the largest binary32 number and the next that there would be.
    constexpr double overflow = 3.4028235677973366e38;
    if (std::fabs(number) >= overflow) {
        at.fail(fmt::format("found {}, which overflows binary32; allowed: at most {:.8g} in size",
                            describe(value), static_cast<double>(FLT_MAX)));
    }
    const float rounded = static_cast<float>(number);
    if (range.low_is_open && !is_inside(static_cast<double>(rounded), range)) {
        at.fail(fmt::format("found {}, which is {} in binary32; allowed: {}", describe(value),
                            rounded, range.words));
    }
    return rounded;
}

bool read_bool(const JsonValue& value, const Place& at) {
    if (value.kind != JsonValue::Kind::Bool) fail_found(value, at, "true or false");
    return value.truth;
}

const std::string& read_string(const JsonValue& value, const Place& at) {
    if (value.kind != JsonValue::Kind::String) fail_found(value, at, "a string");
    return value.text;
}

std::int64_t read_integer(const JsonValue& value, const Place& at, std::int64_t low,
                          std::int64_t high) {
    const double number = value.number;
    const bool fits = value.kind == JsonValue::Kind::Number && number >= -9007199254740992.0 &&
                      number <= 9007199254740992.0 &&
                      static_cast<double>(static_cast<std::int64_t>(number)) == number;
    if (!fits || static_cast<std::int64_t>(number) < low ||
        static_cast<std::int64_t>(number) > high) {
        fail_found(value, at, fmt::format("a whole number from {} to {}", low, high));
    }
    return static_cast<std::int64_t>(number);
}

const JsonValue& read_array(const JsonValue& value, const Place& at, const char* words,
                            std::size_t count) {
    if (value.kind != JsonValue::Kind::Array || (count != 0 && value.items.size() != count)) {
        fail_found(value, at, words);
    }
    return value;
}

Vec3 read_vec3(const JsonValue& value, const Place& at, const Range& range) {
    read_array(value, at, "an array of 3 numbers, [x, y, z]", 3);
    return {read_float(value.items[0], {&at, {}, 0}, range),
            read_float(value.items[1], {&at, {}, 1}, range),
            read_float(value.items[2], {&at, {}, 2}, range)};
}

Position read_position(const JsonValue& value, const Place& at) {
    read_array(value, at, "an array of 3 numbers, [x, y, z]", 3);
    // Beyond this a world position no longer tells apart points a kilometre from each other.
    constexpr Range within_reach = {-1e18, 1e18, false, "metres from -1e18 to 1e18"};
    return {read_double(value.items[0], {&at, {}, 0}, within_reach),
            read_double(value.items[1], {&at, {}, 1}, within_reach),
            read_double(value.items[2], {&at, {}, 2}, within_reach)};
}

namespace {

Quat read_axis_rotation(const JsonValue& value, const Place& at) {
    static constexpr std::string_view keys[] = {"axis", "degrees"};
    const Fields fields(value, at, keys);
    const JsonValue& axis_value = fields.require("axis", "[x, y, z], any length but 0");
    const JsonValue& degrees_value = fields.require("degrees", "degrees about the axis");
    constexpr Range turns = {-1e6, 1e6, false, "degrees from -1e6 to 1e6"};
    const Vec3 axis = read_vec3(axis_value, fields.place("axis"));
    const double degrees = read_double(degrees_value, fields.place("degrees"), turns);
    const double x = static_cast<double>(axis.x), y = static_cast<double>(axis.y),
                 z = static_cast<double>(axis.z);
    const double norm = std::sqrt(x * x + y * y + z * z);
    if (!(norm > 0)) {
        fields.place("axis").fail("found an axis of length 0; allowed: any other length");
    }
    // Unit length first, so that an axis of any size that binary32 holds will do.
    const Vec3 unit = {static_cast<float>(x / norm), static_cast<float>(y / norm),
                       static_cast<float>(z / norm)};
    return rotation_about(unit, degrees * (3.14159265358979323846 / 180));
}

}  // namespace

Quat read_rotation(const JsonValue& value, const Place& at) {
    if (value.kind == JsonValue::Kind::Object) return read_axis_rotation(value, at);
    read_array(value, at, "a quaternion [x, y, z, w] or {\"axis\": [x, y, z], \"degrees\": d}", 4);
    double q[4];
    double square = 0;
    float rounded[4];
    for (std::size_t i = 0; i < 4; ++i) {
        rounded[i] = read_float(value.items[i], {&at, {}, i});
        q[i] = static_cast<double>(rounded[i]);
        square += q[i] * q[i];
    }
    if (!(square > 0)) {
        at.fail("found a quaternion of length 0; allowed: any other length, it is normalised");
    }
    // What binary32 already calls unit is left alone, so that a written rotation reads back the
    // same.
    if (std::fabs(square - 1) > 5e-7) {
        const double norm = std::sqrt(square);
        for (std::size_t i = 0; i < 4; ++i) rounded[i] = static_cast<float>(q[i] / norm);
    }
    return {rounded[0], rounded[1], rounded[2], rounded[3]};
}

Fields::Fields(const JsonValue& value, const Place& at, std::span<const std::string_view> allowed)
    : object_(&value), at_(&at) {
    if (value.kind != JsonValue::Kind::Object) {
        fail_found(value, at, "an object with the keys " + list_words(allowed));
    }
    for (const std::string& key : value.keys) {
        if (std::find(allowed.begin(), allowed.end(), key) != allowed.end()) continue;
        const std::string_view near = find_nearest(key, allowed);
        const std::string shown = make_printable(key);
        Place{&at, shown.empty() ? std::string_view("\"\"") : std::string_view(shown), 0}.fail(
            fmt::format("unknown key \"{}\"{}; allowed: {}", shown,
                        near.empty() ? "" : fmt::format(", did you mean \"{}\"?", near),
                        list_words(allowed)));
    }
}

const JsonValue* Fields::find(std::string_view key) const {
    for (std::size_t i = 0; i < object_->keys.size(); ++i) {
        if (object_->keys[i] == key) return &object_->items[i];
    }
    return nullptr;
}

const JsonValue& Fields::require(std::string_view key, const char* words) const {
    const JsonValue* value = find(key);
    if (value == nullptr) {
        place(key).fail(fmt::format("missing; the key \"{}\" is required: {}", key, words));
    }
    return *value;
}

void Fields::read(std::string_view key, double& out, const Range& range) const {
    if (const JsonValue* value = find(key)) out = read_double(*value, place(key), range);
}
void Fields::read(std::string_view key, float& out, const Range& range) const {
    if (const JsonValue* value = find(key)) out = read_float(*value, place(key), range);
}
void Fields::read(std::string_view key, bool& out) const {
    if (const JsonValue* value = find(key)) out = read_bool(*value, place(key));
}
void Fields::read(std::string_view key, std::string& out) const {
    if (const JsonValue* value = find(key)) out = read_string(*value, place(key));
}
void Fields::read(std::string_view key, Vec3& out) const {
    if (const JsonValue* value = find(key)) out = read_vec3(*value, place(key));
}
void Fields::read(std::string_view key, Position& out) const {
    if (const JsonValue* value = find(key)) out = read_position(*value, place(key));
}
void Fields::read(std::string_view key, Quat& out) const {
    if (const JsonValue* value = find(key)) out = read_rotation(*value, place(key));
}

namespace {

// Edits (insert, drop, change, swap neighbours) that turn one word into the other.
std::size_t count_edits(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
            }
        }
    }
    return d[a.size()][b.size()];
}

// Case, hyphens, spaces and underscores are the same slip of the hand.
std::string fold(std::string_view word) {
    std::string folded;
    for (const char c : word) {
        if (c == '_' || c == '-' || c == ' ') continue;
        folded += (c >= 'A' && c <= 'Z') ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return folded;
}

}  // namespace

std::string_view find_nearest(std::string_view word, std::span<const std::string_view> words) {
    if (word.size() > 64) return {};
    const std::string folded = fold(word);
    std::string_view nearest;
    std::size_t fewest = 1000;
    for (const std::string_view candidate : words) {
        const std::string other = fold(candidate);
        std::size_t edits = count_edits(folded, other);
        // A word cut short, or with more behind it, is near as well.
        if (folded.size() >= 3 && other.size() >= 3 &&
            (other.starts_with(folded) || folded.starts_with(other))) {
            edits = std::min<std::size_t>(edits, 2);
        }
        if (edits < fewest) {
            fewest = edits;
            nearest = candidate;
        }
    }
    const std::size_t reach = std::max<std::size_t>(1, std::min<std::size_t>(3, folded.size() / 2));
    return fewest <= reach ? nearest : std::string_view{};
}

std::string list_words(std::span<const std::string_view> words) {
    std::string list;
    for (const std::string_view word : words) {
        if (!list.empty()) list += ", ";
        list += word;
    }
    return list;
}

}  // namespace cairn::scene

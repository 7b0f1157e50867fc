#pragma once
// JSON text as a tree that keeps what a checker needs: members in their order, numbers exactly as a
// double holds them. Repeated keys, deep nesting, overflowing numbers and broken text are faults
// with the place where they stand.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cairn::scene {

/// Thrown inside the reader, never out of it.
struct Fault {
    std::string path;  ///< as `bodies[3].shapes[0].radius`; empty for the scene as a whole
    std::string message;
};

struct JsonValue {
    enum class Kind : std::uint8_t { Null, Bool, Number, String, Array, Object };
    Kind kind = Kind::Null;
    bool truth = false;
    bool is_unsigned = false;  // `natural` holds the number
    double number = 0;
    std::uint64_t natural = 0;
    std::string text;
    std::vector<JsonValue> items;   // of an array, or the values of an object
    std::vector<std::string> keys;  // of an object, in their order
};

/// Nesting beyond this is a fault; the format itself needs less than ten.
inline constexpr std::size_t max_depth = 64;

/// Throws a Fault.
JsonValue parse_json(std::string_view text);

/// The text with control characters and bytes beyond ASCII escaped, cut to `limit` characters.
std::string make_printable(std::string_view text, std::size_t limit = 60);
/// A value as an error message shows it.
std::string describe(const JsonValue& value);

}  // namespace cairn::scene

// JSON text to a tree, by nlohmann's event parser.
//
// Reads: bytes. Writes: JsonValue, or throws a Fault that carries the path where the parser stood.
// The parser itself keeps no stack of calls, so depth is bounded by max_depth alone.

#include "scene/json_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

namespace cairn::scene {

namespace {

using Json = nlohmann::json;

// The first key that stands twice in the object, or null. Sorted, so that a huge object stays
// cheap.
const std::string* find_repeated_key(const JsonValue& object) {
    std::vector<const std::string*> sorted;
    sorted.reserve(object.keys.size());
    for (const std::string& key : object.keys) sorted.push_back(&key);
    std::sort(sorted.begin(), sorted.end(), [](auto* a, auto* b) { return *a < *b; });
    const auto twin =
        std::adjacent_find(sorted.begin(), sorted.end(), [](auto* a, auto* b) { return *a == *b; });
    return twin == sorted.end() ? nullptr : *twin;
}

// Receives the parser's events and grows the tree.
class TreeBuilder : public nlohmann::json_sax<Json> {
public:
    explicit TreeBuilder(std::string_view text) : text_(text) {}

    JsonValue take_root() { return std::move(root_); }

    bool null() override { return add({}) != nullptr; }
    bool boolean(bool truth) override {
        JsonValue value;
        value.kind = JsonValue::Kind::Bool;
        value.truth = truth;
        return add(std::move(value)) != nullptr;
    }
    bool number_integer(number_integer_t number) override {
        return add_number(static_cast<double>(number), false, 0);
    }
    bool number_unsigned(number_unsigned_t number) override {
        return add_number(static_cast<double>(number), true, number);
    }
    bool number_float(number_float_t number, const string_t&) override {
        // A whole number written with a point or an exponent is a whole number all the same.
        const bool whole = number >= 0 && number < 9007199254740992.0 &&
                           static_cast<double>(static_cast<std::uint64_t>(number)) == number;
        return add_number(number, whole, whole ? static_cast<std::uint64_t>(number) : 0);
    }
    bool string(string_t& text) override {
        JsonValue value;
        value.kind = JsonValue::Kind::String;
        value.text = std::move(text);
        return add(std::move(value)) != nullptr;
    }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(JsonValue::Kind::Object); }
    bool start_array(std::size_t) override { return open(JsonValue::Kind::Array); }
    bool key(string_t& key) override {
        open_.back()->keys.push_back(std::move(key));
        return true;
    }
    bool end_object() override {
        if (const std::string* key = find_repeated_key(*open_.back())) {
            std::string at = container_path(open_.size() - 1);
            if (!at.empty()) at += '.';
            const std::string name = make_printable(*key);
            throw Fault{at + name, fmt::format("key \"{}\" stands more than once; a key may stand "
                                               "once in an object",
                                               name)};
        }
        open_.pop_back();
        return true;
    }
    bool end_array() override {
        open_.pop_back();
        return true;
    }
    bool parse_error(std::size_t position, const std::string& last_token,
                     const nlohmann::detail::exception& error) override {
        if (error.id == 406) {
            throw Fault{value_path(), fmt::format("found {}, which is beyond what binary64 holds; "
                                                  "allowed: finite numbers",
                                                  make_printable(last_token))};
        }
        throw Fault{value_path(), describe_syntax(position, error.what())};
    }

private:
    bool add_number(double number, bool is_unsigned, std::uint64_t natural) {
        JsonValue value;
        value.kind = JsonValue::Kind::Number;
        value.number = number;
        value.is_unsigned = is_unsigned;
        value.natural = natural;
        return add(std::move(value)) != nullptr;
    }

    JsonValue* add(JsonValue value) {
        if (open_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        open_.back()->items.push_back(std::move(value));
        return &open_.back()->items.back();
    }

    bool open(JsonValue::Kind kind) {
        if (open_.size() >= max_depth) {
            throw Fault{value_path(), fmt::format("nested more than {} deep; allowed: the format's "
                                                  "own depth, which is less than ten",
                                                  max_depth)};
        }
        JsonValue value;
        value.kind = kind;
        // A container that is open never moves: its parent grows only after it is closed.
        open_.push_back(add(std::move(value)));
        return true;
    }

    // Where the container at the given depth of the stack stands.
    std::string container_path(std::size_t depth) const {
        std::string path;
        for (std::size_t i = 0; i < depth; ++i) {
            const JsonValue& parent = *open_[i];
            if (parent.kind == JsonValue::Kind::Array) {
                path += fmt::format("[{}]", parent.items.size() - 1);
            } else if (!parent.keys.empty()) {
                if (!path.empty()) path += '.';
                path += make_printable(parent.keys.back());
            }
        }
        return path;
    }

    // Where the value stands that is being read.
    std::string value_path() const {
        if (open_.empty()) return {};
        std::string path = container_path(open_.size() - 1);
        const JsonValue& parent = *open_.back();
        if (parent.kind == JsonValue::Kind::Array) {
            path += fmt::format("[{}]", parent.items.size());
        } else if (parent.keys.size() > parent.items.size()) {
            if (!path.empty()) path += '.';
            path += make_printable(parent.keys.back());
        }
        return path;
    }

    std::string describe_syntax(std::size_t position, std::string_view what) const {
        if (text_.find_first_not_of(" \t\r\n") == std::string_view::npos) {
            return "the file is empty; a scene is a JSON object with \"cairn\": 1";
        }
        const std::size_t end = std::min(position, text_.size());
        const std::string_view before = text_.substr(0, end);
        const auto line = std::count(before.begin(), before.end(), '\n') + 1;
        const std::size_t column = end - (before.rfind('\n') + 1);
        // The parser stops at the first letter that no JSON number has.
        const char last = before.empty() ? ' ' : before.back();
        if (last == 'N' || last == 'I') {
            return fmt::format(
                "line {}, column {}: JSON has no NaN and no infinity; allowed: finite "
                "numbers",
                line, column);
        }
        // The parser's words, without its own prefix and position.
        const std::size_t colon = what.find(": ");
        if (colon != std::string_view::npos) what.remove_prefix(colon + 2);
        return fmt::format("line {}, column {}: not valid JSON: {}", line, column,
                           make_printable(what, 200));
    }

    std::string_view text_;
    JsonValue root_;
    std::vector<JsonValue*> open_;
};

}  // namespace

JsonValue parse_json(std::string_view text) {
    TreeBuilder builder(text);
    if (!Json::sax_parse(text.begin(), text.end(), &builder)) {
        throw Fault{"", "not valid JSON"};
    }
    return builder.take_root();
}

std::string make_printable(std::string_view text, std::size_t limit) {
    std::string printable;
    for (const char c : text) {
        if (printable.size() >= limit) return printable + "...";
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte >= 0x7f) {
            printable += fmt::format("\\x{:02x}", byte);
        } else {
            printable += c;
        }
    }
    return printable;
}

std::string describe(const JsonValue& value) {
    switch (value.kind) {
        case JsonValue::Kind::Null: return "null";
        case JsonValue::Kind::Bool: return value.truth ? "true" : "false";
        case JsonValue::Kind::Number:
            return value.is_unsigned ? fmt::format("{}", value.natural)
                                     : fmt::format("{}", value.number);
        case JsonValue::Kind::String: return fmt::format("\"{}\"", make_printable(value.text));
        case JsonValue::Kind::Array: return fmt::format("an array of {}", value.items.size());
        case JsonValue::Kind::Object: return fmt::format("an object of {} keys", value.keys.size());
    }
    return {};
}

}  // namespace cairn::scene

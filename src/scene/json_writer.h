#pragma once
// Writes JSON whose numbers read back to the same bits: the shortest decimal that does so.
//
// Containers are laid out over lines or within one, as the caller says. A number that is not finite
// is written as null, since JSON has no other way.

#include <string>
#include <string_view>
#include <vector>

#include "cairn/types.h"

namespace cairn::scene {

enum class Layout : unsigned char { Lines, Inline };

class JsonWriter {
public:
    JsonWriter& begin_object(Layout layout = Layout::Lines) { return open('{', '}', layout); }
    JsonWriter& begin_array(Layout layout = Layout::Lines) { return open('[', ']', layout); }
    JsonWriter& end();

    JsonWriter& key(std::string_view name);
    JsonWriter& value(double number);
    JsonWriter& value(float number);
    JsonWriter& value(bool truth);
    JsonWriter& value(std::string_view text);
    JsonWriter& value(const char* text) { return value(std::string_view(text)); }
    JsonWriter& value(std::int64_t number);
    JsonWriter& value(std::uint64_t number);
    JsonWriter& value(int number) { return value(static_cast<std::int64_t>(number)); }
    JsonWriter& value(const Vec3& v);
    JsonWriter& value(const Position& p);
    JsonWriter& value(const Quat& q);
    JsonWriter& value(const SymmetricMat3& m);
    /// Text that is JSON already.
    JsonWriter& value_verbatim(std::string_view json);
    template <class T>
    JsonWriter& member(std::string_view name, const T& content) {
        return key(name).value(content);
    }

    /// The text so far, which the writer gives away; for long documents, piece by piece.
    std::string take();
    std::size_t size() const { return text_.size(); }

private:
    struct Level {
        char close;
        Layout layout;
        bool is_empty;
    };
    JsonWriter& open(char open, char close, Layout layout);
    void separate();
    void break_line();
    void append_numbers(const double* numbers, std::size_t count);
    void append_numbers(const float* numbers, std::size_t count);

    std::string text_;
    std::vector<Level> levels_;
    bool after_key_ = false;
};

/// The shortest decimal that reads back to the same bits, with a sign even on zero.
void append_number(std::string& text, double number);
void append_number(std::string& text, float number);

}  // namespace cairn::scene

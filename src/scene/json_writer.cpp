// JSON with numbers that survive the trip, see json_writer.h.
//
// Negative zero is written "-0.0": many readers take "-0" for the integer 0 and lose its sign.

#include "scene/json_writer.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <iterator>

namespace cairn::scene {

void append_number(std::string& text, double number) {
    if (!std::isfinite(number)) {
        text += "null";
    } else if (number == 0) {
        text += std::signbit(number) ? "-0.0" : "0";
    } else {
        fmt::format_to(std::back_inserter(text), FMT_COMPILE("{}"), number);
        // Whole numbers below 1e16 come as "3"; JSON needs no point.
    }
}

void append_number(std::string& text, float number) {
    if (!std::isfinite(number) || number == 0)
        return append_number(text, static_cast<double>(number));
    const std::size_t start = text.size();
    fmt::format_to(std::back_inserter(text), FMT_COMPILE("{}"), number);
    // A reader may go by way of binary64; where that rounds elsewhere, more digits settle it.
    const double by_way = std::strtod(text.c_str() + start, nullptr);
    if (static_cast<float>(by_way) != number) {
        text.resize(start);
        append_number(text, static_cast<double>(number));
    }
}

void JsonWriter::break_line() {
    text_ += '\n';
    text_.append(2 * levels_.size(), ' ');
}

void JsonWriter::separate() {
    if (after_key_) {
        after_key_ = false;
        return;
    }
    if (levels_.empty()) return;
    Level& level = levels_.back();
    if (!level.is_empty) text_ += ',';
    if (level.layout == Layout::Lines) {
        break_line();
    } else if (!level.is_empty || level.close == '}') {
        text_ += ' ';
    }
    level.is_empty = false;
}

JsonWriter& JsonWriter::open(char open, char close, Layout layout) {
    separate();
    text_ += open;
    const bool outer_is_inline = !levels_.empty() && levels_.back().layout == Layout::Inline;
    levels_.push_back({close, outer_is_inline ? Layout::Inline : layout, true});
    return *this;
}

JsonWriter& JsonWriter::end() {
    const Level level = levels_.back();
    levels_.pop_back();
    if (!level.is_empty) {
        if (level.layout == Layout::Lines) {
            break_line();
        } else if (level.close == '}') {
            text_ += ' ';
        }
    }
    text_ += level.close;
    if (levels_.empty()) text_ += '\n';
    return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
    value(name);
    text_ += ": ";
    after_key_ = true;
    return *this;
}

JsonWriter& JsonWriter::value(double number) {
    separate();
    append_number(text_, number);
    return *this;
}

JsonWriter& JsonWriter::value(float number) {
    separate();
    append_number(text_, number);
    return *this;
}

JsonWriter& JsonWriter::value(bool truth) {
    separate();
    text_ += truth ? "true" : "false";
    return *this;
}

JsonWriter& JsonWriter::value(std::string_view text) {
    separate();
    text_ += '"';
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            text_ += '\\';
            text_ += c;
        } else if (c == '\n') {
            text_ += "\\n";
        } else if (c == '\t') {
            text_ += "\\t";
        } else if (byte < 0x20 || byte == 0x7f) {
            fmt::format_to(std::back_inserter(text_), "\\u{:04x}", byte);
        } else {
            text_ += c;
        }
    }
    text_ += '"';
    return *this;
}

JsonWriter& JsonWriter::value(std::int64_t number) {
    separate();
    fmt::format_to(std::back_inserter(text_), "{}", number);
    return *this;
}

JsonWriter& JsonWriter::value(std::uint64_t number) {
    separate();
    fmt::format_to(std::back_inserter(text_), "{}", number);
    return *this;
}

void JsonWriter::append_numbers(const double* numbers, std::size_t count) {
    separate();
    for (std::size_t i = 0; i < count; ++i) {
        text_ += i == 0 ? "[" : ", ";
        append_number(text_, numbers[i]);
    }
    text_ += ']';
}

void JsonWriter::append_numbers(const float* numbers, std::size_t count) {
    separate();
    for (std::size_t i = 0; i < count; ++i) {
        text_ += i == 0 ? "[" : ", ";
        append_number(text_, numbers[i]);
    }
    text_ += ']';
}

JsonWriter& JsonWriter::value(const Vec3& v) {
    const float numbers[] = {v.x, v.y, v.z};
    append_numbers(numbers, 3);
    return *this;
}

JsonWriter& JsonWriter::value(const Position& p) {
    const double numbers[] = {p.x, p.y, p.z};
    append_numbers(numbers, 3);
    return *this;
}

JsonWriter& JsonWriter::value(const Quat& q) {
    const float numbers[] = {q.x, q.y, q.z, q.w};
    append_numbers(numbers, 4);
    return *this;
}

JsonWriter& JsonWriter::value(const SymmetricMat3& m) {
    const float numbers[] = {m.xx, m.yy, m.zz, m.xy, m.xz, m.yz};
    append_numbers(numbers, 6);
    return *this;
}

JsonWriter& JsonWriter::value_verbatim(std::string_view json) {
    separate();
    text_ += json;
    return *this;
}

std::string JsonWriter::take() {
    std::string text;
    text.swap(text_);
    return text;
}

}  // namespace cairn::scene

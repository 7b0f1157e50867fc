// Puts the replay page together. Everything that a user wrote (names, descriptions) is inside the
// recording, which is base64; the title alone stands in the HTML, escaped.

#include "scene/replay_page.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>

#include "scene/replay_assets.h"

namespace cairn::scene {

namespace {

std::string join(assets::Pieces pieces) {
    std::string text;
    for (const std::string_view piece : pieces) text += piece;
    return text;
}

// The length of the UTF-8 sequence that `text` begins with, 0 where it is none.
std::size_t sequence_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    const std::size_t length = lead < 0x80                   ? 1
                               : lead >= 0xc2 && lead < 0xe0 ? 2
                               : lead >= 0xe0 && lead < 0xf0 ? 3
                               : lead >= 0xf0 && lead < 0xf5 ? 4
                                                             : 0;
    if (length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return 0;
    }
    return length;
}

// Hands the page to `put`, piece by piece.
void assemble(std::string_view title, std::string_view recording,
              const std::function<void(std::string_view)>& put) {
    const std::string page = join(assets::page_html);
    std::string_view rest = page;
    while (!rest.empty()) {
        const std::size_t open = rest.find("{{");
        put(rest.substr(0, open));
        if (open == std::string_view::npos) return;
        const std::size_t close = rest.find("}}", open);
        const std::string_view slot = rest.substr(open + 2, close - open - 2);
        if (slot == "title") put(escape_html(title));
        if (slot == "style") put(join(assets::style_css));
        if (slot == "three") put(join(assets::three_js));
        if (slot == "player") put(join(assets::player_js));
        if (slot == "recording") put(recording);
        rest.remove_prefix(close + 2);
    }
}

Error describe_failure(const std::string& path, const char* doing, int error) {
    return {ErrorCode::OutOfRange,
            fmt::format("replay page '{}': {}: {}", path, doing, std::strerror(error))};
}

}  // namespace

std::string escape_html(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const std::size_t length = sequence_length(text);
        switch (length == 1 ? text[0] : '\0') {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '"': out += "&quot;"; break;
            case '\'': out += "&#39;"; break;
            default:
                if (length == 0) {
                    out += "\xef\xbf\xbd";
                } else if (length > 1 || text[0] >= ' ' || text[0] == '\n' || text[0] == '\t') {
                    out += text.substr(0, length);
                }
        }
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return out;
}

std::string encode_base64(std::span<const std::uint8_t> bytes) {
    static constexpr char digits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = bytes.size() - i;
        const std::uint32_t group = static_cast<std::uint32_t>(bytes[i]) << 16 |
                                    (left > 1 ? static_cast<std::uint32_t>(bytes[i + 1]) << 8 : 0) |
                                    (left > 2 ? static_cast<std::uint32_t>(bytes[i + 2]) : 0);
        out += digits[group >> 18];
        out += digits[group >> 12 & 63];
        out += left > 1 ? digits[group >> 6 & 63] : '=';
        out += left > 2 ? digits[group & 63] : '=';
    }
    return out;
}

std::size_t replay_page_overhead(std::string_view title) {
    std::size_t size = 0;
    assemble(title, {}, [&](std::string_view piece) { size += piece.size(); });
    return size;
}

Status write_replay_page(const std::string& path, std::string_view title, const Bytes& recording) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"),
                                                               std::fclose);
    if (!file) return describe_failure(path, "cannot be opened for writing", errno);
    bool ok = true;
    assemble(title, encode_base64(recording), [&](std::string_view piece) {
        ok = ok && std::fwrite(piece.data(), 1, piece.size(), file.get()) == piece.size();
    });
    ok = ok && std::fflush(file.get()) == 0;
    if (!ok) return describe_failure(path, "writing failed", errno);
    return Done{};
}

}  // namespace cairn::scene

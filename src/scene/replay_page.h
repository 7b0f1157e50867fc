#pragma once
// The HTML around a recording: player, styles and three.js, all inside one file.

#include <string>
#include <string_view>

#include "cairn/result.h"
#include "scene/replay_codec.h"

namespace cairn::scene {

// Writes the page to `path`. `title` may hold any bytes. `recording` is what the page's decode.js
// reads: "CRN1", the header's length u32, the header (JSON), zeros up to a multiple of eight, the
// track.
Status write_replay_page(const std::string& path, std::string_view title, const Bytes& recording);

// How many bytes the page has besides the recording, title included.
std::size_t replay_page_overhead(std::string_view title);

std::string encode_base64(std::span<const std::uint8_t> bytes);
// Text for an HTML element or a quoted attribute; bytes that are not UTF-8 become U+FFFD.
std::string escape_html(std::string_view text);

}  // namespace cairn::scene

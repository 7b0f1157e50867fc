#pragma once
// The page's parts as they were when Cairn was built; defined by a source that
// cmake/embed_replay.cmake writes from web/replay/ and three.js. Each asset is its text in pieces,
// to be put one after the other.

#include <span>
#include <string_view>

namespace cairn::scene::assets {

using Pieces = std::span<const std::string_view>;

extern const Pieces
    page_html;  // the frame, with {{title}}, {{style}}, {{scripts}} and {{recording}}
extern const Pieces style_css;
extern const Pieces three_js;
extern const Pieces player_js;  // all of the player's scripts, in the order in which they must run

}  // namespace cairn::scene::assets

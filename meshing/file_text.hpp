/// Pieces of the text of a mesh file.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace hemoflux::meshing {

/// What stands between words.
inline constexpr const char* blank = " \t\r\n";

/// The beginning of the first line, at most 40 characters, to be shown in a message; what cannot be printed as ?.
inline std::string shown(std::string_view text) {
    std::string begin(text.substr(0, std::min<std::size_t>(text.find('\n'), 40)));
    std::replace_if(
        begin.begin(), begin.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return begin;
}

}  // namespace hemoflux::meshing

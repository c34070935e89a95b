/// Texts in gnuplot's scripts.
#pragma once

#include <string>

namespace hemoflux::output {

/// A gnuplot string in single quotes, in which nothing but the quote is special; ends of lines become blanks.
inline std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("''") : std::string(1, c == '\n' ? ' ' : c);
    return out + "'";
}

}  // namespace hemoflux::output

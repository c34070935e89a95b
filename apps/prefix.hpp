/// Errors of the rooms below, which know nothing of files and keys, with the place in the case they come from.
#pragma once

#include <string>

#include "exchange/error.hpp"

namespace hemoflux::apps {

/// The error "what: why. Remedy." as "where: what: why. Remedy.".
inline InputError prefixed(const std::string& where, const InputError& error) {
    std::string text = error.what();
    text.pop_back();  // the full stop, which comes back
    const std::size_t reason = text.find(": ");
    const std::size_t end = text.find(". ", reason == std::string::npos ? 0 : reason);
    return end == std::string::npos ? InputError(where, text, "Correct it")
                                    : InputError(where, text.substr(0, end), text.substr(end + 2));
}

/// What make() returns; an InputError leaves with `where` in front.
template <class Make>
auto placed(const std::string& where, const Make& make) {
    try {
        return make();
    } catch (const InputError& error) {
        throw prefixed(where, error);
    }
}

}  // namespace hemoflux::apps

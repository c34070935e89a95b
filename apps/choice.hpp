/// Words of the case file as enumerators.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>

namespace hemoflux::apps {

/// The enumerator of a word; words stand in the order of the enumerators and are known to the schema.
template <class Enum>
Enum chosen(const std::string& word, std::initializer_list<const char*> words) {
    const auto found = std::find(words.begin(), words.end(), word);
    return static_cast<Enum>(found - words.begin());
}

}  // namespace hemoflux::apps

/// Which of several file formats the name of a file asks for.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <string>

#include "exchange/error.hpp"

namespace hemoflux::meshing {

/// The format whose `extension` is that of the path, capitals or not. InputError, which begins with `what` and ends with
/// the `known` extensions, when there is none.
template <class Format, std::size_t n>
const Format& choose_format(const std::filesystem::path& path, const Format (&formats)[n],
                            const std::string& what, const std::string& known) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const Format& format : formats)
        if (extension == format.extension) return format;
    throw InputError(what + " " + path.string(), fmt::format("its extension \"{}\" is not known", extension),
                     "Use " + known);
}

}  // namespace hemoflux::meshing

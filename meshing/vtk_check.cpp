#include "meshing/vtk_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string_view>

#include "meshing/format_error.hpp"

namespace hemoflux::meshing {
namespace {

/// What zlib packs at most into one byte; other compressors of VTK pack less.
constexpr std::uint64_t best_compression = 1032;
/// Components of one tuple; tensors have nine.
constexpr std::uint64_t most_components = 64;

/// The value of an attribute that counts something.
std::uint64_t count_of(std::string_view value, const char* name) {
    std::uint64_t n = 0;
    const auto first = value.find_first_not_of(" \t\r\n"), last = value.find_last_not_of(" \t\r\n");
    const std::string_view digits =
        first == std::string_view::npos ? value.substr(0, 0) : value.substr(first, last - first + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
    if (error != std::errc() || end != digits.data() + digits.size())
        throw FormatError(fmt::format("{}=\"{}\" is not a number of things", name, value.substr(0, 40)));
    return n;
}

/// Checks every attribute of this name in the markup.
void check_counts(std::string_view markup, const char* name, std::uint64_t most) {
    const std::string key = fmt::format("{}=", name);
    for (std::size_t at = markup.find(key); at != std::string_view::npos; at = markup.find(key, at)) {
        at += key.size();
        if (at >= markup.size() || (markup[at] != '"' && markup[at] != '\'')) continue;
        const std::size_t end = markup.find(markup[at], at + 1);
        if (end == std::string_view::npos) return;
        const std::uint64_t n = count_of(markup.substr(at + 1, end - at - 1), name);
        if (n > most)
            throw FormatError(fmt::format("it claims {}=\"{}\", more than its bytes can hold", name, n));
    }
}

}  // namespace

void check_vtk(const std::string& text, const std::string& type) {
    const std::size_t root = text.find("<VTKFile");
    if (root == std::string::npos) {
        std::string begin = text.substr(0, std::min<std::size_t>(text.find('\n'), 40));
        std::replace_if(
            begin.begin(), begin.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
        throw FormatError(fmt::format("it has no element <VTKFile>; line 1 begins with \"{}\"", begin));
    }
    const std::string_view head = std::string_view(text).substr(root, text.find('>', root) - root);
    if (head.find("type=\"" + type + "\"") == std::string_view::npos)
        throw FormatError(fmt::format("it is not a VTKFile of type {}", type));
    const std::size_t appended = text.find("<AppendedData");
    const std::string_view markup = std::string_view(text).substr(0, appended);
    const std::uint64_t bytes =
        text.size() * (head.find("compressor=") == std::string_view::npos ? 1 : best_compression);
    for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfPolys", "NumberOfVerts",
                             "NumberOfLines", "NumberOfStrips", "NumberOfTuples"})
        check_counts(markup, name, bytes);
    check_counts(markup, "NumberOfComponents", most_components);
}

}  // namespace hemoflux::meshing

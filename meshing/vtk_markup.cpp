#include "meshing/vtk_markup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "meshing/file_text.hpp"
#include "meshing/format_error.hpp"

namespace hemoflux::meshing {
namespace {

/// VTK's own files are five deep.
constexpr std::size_t deepest = 20;

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(blank), last = text.find_last_not_of(blank);
    return first == std::string_view::npos ? std::string_view() : text.substr(first, last - first + 1);
}

[[noreturn]] void malformed(std::string_view what, std::string_view where) {
    throw FormatError(fmt::format("its XML has {} at \"{}\"", what, shown(where)));
}

/// What stands between < and > as an element without content.
VtkElement element_of(std::string_view tag) {
    VtkElement element;
    std::size_t at = std::min(tag.find_first_of(blank), tag.size());
    element.name = tag.substr(0, at);
    for (std::string_view rest = trimmed(tag.substr(at)); !rest.empty();) {
        const std::size_t equal = rest.find('=');
        if (equal == std::string_view::npos) malformed("an attribute without value", rest);
        const std::string_view key = trimmed(rest.substr(0, equal));
        rest = trimmed(rest.substr(equal + 1));
        const std::size_t end = rest.empty() || (rest[0] != '"' && rest[0] != '\'') ? std::string_view::npos
                                                                                    : rest.find(rest[0], 1);
        if (end == std::string_view::npos) malformed("an attribute without quotes", rest);
        if (!element.attributes.emplace(key, rest.substr(1, end - 1)).second)
            malformed("an attribute twice", key);
        rest = trimmed(rest.substr(end + 1));
    }
    return element;
}

}  // namespace

std::string_view VtkElement::attribute(std::string_view key) const {
    const auto found = attributes.find(key);
    return found == attributes.end() ? std::string_view() : found->second;
}

std::uint64_t VtkElement::count(std::string_view key) const {
    std::uint64_t n = 0;
    const std::string_view value = attribute(key), digits = trimmed(value);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
    if (error != std::errc() || end != digits.data() + digits.size())
        throw FormatError(fmt::format("{}=\"{}\" is not a number of things", key, value.substr(0, 40)));
    return n;
}

std::uint64_t VtkElement::count(std::string_view key, std::uint64_t otherwise) const {
    return attributes.contains(key) ? count(key) : otherwise;
}

VtkElement vtk_markup(std::string_view text) {
    VtkElement all;  // holds the outermost
    std::vector<VtkElement> open;
    const auto close = [&] {
        VtkElement done = std::move(open.back());
        open.pop_back();
        (open.empty() ? all : open.back()).inside.push_back(std::move(done));
    };
    for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
        const std::string_view rest = text.substr(at);
        const bool comment = rest.starts_with("<!--");
        if (rest.starts_with("<!") && !comment) malformed("a declaration", rest);
        const std::string_view end_mark = comment ? "-->" : rest.starts_with("<?") ? "?>" : ">";
        const std::size_t end = rest.find(end_mark);
        if (end == std::string_view::npos) malformed("a tag without end", rest);
        at += end + end_mark.size();
        if (end_mark != ">") continue;
        std::string_view tag = rest.substr(1, end - 1);
        if (tag.starts_with('/')) {
            if (open.empty() || open.back().name != trimmed(tag.substr(1)))
                malformed("an end without begin", rest);
            close();
            continue;
        }
        const bool empty = tag.ends_with('/');
        if (empty) tag.remove_suffix(1);
        if (open.size() == deepest) malformed("elements too deep in others", rest);
        open.push_back(element_of(tag));
        open.back().text = text.substr(at, text.find('<', at) - at);
        if (empty) close();
    }
    while (!open.empty()) close();
    if (all.inside.size() != 1) throw FormatError("its XML has not one outermost element");
    return std::move(all.inside.front());
}

}  // namespace hemoflux::meshing

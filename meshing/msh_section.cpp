#include "meshing/msh_section.hpp"

#include <array>

namespace hemoflux::meshing {
namespace {

/// In the order in which gmsh needs them; physical names and comments may stand anywhere.
constexpr std::array<const char*, 5> in_order{"MeshFormat", "Entities", "Nodes", "Elements", "Periodic"};

/// The line that begins at `at`, without what ends it.
std::string_view line_at(std::string_view text, std::size_t at) {
    std::string_view line = text.substr(at, text.find('\n', at) - at);
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    return line;
}

}  // namespace

std::map<std::string, std::string_view> msh_sections(const std::string& text) {
    std::map<std::string, std::string_view> sections;
    std::size_t last = 0, at = 0;
    while ((at = text.find_first_not_of(blank, at)) != std::string::npos) {
        const std::string_view opening = line_at(text, at);
        if (opening[0] != '$' || (at > 0 && text[at - 1] != '\n'))
            throw FormatError(
                fmt::format("\"{}\" stands where a section should begin", opening.substr(0, 40)));
        const std::string name(opening.substr(1));
        const auto place = std::find(in_order.begin(), in_order.end(), name);
        if (place == in_order.end() && name != "PhysicalNames" && name != "Comments")
            throw FormatError(
                fmt::format("section ${} is not read; write the whole mesh, without partitions and "
                            "results, in one file",
                            name.substr(0, 40)));
        if (place != in_order.end()) {
            const auto rank = static_cast<std::size_t>(place - in_order.begin());
            if (rank < last)
                throw FormatError(fmt::format("section ${} stands behind ${}", name, in_order[last]));
            last = rank;
        }
        const std::size_t begin = std::min(text.find('\n', at), text.size());
        const std::string closing = "\n$End" + name;
        const std::size_t end = text.find(closing, begin);
        if (end == std::string::npos)
            throw FormatError(fmt::format("section ${0} has no end ($End{0})", name));
        const std::string_view inside =
            end == begin ? std::string_view() : std::string_view(text).substr(begin + 1, end - begin);
        if (!sections.emplace(name, inside).second)
            throw FormatError(fmt::format("section ${} is there twice", name));
        at = end + closing.size();
    }
    return sections;
}

}  // namespace hemoflux::meshing

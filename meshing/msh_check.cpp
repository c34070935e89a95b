#include "meshing/msh_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <unordered_set>

#include "meshing/msh_section.hpp"

namespace hemoflux::meshing {
namespace {

struct ElementType {
    std::size_t nodes;  ///< entry 0 of the table stands for no type
    long long dimension;
};

/// By the number in the format.
ElementType type_of(MshNumbers& in, long long type) {
    // lines, triangles, quadrangles, tetrahedra, hexahedra, prisms, pyramids, then those of second order, points
    constexpr std::array<ElementType, 20> types{{{0, 0},  {2, 1}, {3, 2}, {4, 2},  {4, 3},  {8, 3},  {6, 3},
                                                 {5, 3},  {3, 1}, {6, 2}, {9, 2},  {10, 3}, {27, 3}, {18, 3},
                                                 {14, 3}, {1, 0}, {8, 2}, {20, 3}, {15, 3}, {13, 3}}};
    if (type < 1 || type >= static_cast<long long>(types.size()))
        in.refuse(fmt::format("elements of type {} are not known", type));
    return types[static_cast<std::size_t>(type)];
}

using Tags = std::unordered_set<std::uint64_t>;
using Sections = std::map<std::string, std::string_view>;

void check_element(MshNumbers& in, std::uint64_t tag, std::uint64_t node, const Tags& nodes) {
    if (!nodes.contains(node))
        in.refuse(fmt::format("element {} names node {}, which is missing", tag, node));
}

long long check_dimension(MshNumbers& in, long long most) {
    const long long dimension = in.integer();
    if (dimension < 0 || dimension > most)
        in.refuse(fmt::format("an entity has the dimension {}", dimension));
    return dimension;
}

/// gmsh reads a count from its line and a name from the rest of one, up to 255 bytes.
void check_names(const Sections& sections, double version) {
    const auto found = sections.find("PhysicalNames");
    if (found == sections.end()) return;
    MshNumbers in(found->second, "PhysicalNames", false);
    const std::uint64_t names = in.count(in.size(), 4);
    in.end_line();
    for (std::uint64_t i = 0; i < names; ++i) {
        if (version > 2) check_dimension(in, 3);
        in.integer();
        const std::string_view name = in.line();
        const std::size_t open = name.find('"'), close = name.find('"', open + 1);
        if (name.size() > 250 || open == std::string_view::npos || close == std::string_view::npos ||
            name.find_first_not_of(" \t\r", close + 1) != std::string_view::npos ||
            std::any_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(close),
                        [](unsigned char c) { return c < ' ' && c != '\t'; }))
            in.refuse("a name is not between quotes, or is longer than 250 bytes");
    }
    in.end();
}

/// The entities there are, as 4 * tag + dimension.
Tags check_entities(const Sections& sections, bool binary) {
    Tags entities;
    const auto found = sections.find("Entities");
    if (found == sections.end()) return entities;
    MshNumbers in(found->second, "Entities", binary);
    std::array<std::uint64_t, 4> number{};
    for (std::uint64_t& n : number) n = in.count(in.size(), 4);
    const auto skip_tags = [&in] {
        for (std::uint64_t n = in.count(in.size(), 2); n > 0; --n) in.integer();
    };
    for (std::uint64_t dimension = 0; dimension < 4; ++dimension)
        for (std::uint64_t i = 0; i < number[dimension]; ++i) {
            const long long tag = in.integer();
            for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) in.real();
            skip_tags();                     // of physical groups
            if (dimension > 0) skip_tags();  // of the entities at its border
            if (tag < 1 || !entities.insert(4 * static_cast<std::uint64_t>(tag) + dimension).second)
                in.refuse(fmt::format("entity {} of dimension {} is there twice or is not positive", tag,
                                      dimension));
        }
    in.end();
    return entities;
}

Tags check_node_blocks(const Sections& sections, bool binary) {
    MshNumbers in(sections.at("Nodes"), "Nodes", binary);
    const std::uint64_t blocks = in.count(in.size(), 4), total = in.count(in.size(), 4);
    const std::uint64_t low = in.size(), high = in.size();
    Tags nodes;
    nodes.reserve(total);
    for (std::uint64_t b = 0; b < blocks; ++b) {
        const long long dimension = check_dimension(in, 3);
        in.integer();
        const long long parametric = in.integer();
        if (parametric < 0 || parametric > (dimension < 3 ? 1 : 0))
            in.refuse(fmt::format("parametric is {}", parametric));
        const std::uint64_t n = in.count(in.size(), 4);
        for (std::uint64_t i = 0; i < n; ++i) {
            const std::uint64_t tag = in.size();
            if (tag < low || tag > high || !nodes.insert(tag).second)
                in.refuse(fmt::format("node {} is there twice or outside {} .. {}", tag, low, high));
        }
        for (std::uint64_t i = 0; i < n * static_cast<std::uint64_t>(3 + parametric * dimension); ++i)
            in.real();
    }
    if (nodes.size() != total)
        in.refuse(fmt::format("{} nodes are there, {} are claimed", nodes.size(), total));
    // gmsh keeps a table up to the highest number
    if (high > 1000 * (total + 1000))
        in.refuse(fmt::format("the highest of {} nodes has number {}", total, high));
    in.end();
    return nodes;
}

void check_element_blocks(const Sections& sections, bool binary, const Tags& entities, const Tags& nodes) {
    MshNumbers in(sections.at("Elements"), "Elements", binary);
    const std::uint64_t blocks = in.count(in.size(), 4), all = in.count(in.size(), 4);
    in.size(), in.size();
    std::uint64_t found = 0;
    for (std::uint64_t b = 0; b < blocks; ++b) {
        const long long dimension = check_dimension(in, 3), entity = in.integer(), number = in.integer();
        const ElementType type = type_of(in, number);
        if (type.dimension != dimension)
            in.refuse(fmt::format("elements of type {} are on an entity of dimension {}", number, dimension));
        if (entity < 1 ||
            (!entities.empty() && !entities.contains(static_cast<std::uint64_t>(4 * entity + dimension))))
            in.refuse(fmt::format("entity {} of dimension {} is missing", entity, dimension));
        const std::uint64_t n = in.count(in.size(), 4);
        for (std::uint64_t e = 0; e < n; ++e, ++found) {
            const std::uint64_t tag = in.size();
            for (std::size_t k = 0; k < type.nodes; ++k) check_element(in, tag, in.size(), nodes);
            in.end_line();  // gmsh reads an element from its line
        }
    }
    if (found != all) in.refuse(fmt::format("{} elements are there, {} are claimed", found, all));
    in.end();
}

/// Pairs of nodes on periodic entities. MSH 2 writes them as text in binary files too.
void check_periodic(const Sections& sections, bool binary, bool lists, const Tags& entities,
                    const Tags& nodes) {
    const auto section = sections.find("Periodic");
    if (section == sections.end()) return;
    MshNumbers in(section->second, "Periodic", binary && !lists);
    const auto size = [&in, lists] { return lists ? static_cast<std::uint64_t>(in.integer()) : in.size(); };
    for (std::uint64_t links = in.count(size(), 4); links > 0; --links) {
        const long long dimension = check_dimension(in, 2);
        for (int side = 0; side < 2; ++side) {
            const long long entity = in.integer();
            if (!lists &&
                (entity < 1 || !entities.contains(static_cast<std::uint64_t>(4 * entity + dimension))))
                in.refuse(fmt::format("entity {} of dimension {} is missing", entity, dimension));
        }
        const std::uint64_t affine = lists ? (in.skip("Affine") ? 16 : 0) : in.size();
        if (affine != 0 && affine != 16) in.refuse(fmt::format("a transformation has {} numbers", affine));
        for (std::uint64_t k = 0; k < affine; ++k) in.real();
        const std::uint64_t pairs = in.count(size(), 4);
        if (lists && affine == 0 && pairs > 9999)  // gmsh keeps this word in five bytes
            in.refuse("it holds more than 9999 pairs of nodes without a transformation; write MSH 4.1");
        for (std::uint64_t k = 0; k < 2 * pairs; ++k) {
            const std::uint64_t node = size();
            if (!nodes.contains(node)) in.refuse(fmt::format("it names node {}, which is missing", node));
        }
    }
    in.end();
}

/// MSH 2.2: a list of nodes or elements; its count is a line of text in binary files too.
std::pair<std::uint64_t, MshNumbers> counted(const Sections& sections, const char* name, bool binary) {
    const std::string_view whole = sections.at(name);
    MshNumbers head(whole, name, false);
    const std::uint64_t n = head.count(head.size(), 4);
    head.end_line();
    MshNumbers in(binary ? whole.substr(whole.find('\n') + 1) : whole, name, binary);
    if (!binary) in.size();
    return {n, in};
}

Tags check_node_list(const Sections& sections, bool binary) {
    auto [total, in] = counted(sections, "Nodes", binary);
    Tags nodes;
    std::uint64_t high = 0;
    for (std::uint64_t i = 0; i < total; ++i) {
        const long long tag = in.integer();
        if (tag < 1 || !nodes.insert(static_cast<std::uint64_t>(tag)).second)
            in.refuse(fmt::format("node {} is there twice or is not positive", tag));
        high = std::max(high, static_cast<std::uint64_t>(tag));
        for (int k = 0; k < 3; ++k) in.real();
    }
    if (high > 1000 * (total + 1000))
        in.refuse(fmt::format("the highest of {} nodes has number {}", total, high));
    in.end();
    return nodes;
}

/// Physical group and entity; then the number of partitions (MSH 2.0: the partition) and those, which are not read.
void check_tags(MshNumbers& in, long long tags) {
    if (tags < 2) in.refuse(fmt::format("an element has {} tags instead of at least 2", tags));
    in.integer();
    const long long entity = in.integer();
    if (entity < 0) in.refuse(fmt::format("an element is on entity {}", entity));
    if (tags > 2 && (tags > 3 || in.integer() != 0))
        in.refuse(fmt::format("an element has {} tags, as of a mesh in partitions; write it whole", tags));
}

void check_element_list(const Sections& sections, bool binary, const Tags& nodes) {
    auto [all, in] = counted(sections, "Elements", binary);
    for (std::uint64_t found = 0; found < all;) {
        const long long tag_or_type = in.integer(), second = in.integer(), tags = in.integer();
        const std::size_t corners = type_of(in, binary ? tag_or_type : second).nodes;
        const long long follow = binary ? second : 1;
        if (follow < 1 || static_cast<std::uint64_t>(follow) > all - found)
            in.refuse(fmt::format("{} elements follow where {} are left", follow, all - found));
        for (long long e = 0; e < follow; ++e, ++found) {
            const long long number = binary ? in.integer() : tag_or_type;
            check_tags(in, tags);
            for (std::size_t k = 0; k < corners; ++k)
                check_element(in, static_cast<std::uint64_t>(number),
                              static_cast<std::uint64_t>(in.integer()), nodes);
        }
    }
    in.end();
}

}  // namespace

void check_msh(const std::string& text) {
    if (!text.starts_with("$MeshFormat")) throw FormatError("it does not begin with $MeshFormat");
    const Sections sections = msh_sections(text);
    MshNumbers in(sections.at("MeshFormat"), "MeshFormat", false);
    const double version = in.real();
    const long long binary = in.integer(), bytes = in.integer();
    if (version != 4.1 && version != 2.2 && version != 2)
        in.refuse(fmt::format("version {} is not read, write 4.1 or 2.2", version));
    if (binary < 0 || binary > 1 || bytes != 8)
        in.refuse(fmt::format("file type {} with numbers of {} bytes is not read", binary, bytes));
    in.end_line();
    if (binary == 0)
        in.end();
    else if (const std::string_view head = sections.at("MeshFormat");
             MshNumbers(head.substr(std::min(head.size(), head.find('\n') + 1)), "MeshFormat", true)
                 .integer() != 1)
        in.refuse("its bytes are in another order than this machine's");
    for (const char* needed : {"Nodes", "Elements"})
        if (!sections.contains(needed)) throw FormatError(fmt::format("it has no section ${}", needed));
    if (const auto comments = sections.find("Comments");
        comments != sections.end() && comments->second.find('$') != std::string_view::npos)
        throw FormatError("section $Comments holds a $, where gmsh sees another section");
    check_names(sections, version);
    if (version == 4.1) {
        const Tags entities = check_entities(sections, binary == 1),
                   nodes = check_node_blocks(sections, binary == 1);
        check_element_blocks(sections, binary == 1, entities, nodes);
        check_periodic(sections, binary == 1, false, entities, nodes);
    } else {
        const Tags nodes = check_node_list(sections, binary == 1);
        check_element_list(sections, binary == 1, nodes);
        check_periodic(sections, binary == 1, true, {}, nodes);
    }
}

}  // namespace hemoflux::meshing

#include "meshing/msh_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "meshing/format_error.hpp"

namespace hemoflux::meshing {
namespace {

/// Nodes of an element by its number in the format; 0: none of these is in a mesh of ours, nor read here.
std::size_t nodes_of_type(long long type) {
    // lines, triangles, quadrangles, tetrahedra, hexahedra, prisms, pyramids, then those of second order, points
    constexpr std::array<std::size_t, 20> nodes{0, 2,  3,  4,  4,  8, 6, 5,  3,  6,
                                                9, 10, 27, 18, 14, 1, 8, 20, 15, 13};
    return type >= 0 && static_cast<std::size_t>(type) < nodes.size() ? nodes[static_cast<std::size_t>(type)]
                                                                      : 0;
}

/// Takes numbers off a section, written as text or as bytes.
class Numbers {
  public:
    Numbers(std::string_view section, std::string name, bool binary)
        : all_(section), rest_(section), name_(std::move(name)), binary_(binary) {}

    [[noreturn]] void refuse(const std::string& why) const {
        const auto line =
            std::count(all_.begin(), all_.end() - static_cast<std::ptrdiff_t>(rest_.size()), '\n');
        throw FormatError(
            binary_ ? fmt::format("section ${}: {}", name_, why)
                    : fmt::format("section ${}, its line {}: {}", name_, std::max<long>(line, 1), why));
    }

    long long integer() { return binary_ ? bytes<std::int32_t>() : word<long long>(); }
    std::uint64_t size() { return binary_ ? bytes<std::uint64_t>() : word<std::uint64_t>(); }
    double real() {
        const double value = binary_ ? bytes<double>() : word<double>();
        if (!std::isfinite(value)) refuse("a coordinate is not a finite number");
        return value;
    }
    /// A number of things of which each takes at least `least` bytes.
    std::uint64_t count(std::uint64_t n, std::uint64_t least) const {
        if (n > rest_.size() / least + 1)
            refuse(fmt::format("it claims {} entries, more than the file holds", n));
        return n;
    }

  private:
    template <class T>
    T bytes() {
        if (rest_.size() < sizeof(T)) refuse("it breaks off");
        T value;
        std::memcpy(&value, rest_.data(), sizeof(T));
        rest_.remove_prefix(sizeof(T));
        return value;
    }
    template <class T>
    T word() {
        const std::size_t begin = rest_.find_first_not_of(" \t\r\n");
        if (begin == std::string_view::npos) refuse("it breaks off");
        rest_.remove_prefix(begin);
        const std::string_view text = rest_.substr(0, rest_.find_first_of(" \t\r\n"));
        T value{};
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size())
            refuse(fmt::format("\"{}\" is not a number", text.substr(0, 40)));
        rest_.remove_prefix(text.size());
        return value;
    }

    std::string_view all_, rest_;
    std::string name_;
    bool binary_;
};

/// What stands between $NAME and $EndNAME; empty where there is no such section.
std::string_view section(const std::string& text, const std::string& name, bool needed) {
    const std::string open = "$" + name, close = "$End" + name;
    std::size_t at = text.find(open);
    while (at != std::string::npos && at > 0 && text[at - 1] != '\n') at = text.find(open, at + 1);
    if (at == std::string::npos) {
        if (needed) throw FormatError("it has no section " + open);
        return {};
    }
    const std::size_t begin = text.find('\n', at), end = text.find(close, at);
    if (begin == std::string::npos || end == std::string::npos || end < begin)
        throw FormatError(fmt::format("section {} has no end ({})", open, close));
    return std::string_view(text).substr(begin + 1, end - begin - 1);
}

using Tags = std::unordered_set<std::uint64_t>;

void check_element(Numbers& in, std::uint64_t tag, std::uint64_t node, const Tags& nodes) {
    if (!nodes.contains(node))
        in.refuse(fmt::format("element {} names node {}, which is missing", tag, node));
}

std::size_t nodes_of(Numbers& in, long long type) {
    const std::size_t n = nodes_of_type(type);
    if (n == 0) in.refuse(fmt::format("elements of type {} are not known", type));
    return n;
}

/// MSH 4.1: blocks of nodes and of elements, one for each entity.
void check_blocks(const std::string& text, bool binary) {
    Numbers in(section(text, "Nodes", true), "Nodes", binary);
    const std::uint64_t blocks = in.count(in.size(), 4), total = in.count(in.size(), 4);
    const std::uint64_t low = in.size(), high = in.size();
    Tags nodes;
    nodes.reserve(total);
    for (std::uint64_t b = 0; b < blocks; ++b) {
        const long long dimension = in.integer();
        in.integer();
        const long long parametric = in.integer();
        if (dimension < 0 || dimension > 3)
            in.refuse(fmt::format("an entity has the dimension {}", dimension));
        if (parametric < 0 || parametric > 1) in.refuse(fmt::format("parametric is {}", parametric));
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

    Numbers elements(section(text, "Elements", true), "Elements", binary);
    const std::uint64_t element_blocks = elements.count(elements.size(), 4),
                        all = elements.count(elements.size(), 4);
    elements.size(), elements.size();
    std::uint64_t found = 0;
    for (std::uint64_t b = 0; b < element_blocks; ++b) {
        const long long dimension = elements.integer();
        elements.integer();
        if (dimension < 0 || dimension > 3)
            elements.refuse(fmt::format("an entity has the dimension {}", dimension));
        const std::size_t corners = nodes_of(elements, elements.integer());
        const std::uint64_t n = elements.count(elements.size(), 4);
        for (std::uint64_t e = 0; e < n; ++e, ++found) {
            const std::uint64_t tag = elements.size();
            for (std::size_t k = 0; k < corners; ++k) check_element(elements, tag, elements.size(), nodes);
        }
    }
    if (found != all) elements.refuse(fmt::format("{} elements are there, {} are claimed", found, all));
}

/// MSH 2.2: one list of nodes and one of elements; their counts are text in binary files too.
void check_lists(const std::string& text, bool binary) {
    const auto counted = [&](const char* name) {
        const std::string_view whole = section(text, name, true);
        Numbers head(whole, name, false);
        const std::uint64_t n = head.count(head.size(), 4);
        const std::size_t line = whole.find('\n');
        return std::pair(
            n,
            Numbers(binary ? whole.substr(line == std::string_view::npos ? whole.size() : line + 1) : whole,
                    name, binary));
    };
    auto [total, in] = counted("Nodes");
    if (!binary) in.size();
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

    auto [all, elements] = counted("Elements");
    if (!binary) elements.size();
    for (std::uint64_t found = 0; found < all;) {
        const long long tag_or_type = elements.integer(), second = elements.integer(),
                        third = elements.integer();
        const long long type = binary ? tag_or_type : second, follow = binary ? second : 1, tags = third;
        const std::size_t corners = nodes_of(elements, type);
        if (tags < 0 || tags > 1000) elements.refuse(fmt::format("an element has {} tags", tags));
        if (follow < 1 || static_cast<std::uint64_t>(follow) > all - found)
            elements.refuse(fmt::format("{} elements follow where {} are left", follow, all - found));
        for (long long e = 0; e < follow; ++e, ++found) {
            const long long number = binary ? elements.integer() : tag_or_type;
            for (long long t = 0; t < tags; ++t) elements.integer();
            for (std::size_t k = 0; k < corners; ++k)
                check_element(elements, static_cast<std::uint64_t>(number),
                              static_cast<std::uint64_t>(elements.integer()), nodes);
        }
    }
}

}  // namespace

void check_msh(const std::string& text) {
    if (!text.starts_with("$MeshFormat")) throw FormatError("it does not begin with $MeshFormat");
    const std::string_view format = section(text, "MeshFormat", true);
    Numbers in(format, "MeshFormat", false);
    const double version = in.real();
    const long long binary = in.integer(), bytes = in.integer();
    if (version != 4.1 && version != 2.2 && version != 2)
        in.refuse(fmt::format("version {} is not read, write 4.1 or 2.2", version));
    if (binary < 0 || binary > 1 || bytes != 8)
        in.refuse(fmt::format("file type {} with numbers of {} bytes is not read", binary, bytes));
    if (version == 4.1)
        check_blocks(text, binary == 1);
    else
        check_lists(text, binary == 1);
}

}  // namespace hemoflux::meshing

/// The elements of a VTK XML file, as far as its readers look at them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hemoflux::meshing {

/// An element with what is written in it. Views into the text it was read from.
struct VtkElement {
    std::string name;
    std::map<std::string, std::string_view, std::less<>> attributes;
    std::string_view text;  ///< up to the first tag inside, where VTK stops too
    std::vector<VtkElement> inside;

    /// Empty where there is no such attribute.
    [[nodiscard]] std::string_view attribute(std::string_view key) const;
    /// The value of an attribute that counts something; FormatError where it is no number, or missing without `otherwise`.
    [[nodiscard]] std::uint64_t count(std::string_view key) const;
    [[nodiscard]] std::uint64_t count(std::string_view key, std::uint64_t otherwise) const;
};

/// The outermost element. Elements may be left open at the end, which VTK closes before appended data. FormatError where the
/// text is not written as VTK writes: declarations of types, entities in numbers, tags that do not match.
VtkElement vtk_markup(std::string_view text);

}  // namespace hemoflux::meshing

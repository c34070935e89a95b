#include "meshing/vtk_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include "meshing/file_text.hpp"
#include "meshing/format_error.hpp"
#include "meshing/vtk_arrays.hpp"
#include "meshing/vtk_markup.hpp"

namespace hemoflux::meshing {
namespace {

/// Components of one tuple; tensors have nine.
constexpr std::uint64_t most_components = 64;

using Children = std::map<std::string, const VtkElement*, std::less<>>;

/// The checks of one file.
struct Checker {
    const VtkArrays& arrays;
    std::uint64_t most;  ///< things that the bytes of the file can hold

    /// The value of an attribute that counts things.
    std::uint64_t count(const VtkElement& element, const char* key, std::uint64_t otherwise) const {
        const std::uint64_t n = element.count(key, otherwise);
        if (n > most)
            throw FormatError(fmt::format("it claims {}=\"{}\", more than its bytes can hold", key, n));
        return n;
    }

    std::uint64_t components(const VtkElement& array) const {
        const std::uint64_t n = count(array, "NumberOfComponents", 1);
        if (n < 1 || n > most_components)
            throw FormatError(
                fmt::format("an array has {} components instead of 1 to {}", n, most_components));
        return n;
    }

    /// Named arrays of n tuples each; returns what is the same in all pieces.
    std::string data(const VtkElement& place, std::uint64_t n) const {
        std::string kinds;
        by_name(place);
        for (const VtkElement& array : place.inside) {
            arrays.check(array, n * components(array));
            kinds +=
                fmt::format("{} {} {};", array.attribute("Name"), array.attribute("type"), components(array));
        }
        return kinds;
    }

    /// Arrays by name, each name once.
    static Children by_name(const VtkElement& place) {
        Children named;
        for (const VtkElement& array : place.inside) {
            const std::string_view name = array.attribute("Name");
            if (array.name != "DataArray" && array.name != "Array")
                throw FormatError(
                    fmt::format("<{}> holds an element <{}>", place.name, array.name.substr(0, 40)));
            if (array.attributes.contains("TimeStep")) throw FormatError("it holds arrays of several times");
            if (!named.emplace(name, &array).second || name.empty())
                throw FormatError(fmt::format("<{}> holds two arrays \"{}\" or one without Name", place.name,
                                              name.substr(0, 40)));
        }
        return named;
    }

    void points(const VtkElement& place, std::uint64_t n) const {
        if (place.inside.size() != 1 || place.inside[0].name != "DataArray" ||
            components(place.inside[0]) != 3)
            throw FormatError("<Points> does not hold one array of 3 components");
        arrays.check(place.inside[0], 3 * n);
    }

    /// n cells of one piece: where each ends among the nodes, the nodes, and types where cells have some.
    void cells(const VtkElement& place, std::uint64_t n, bool types) const {
        const Children named = by_name(place);
        for (const auto& [name, array] : named)
            if (name != "connectivity" && name != "offsets" && (name != "types" || !types))
                throw FormatError(
                    fmt::format("<{}> holds an array \"{}\", as of polyhedra", place.name, name));
        if (n == 0) return;
        for (const char* name : {"connectivity", "offsets", "types"}) {
            if (!types && name == std::string_view("types")) continue;
            if (!named.contains(name))
                throw FormatError(fmt::format("<{}> has no array \"{}\"", place.name, name));
            if (components(*named.at(name)) != 1)
                throw FormatError(fmt::format("array \"{}\" has more than one component", name));
        }
        if (types) arrays.check(*named.at("types"), n);
        const std::vector<std::int64_t> offsets = arrays.integers(*named.at("offsets"), n);
        if (offsets.front() < 0 || !std::is_sorted(offsets.begin(), offsets.end()))
            throw FormatError("array \"offsets\" does not ascend from 0");
        const auto corners = static_cast<std::uint64_t>(offsets.back());
        if (corners > most)
            throw FormatError(fmt::format("its cells claim {} nodes, more than its bytes can hold", corners));
        static_cast<void>(arrays.integers(*named.at("connectivity"), corners));
    }

    /// Returns what is the same in all pieces.
    std::string piece(const VtkElement& piece, bool surface) const {
        static const std::map<std::string_view, const char*> surface_cells{{"Verts", "NumberOfVerts"},
                                                                           {"Lines", "NumberOfLines"},
                                                                           {"Strips", "NumberOfStrips"},
                                                                           {"Polys", "NumberOfPolys"}};
        static const std::map<std::string_view, const char*> volume_cells{{"Cells", "NumberOfCells"}};
        const auto& kinds = surface ? surface_cells : volume_cells;
        Children places;
        for (const VtkElement& place : piece.inside)
            if (!places.emplace(place.name, &place).second)
                throw FormatError(fmt::format("a piece holds <{}> twice", place.name.substr(0, 40)));
        const auto place = [&places](std::string_view name, std::uint64_t n) {
            const auto found = places.find(name);
            if (found != places.end()) return found->second;
            if (n > 0) throw FormatError(fmt::format("a piece has no <{}>", name));
            return static_cast<const VtkElement*>(nullptr);
        };
        const std::uint64_t nodes = count(piece, "NumberOfPoints", 0);
        if (const auto* found = place("Points", nodes)) points(*found, nodes);
        std::uint64_t all = 0;
        for (const auto& [name, key] : kinds) {
            const std::uint64_t n = count(piece, key, 0);
            if (const auto* found = place(name, n)) cells(*found, n, !surface);
            all += n;
        }
        std::string same;
        if (const auto* found = place("PointData", 0)) same += data(*found, nodes);
        same += '|';
        if (const auto* found = place("CellData", 0)) same += data(*found, all);
        return same;
    }

    void field(const VtkElement& place) const {
        for (const auto& [name, array] : by_name(place))
            arrays.check(*array, count(*array, "NumberOfTuples", 0) * components(*array));
    }
};

}  // namespace

void check_vtk(const std::string& text, const std::string& type) {
    const std::size_t root = text.find("<VTKFile");
    if (root == std::string::npos)
        throw FormatError(fmt::format("it has no element <VTKFile>; line 1 begins with \"{}\"", shown(text)));
    const std::size_t appended = std::min(text.find("<AppendedData"), text.size());
    const VtkElement file = vtk_markup(std::string_view(text).substr(0, appended));
    if (file.name != "VTKFile" || file.attribute("type") != type)
        throw FormatError(fmt::format("it is not a VTKFile of type {}", type));
    const VtkArrays arrays(file, std::string_view(text).substr(appended));
    const Checker check{arrays, text.size() * (file.attribute("compressor").empty() ? 1 : best_compression)};
    std::vector<std::string> pieces;
    for (const VtkElement& data : file.inside) {
        if (data.name == "FieldData") check.field(data);
        if (data.name != type) continue;
        if (data.attributes.contains("TimeValues")) throw FormatError("it holds arrays of several times");
        for (const VtkElement& part : data.inside) {
            if (part.name == "FieldData") check.field(part);
            if (part.name == "Piece") pieces.push_back(check.piece(part, type == "PolyData"));
        }
    }
    if (pieces.empty()) throw FormatError("it has no element <Piece>");
    if (std::any_of(pieces.begin(), pieces.end(), [&](const std::string& p) { return p != pieces[0]; }))
        throw FormatError("its pieces do not hold the same arrays");
}

}  // namespace hemoflux::meshing

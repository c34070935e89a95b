// PLY, STL and OBJ as CGAL reads and writes polygon soups.
#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <sstream>
#include <vector>

#include "meshing/surface_formats.hpp"

namespace hemoflux::meshing {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using Points = std::vector<Point>;
using Polygons = std::vector<std::vector<std::size_t>>;

SurfaceMesh mesh_of(const Points& points, const Polygons& polygons) {
    SurfaceMesh mesh;
    mesh.vertices.reserve(points.size());
    for (const Point& p : points) mesh.vertices.push_back({p.x(), p.y(), p.z()});
    mesh.triangles.reserve(polygons.size());
    for (std::size_t f = 0; f < polygons.size(); ++f) {
        if (polygons[f].size() != 3)
            throw FormatError(fmt::format("face {} has {} corners instead of 3", f, polygons[f].size()));
        Triangle triangle{};
        for (std::size_t i = 0; i < 3; ++i) {
            if (polygons[f][i] >= points.size())
                throw FormatError(
                    fmt::format("face {} names a vertex beyond the {} of the file", f, points.size()));
            triangle[i] = static_cast<int>(polygons[f][i]);
        }
        mesh.triangles.push_back(triangle);
    }
    return mesh;
}

template <class Reader>
SurfaceMesh parse(const std::string& text, const char* format, Reader reader) {
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    Points points;
    Polygons polygons;
    if (!reader(in, points, polygons))
        throw FormatError(fmt::format("it is not {} or breaks off after {} vertices and {} faces", format,
                                      points.size(), polygons.size()));
    return mesh_of(points, polygons);
}

template <class Writer>
std::string print(const SurfaceMesh& mesh, Writer writer) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(std::numeric_limits<double>::max_digits10);
    Points points;
    for (const Vec3d& p : mesh.vertices) points.emplace_back(p.x, p.y, p.z);
    Polygons polygons;
    for (const auto& [a, b, c] : mesh.triangles)
        polygons.push_back(
            {static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c)});
    writer(out, points, polygons);
    return out.str();
}

constexpr auto digits = [] {
    return CGAL::parameters::stream_precision(std::numeric_limits<double>::max_digits10);
};

// The reader takes a short binary file for an empty surface, so its length is compared with its count first.
void check_binary_stl(const std::string& text) {
    constexpr std::size_t header = 84, record = 50;
    if (text.compare(0, 5, "solid") == 0) return;
    std::uint32_t count = 0;
    if (text.size() >= header) std::memcpy(&count, text.data() + header - sizeof count, sizeof count);
    if (text.size() < header || text.size() < header + record * static_cast<std::size_t>(count))
        throw FormatError(
            fmt::format("it is neither text that begins with \"solid\" nor long enough for the {} "
                        "triangles of a binary STL file",
                        count));
}

}  // namespace

SurfaceMesh parse_ply(const std::string& text) {
    return parse(text, "PLY", [](auto& in, auto& points, auto& polygons) {
        return CGAL::IO::read_PLY(in, points, polygons, CGAL::parameters::verbose(false));
    });
}

SurfaceMesh parse_stl(const std::string& text) {
    check_binary_stl(text);
    return parse(text, "STL", [](auto& in, auto& points, auto& polygons) {
        return CGAL::IO::read_STL(in, points, polygons);
    });
}

SurfaceMesh parse_obj(const std::string& text) {
    return parse(text, "OBJ", [](auto& in, auto& points, auto& polygons) {
        return CGAL::IO::read_OBJ(in, points, polygons);
    });
}

std::string print_ply(const SurfaceMesh& mesh) {
    return print(mesh, [](auto& out, const auto& points, const auto& polygons) {
        CGAL::IO::write_PLY(out, points, polygons, digits());
    });
}

std::string print_stl(const SurfaceMesh& mesh) {
    return print(mesh, [](auto& out, const auto& points, const auto& polygons) {
        CGAL::IO::write_STL(out, points, polygons, digits());
    });
}

std::string print_obj(const SurfaceMesh& mesh) {
    return print(mesh, [](auto& out, const auto& points, const auto& polygons) {
        CGAL::IO::write_OBJ(out, points, polygons, digits());
    });
}

}  // namespace hemoflux::meshing

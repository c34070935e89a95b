#include "meshing/hex_io.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

#include "exchange/error.hpp"
#include "meshing/file_format.hpp"
#include "meshing/hex_formats.hpp"

namespace hemoflux::meshing {
namespace {

namespace fs = std::filesystem;

struct Format {
    const char* extension;
    HexMesh (*read)(const std::string&);
    void (*write)(const std::string&, const HexMesh&);
};

const Format& format_of(const fs::path& path) {
    static constexpr Format formats[] = {{".msh", read_msh, write_msh}, {".vtu", read_vtu, write_vtu}};
    return choose_format(path, formats, "mesh file", ".msh (gmsh) or .vtu (VTK)");
}

void check_readable(const fs::path& path) {
    const std::ifstream file(path, std::ios::binary);
    std::error_code error;
    if (!file)
        throw FileError("mesh file " + path.string(),
                        "it cannot be read: " + std::generic_category().message(errno),
                        "Check the path and its permissions");
    if (fs::is_directory(path, error))
        throw FileError("mesh file " + path.string(), "it is a folder", "Name a file in it");
}

/// Leaves out nodes of no cell, such as the centres of circles that gmsh keeps.
void drop_unused_nodes(HexMesh& mesh) {
    std::vector<std::uint32_t> number(mesh.nodes.size(), 0);
    for (const auto& cell : mesh.cells)
        for (const std::uint32_t n : cell) number[n] = 1;
    // a patch apart from the cells is for make_hex_grid to refuse
    for (const HexMesh::Patch& patch : mesh.patches)
        for (const auto& face : patch.faces)
            for (const std::uint32_t n : face) number[n] = 1;
    std::uint32_t used = 0;
    for (std::size_t i = 0; i < number.size(); ++i) {
        if (number[i] == 0) continue;
        mesh.nodes[used] = mesh.nodes[i];
        number[i] = used++;
    }
    mesh.nodes.resize(used);
    for (auto& cell : mesh.cells)
        for (std::uint32_t& n : cell) n = number[n];
    for (HexMesh::Patch& patch : mesh.patches)
        for (auto& face : patch.faces)
            for (std::uint32_t& n : face) n = number[n];
}

}  // namespace

std::string file_text(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (!in.is_open() || in.bad())
        throw FormatError("it cannot be read: " + std::generic_category().message(errno));
    return text;
}

void check_hex_extension(const fs::path& path) { format_of(path); }

HexMesh read_hex_mesh(const fs::path& path, double scale) {
    const Format& format = format_of(path);
    check_readable(path);
    HexMesh mesh;
    try {
        mesh = format.read(path.string());
        if (mesh.cells.empty()) throw FormatError("it holds no hexahedra");
    } catch (const FormatError& error) {
        throw InputError(
            "mesh file " + path.string(), error.what(),
            "Mesh the volume with hexahedra of 8 nodes (in gmsh: transfinite or extruded and recombined) "
            "and write it as MSH 4.1 or VTU");
    }
    drop_unused_nodes(mesh);
    return scale == 1 ? mesh : scaled(std::move(mesh), scale);
}

void write_hex_mesh(const fs::path& path, const HexMesh& mesh) {
    const Format& format = format_of(path);
    // beside the file and then renamed, so that nothing truncated stays behind and an older file is lost last
    const fs::path whole = path.parent_path() / fmt::format(".tmp-{}", path.filename().string());
    std::string why;
    {
        const std::ofstream file(whole, std::ios::binary);
        if (!file) why = std::generic_category().message(errno);
    }
    std::error_code error;
    try {
        if (why.empty()) format.write(whole.string(), mesh);
        if (why.empty()) fs::rename(whole, path, error);
        if (error) why = error.message();
    } catch (const FormatError& failed) {
        why = failed.what();
    }
    if (why.empty()) return;
    fs::remove(whole, error);
    throw FileError("mesh file " + path.string(), "it cannot be written: " + why,
                    "Check the folder, its permissions and the space left on the disk");
}

}  // namespace hemoflux::meshing

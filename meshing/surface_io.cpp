#include "meshing/surface_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "exchange/error.hpp"
#include "meshing/file_format.hpp"
#include "meshing/surface_formats.hpp"

namespace hemoflux::meshing {
namespace {

namespace fs = std::filesystem;

struct Format {
    const char* extension;
    SurfaceMesh (*parse)(const std::string&);
    std::string (*print)(const SurfaceMesh&);
};

const Format& format_of(const fs::path& path) {
    static constexpr Format formats[] = {{".vtp", parse_vtp, print_vtp},
                                         {".ply", parse_ply, print_ply},
                                         {".stl", parse_stl, print_stl},
                                         {".obj", parse_obj, print_obj}};
    return choose_format(path, formats, "surface file", ".vtp, .ply, .stl or .obj");
}

std::string reason_of(int error) { return std::generic_category().message(error); }

[[noreturn]] void unreadable(const fs::path& path, const std::string& reason) {
    throw FileError("surface file " + path.string(), "it cannot be read: " + reason,
                    "Check the path and its permissions");
}

[[noreturn]] void malformed(const fs::path& path, const std::string& reason) {
    throw InputError("surface file " + path.string(), "it is malformed: " + reason,
                     "Export the surface again, as triangles");
}

std::string text_of(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) unreadable(path, reason_of(EISDIR));
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in) unreadable(path, reason_of(errno));
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (in.bad()) unreadable(path, reason_of(errno));
    return text;
}

bool finite(const Vec3d& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

SurfaceMesh read_surface(const fs::path& path) {
    const Format& format = format_of(path);
    const std::string text = text_of(path);
    if (text.empty()) malformed(path, "it is empty");
    SurfaceMesh mesh;
    try {
        mesh = format.parse(text);
    } catch (const std::exception& error) {  // FormatError, or what a library throws at absurd sizes
        malformed(path, error.what());
    }
    if (mesh.triangles.empty()) malformed(path, "it has no triangles");
    const auto bad = std::find_if_not(mesh.vertices.begin(), mesh.vertices.end(), finite);
    if (bad != mesh.vertices.end())
        malformed(path,
                  fmt::format("the coordinates of vertex {} are not finite", bad - mesh.vertices.begin()));
    return mesh;
}

void write_surface(const fs::path& path, const SurfaceMesh& mesh) {
    const std::string text = format_of(path).print(mesh);
    // beside the file and then renamed, so that nothing truncated stays behind; a device or pipe is written as it is
    std::error_code ignored;
    const bool there = fs::exists(path, ignored);
    const fs::path target = there ? fs::canonical(path, ignored) : path;
    const bool straight = there && !fs::is_regular_file(target, ignored);
    const fs::path whole =
        straight ? target : target.parent_path() / fmt::format(".{}.tmp", target.filename().string());
    errno = 0;
    std::ofstream out(whole, std::ios::binary);
    if (out) out.write(text.data(), static_cast<std::streamsize>(text.size())).flush();
    std::error_code error(out ? 0 : errno != 0 ? errno : EIO, std::generic_category());
    out.close();
    if (!error && !straight) fs::rename(whole, target, error);
    if (!error) return;
    if (!straight) fs::remove(whole, ignored);
    throw FileError("surface file " + path.string(), "it cannot be written: " + error.message(),
                    "Check that the folder exists, is writable and has space left");
}

}  // namespace hemoflux::meshing

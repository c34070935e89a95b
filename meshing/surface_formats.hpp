/// One parser and one printer per surface file format, working on the text of a file; see surface_io.hpp.
#pragma once

#include <string>

#include "meshing/format_error.hpp"
#include "meshing/surface_mesh.hpp"

namespace hemoflux::meshing {

/// What the text of a file holds. FormatError where it is malformed; indices and coordinates are not yet
/// checked.
SurfaceMesh parse_vtp(const std::string& text);
SurfaceMesh parse_ply(const std::string& text);
SurfaceMesh parse_stl(const std::string& text);
SurfaceMesh parse_obj(const std::string& text);

/// The text of a file that holds the surface.
std::string print_vtp(const SurfaceMesh& mesh);
std::string print_ply(const SurfaceMesh& mesh);
std::string print_stl(const SurfaceMesh& mesh);
std::string print_obj(const SurfaceMesh& mesh);

}  // namespace hemoflux::meshing

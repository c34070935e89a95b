/// Triangulated surfaces in files: VTP (VTK), PLY, STL and OBJ, chosen by the extension of the file name.
#pragma once

#include <filesystem>

#include "meshing/surface_mesh.hpp"

namespace hemoflux::meshing {

/// Reads a surface (coordinates taken as um). Coincident vertices of STL, which knows triangles only, are
/// merged where their coordinates are equal. InputError that names file and reason for a malformed file, an
/// unknown extension or faces with other than three corners; FileError if the file cannot be read. Whether
/// the surface is closed and so on is for check_surface to say.
SurfaceMesh read_surface(const std::filesystem::path& path);

/// Writes a surface with all digits of its coordinates: VTP with binary data, the others as text. STL keeps
/// no vertex numbers. InputError for an unknown extension, FileError if the file cannot be written.
void write_surface(const std::filesystem::path& path, const SurfaceMesh& mesh);

}  // namespace hemoflux::meshing

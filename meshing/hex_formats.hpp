/// One reader and one writer per file format of hexahedral meshes; see hex_io.hpp.
#pragma once

#include <string>

#include "meshing/format_error.hpp"
#include "meshing/hex_mesh.hpp"

namespace hemoflux::meshing {

/// What a file holds, with all its nodes. FormatError where it is malformed or holds other cells than hexahedra.
HexMesh read_msh(const std::string& file);
HexMesh read_vtu(const std::string& file);

/// The whole content of a file. FormatError when it cannot be read.
std::string file_text(const std::string& file);

/// FormatError where the file cannot be written.
void write_msh(const std::string& file, const HexMesh& mesh);
void write_vtu(const std::string& file, const HexMesh& mesh);

}  // namespace hemoflux::meshing

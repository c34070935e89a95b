/// Meshes of hexahedra in files: gmsh's MSH 4.1 (.msh) and VTK's unstructured grids (.vtu), chosen by the extension.
///
/// MSH: hexahedra of 8 nodes; the physical groups of dimension 2 (quadrilaterals) are the patches, with the names
/// given in gmsh, or their numbers where they have none. Older versions of MSH that gmsh knows are read as well.
///
/// VTU: VTK_HEXAHEDRON cells, and the border as VTK_QUAD cells. The cell array `patch` (integers) gives the number of
/// each quadrilateral's patch; its value on hexahedra is ignored. The field array `patch_names` (strings) holds the
/// name of patch 0, 1, ...; without it a patch is named by its number. `gmsh:physical`, as meshio writes it, is
/// taken where there is no `patch`.
#pragma once

#include <filesystem>

#include "meshing/hex_mesh.hpp"

namespace hemoflux::meshing {

/// Reads a mesh and multiplies its lengths by `scale`: um per unit of length of the file. Nodes that no hexahedron
/// uses are left out. InputError that names file and reason for an unknown extension, a malformed file, cells other
/// than hexahedra of 8 nodes, or none; FileError if it cannot be opened. Whether cells and patches fit together is
/// for make_hex_grid to say.
HexMesh read_hex_mesh(const std::filesystem::path& path, double scale = 1);

/// InputError unless the extension is one that read_hex_mesh and write_hex_mesh know.
void check_hex_extension(const std::filesystem::path& path);

/// Writes a mesh with all digits (binary). InputError for an unknown extension, FileError if it cannot be written.
void write_hex_mesh(const std::filesystem::path& path, const HexMesh& mesh);

}  // namespace hemoflux::meshing

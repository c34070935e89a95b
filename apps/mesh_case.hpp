/// The mesh of a case: read from its file or generated, with the pairs of periodic patches.
#pragma once

#include "apps/case.hpp"
#include "meshing/hex_grid.hpp"

namespace hemoflux::apps {

/// The mesh that grid.mesh describes, lengths in um. Throws InputError, FileError.
meshing::HexMesh make_mesh(const MeshInput& in);

/// Its face-based grid, periodic patches glued.
meshing::HexGrid make_hex_grid(const Case& c, const meshing::HexMesh& mesh);

}  // namespace hemoflux::apps

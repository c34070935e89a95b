/// Gluing two patches of a mesh of hexahedra face to face.
#pragma once

#include "meshing/hex_topology.hpp"

namespace hemoflux::meshing {

/// Joins the sides of patch pair.low to those of pair.high, which must be the same faces moved by one
/// translation (their nodes agree to 1e-4 of the face's size), and takes both patches off the border.
/// InputError otherwise.
void glue(const HexMesh& mesh, const PeriodicPair& pair, HexTopology& topology);

}  // namespace hemoflux::meshing

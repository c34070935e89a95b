/// Where a closed surface passes through itself.
#pragma once

#include <array>
#include <vector>

#include "meshing/surface_mesh.hpp"

namespace hemoflux::meshing {

/// Pairs of triangles that intersect other than in a common vertex or edge, ascending; found with exact
/// predicates. Every edge of the mesh must have exactly two triangles, and every vertex one fan.
std::vector<std::array<int, 2>> self_intersections(const SurfaceMesh& mesh);

}  // namespace hemoflux::meshing

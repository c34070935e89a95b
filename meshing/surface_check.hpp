/// Checks that a surface can be a membrane or a body: closed, 2-manifold, oriented outward, free of
/// self-intersection.
#pragma once

#include <cstddef>
#include <string>

#include "meshing/surface_mesh.hpp"

namespace hemoflux::meshing {

/// Fewest vertices of a cell mesh: the first icosphere.
inline constexpr std::size_t smallest_cell_mesh = 42;

/// Refuses a mesh that is not a single closed, 2-manifold, outward oriented surface without
/// self-intersection, or that has vertices without triangles, triangles without area or fewer vertices than
/// asked for. The InputError begins with name (a file or shape), names the first offending vertices, edges or
/// triangles (numbered from 0) with their number, and the remedy.
void check_surface(const SurfaceMesh& mesh, const std::string& name,
                   std::size_t fewest_vertices = smallest_cell_mesh);

}  // namespace hemoflux::meshing

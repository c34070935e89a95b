/// Icosphere: the flat faces of an icosahedron are divided at their edge midpoints, level after level, and
/// the vertices are projected once onto the sphere: 10 4^level + 2 vertices, twelve of them with five edges,
/// the others with six.
///
/// Projecting once, not at every level, is part of the method: the bending energies of the sphere depend on
/// it.
#pragma once

#include <vector>

#include "meshing/surface_mesh.hpp"

namespace hemoflux::meshing {

/// Finest level: 40962 vertices.
inline constexpr int icosphere_max_level = 6;

/// The icosphere of a level (0: the icosahedron with 12 vertices, 1: 42, 2: 162, 3: 642, 4: 2562, 5: 10242,
/// 6: 40962) around the origin; radius in um. Vertices keep their numbers from level to level; 0 to 11 are
/// the five-fold ones. InputError unless 0 <= level <= 6 and radius > 0.
SurfaceMesh icosphere(int level, double radius);

/// The level with this number of vertices, from 42 (1) to 40962 (6). InputError that names the possible
/// numbers.
int icosphere_level(int nodes);

/// Unit vectors from the origin to the vertices of a mesh around the origin. InputError if a vertex lies at
/// the origin.
std::vector<Vec3d> directions(const SurfaceMesh& sphere);

}  // namespace hemoflux::meshing

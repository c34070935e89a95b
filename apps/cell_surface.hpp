/// The surface of a cell as its input describes it, before any relaxation.
#pragma once

#include "apps/case.hpp"
#include "membrane/reference.hpp"
#include "meshing/surface_mesh.hpp"

namespace hemoflux::apps {

/// The unit sphere mesh that analytic shapes are mapped from: an icosphere, or the directions of the vertices
/// of a mesh file around its centroid. Throws InputError (checked: closed, manifold, outward, 42 nodes) and
/// FileError.
meshing::SurfaceMesh sphere_mesh(const CellInput& cell);

/// The shape at the start, um, about the origin with its axis along z. For CellShape::discocyte the
/// Evans-Fung disc of area A0, from which it is relaxed; for CellShape::file the checked surface, its
/// centroid moved to the origin.
meshing::SurfaceMesh start_shape(const CellInput& cell);

/// Rest values of the whole cell. Where the input leaves them to the program: A0 and V0 of a file are those of
/// its surface, of other shapes 134 um^2 and the volume of a red blood cell's reduced volume at that area; c0
/// = 6, M0 = 8 pi R0, r = 2.6. Throws as start_shape().
membrane::RestState rest_state(const CellInput& cell);

/// Turns the z axis onto `axis` (shortest way) and moves the origin to `position` (um).
void place(meshing::SurfaceMesh& mesh, const Triple& axis, const Triple& position);

/// How many grid cells lie across the thinnest part of a surface.
struct ThinnestPart {
    double thickness = 0;   ///< um, along the inward normal of a vertex
    double grid_cells = 0;  ///< thickness over the width of the local grid cell in that direction
    Vec3d where{};          ///< the vertex
};

/// The part of `surface` with the fewest grid cells across. A bounded sample of vertices is examined.
ThinnestPart thinnest_part(const meshing::SurfaceMesh& surface, const meshing::RectilinearGrid& grid);

}  // namespace hemoflux::apps

/// A cube paved with quadrilaterals that follow no rows, drawn out in layers: unstructured, fine at the walls.
///
/// gmsh triangulates the square x-y (frontal Delaunay) for the cell width
///
///   h(d) = h_c [w + (1 - w) (1 - (1 - 2 d / L)^2)],   d the distance to the nearest wall,
///
/// and joins triangles to quadrilaterals only (Blossom, full-quad). Then every inner node moves to the mean of its
/// neighbours, which evens out the mesh and cannot fold a cell in the limit (Tutte 1963). The layers in z have the
/// widths h. h_c follows from the number of cells asked for.
#pragma once

#include "meshing/hex_mesh.hpp"

namespace hemoflux::meshing {

/// Size and resolution of a cubic cavity.
struct CavityShape {
    double edge = 10;   ///< L
    int cells = 90480;  ///< about
    double wall = 0.6;  ///< w: width of cells at a wall over that in the middle, 0.1 .. 1
};

/// A cube centred at the origin with the patches x-, x+, y-, y+, z-, z+, within 3 % of the number of cells from 3000
/// on. InputError where a parameter is out of range or gmsh fails.
HexMesh cavity_mesh(const CavityShape& shape);

}  // namespace hemoflux::meshing

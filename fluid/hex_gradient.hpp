/// Gradients at the cell centres of an unstructured grid (A.4). Every method is a weighted sum of the differences to the
/// six neighbours, so that the weights w_j are computed once:
///
///   grad phi_i = sum_j w_j (phi_j - phi_i)
///   Green-Gauss          w_j = alpha_j S_j n_j / V_i,   alpha_j = d_k / d_j
///   least squares        w_j = M^-1 omega_j dr_j,       M = sum_j omega_j dr_j dr_j^T                   (A.32)
///   hybrid (GLSQ)        w_j = A^-1 [beta omega_j dr_j + (1 - beta) S_j n_j],
///                        A = beta M + (1 - beta) sum_j S_j n_j dr_j^T                                   (A.29)
///   omega_j = 4 (d_k / d_j)^2 S_j / |dr_j|,  d_k = (r_k - r_i).n_j,  d_j = dr_j.n_j,  dr_j = r_j - r_i  (A.33, A.34)
///   beta = min(1, 2 / AR),  AR = 2 max |dr_j| max S_j / V_i                                             (A.30, A.31)
///
/// In (A.29) the print has V_i I in place of the last sum of A, which is exact for linear fields on undistorted cells
/// only; as written here least squares and the hybrid are exact for them on any cell. On a rectilinear grid least
/// squares gives the differences of fluid/grid.hpp.
#pragma once

#include <vector>

#include "fluid/gradient_method.hpp"
#include "meshing/hex_grid.hpp"

namespace hemoflux::fluid {

/// Faces of a hexahedron.
inline constexpr std::size_t hex_sides = 6;

/// What lies across one face of a cell.
struct HexNeighbour {
    std::uint32_t cell;  ///< number of the neighbour, or of the ghost cell
    std::uint32_t face;  ///< number of the face
    double outward;      ///< +1 where the area vector of the face points out of the cell, else -1
    Vec3d offset;        ///< from the centre of the cell to that of the neighbour
    Vec3d reach;         ///< from the centre of the cell to that of the face
};

/// Centres of the ghost cells, one per border face: the border cell's centre mirrored at the plane of the face.
std::vector<Vec3d> ghost_centres(const meshing::HexGrid& grid);

/// The six neighbours of all cells, 6 a cell, in the order of the grid's lists of faces.
std::vector<HexNeighbour> hex_neighbours(const meshing::HexGrid& grid);

/// Weights w_j of all cells, [cell][neighbour][x, y, z]. InputError where a cell is so distorted that its gradient is not
/// defined (its number in the mesh is named).
std::vector<double> gradient_weights(const meshing::HexGrid& grid,
                                     const std::vector<HexNeighbour>& neighbours, GradientMethod method);

}  // namespace hemoflux::fluid

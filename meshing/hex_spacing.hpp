/// How far the lattice of a face may stream.
///
///   delta = min over both cells, over the other faces g of each and over the D3Q15 directions e that do not
///           leave the cell through the face itself, of   (r_g - r_f) . n_g / (e . n_g)   where e . n_g > 0
///
/// Then all nodes r_f - e delta lie inside the two cells: h/2 on a grid of cubes, the smaller width across the
/// face or half a lateral width on a rectilinear grid. A direction in which the cell is the only one across the
/// domain (both its faces on the border, or one periodic face) has no variation to resolve and does not limit
/// delta, unless every direction is so.
#pragma once

#include <array>
#include <span>

#include "meshing/face_frame.hpp"

namespace hemoflux::meshing {

/// A face of a cell that may limit delta: its centre and outward unit normal.
struct Limit {
    Vec3d centre, normal;
};

/// Largest delta within one cell, for the face with this centre and frame, whose normal points into the cell where
/// inward is +1 and out of it where it is -1. Infinite when nothing limits it. Where the face centre is not in
/// front of a limit (a cell that is not convex) delta is at least 1/20 of the distance of cell_centre from the
/// face.
double largest_delta(const Vec3d& face_centre, const FaceFrame& frame, int inward, const Vec3d& cell_centre,
                     std::span<const Limit> limits);

}  // namespace hemoflux::meshing

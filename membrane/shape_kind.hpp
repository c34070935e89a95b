/// What kind of cell a shape is, in the sequence from stomatocyte to echinocyte (Bessis).
#pragma once

#include <vector>

#include "membrane/topology.hpp"

namespace hemoflux::membrane {

/// Kinds of cells in the sequence of Bessis.
enum class ShapeKind { stomatocyte, discocyte, echinocyte, other };

/// What tells them apart.
struct ShapeSigns {
    ShapeKind kind = ShapeKind::other;
    int spicules = 0;      ///< vertices more curved than all others within two edges, with C R_A > 8
    double asymmetry = 0;  ///< distance of the centroids of surface and volume along the short axis, over R_A
    double dimple = 0;     ///< 1 - centre thickness over greatest thickness
};

/// R_A is the radius of the sphere of the cell's area. Six spicules make an echinocyte; else an asymmetry of
/// 0.02 a stomatocyte; else a dimple of 0.1 a discocyte.
ShapeSigns shape_signs(const Topology& topology, const std::vector<Vec3d>& positions,
                       const std::vector<double>& curvature);

}  // namespace hemoflux::membrane

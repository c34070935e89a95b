/// Circular pipes along x, straight or with a smooth constriction. The cross-section is an O-grid of five blocks: a
/// square of n x n cells with bulging sides, its corners at 0.45 sqrt(2) R from the axis, and four blocks of n x m
/// cells between it and the wall.
///
///   R(x) = D/2 [1 - s/2 (1 + cos(2 pi (x - x_0) / l))]   for |x - x_0| <= l / 2,   else D/2
///
/// with s the part of the radius that the throat takes away, l its length and x_0 its place; every cross-section is
/// the same mesh scaled by R(x).
#pragma once

#include "meshing/hex_mesh.hpp"

namespace hemoflux::meshing {

/// Lengths but the diameter are in diameters.
struct PipeShape {
    double diameter = 1;       ///< D
    double length = 4;         ///< from x = 0
    int cells = 20000;         ///< about
    double wall = 0.4;         ///< width of the cells at the wall over that in the middle, 0.1 .. 1
    double constriction = 0;   ///< s: 0 (straight) .. 0.8
    double throat_length = 2;  ///< l
    double throat = 2;         ///< x_0
};

/// Patches: inlet (x = 0), outlet, wall. InputError where a parameter is out of range.
HexMesh pipe_mesh(const PipeShape& shape);

}  // namespace hemoflux::meshing

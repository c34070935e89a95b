/// Far field around a circular cylinder whose axis is z: an O-grid of one sheet of cells, smooth in both directions.
///
///   r(j)      = D/2 + w sinh(k j),  j = 0 .. N_r,   w sinh k = first height,  r(N_r) = R
///   theta(i)  = s - a(r) sin s,  s = 2 pi i / N_theta,   a(r) = a q^2 / (1 + q^2),  q = (r - D/2) / (2 D)
///
/// so that cells are equal around the cylinder and gather in the wake (theta = 0, downstream) away from it. All
/// spacings are values of smooth functions: `scale` refines a mesh into one of the same family, as the observed
/// order of accuracy needs.
#pragma once

#include "meshing/hex_mesh.hpp"

namespace hemoflux::meshing {

/// Lengths in the unit of the diameter (um in the program).
struct CylinderShape {
    double diameter = 1;
    double radius = 50;          ///< of the far field, in diameters, from the axis
    double thickness = 1;        ///< of the sheet, in diameters
    int cells = 23040;           ///< about; N_theta / N_r is 0.71
    double first_height = 0.05;  ///< of the cells on the cylinder, in diameters
    double scale = 1;            ///< multiplies the first height and divides both numbers of cells
    double wake = 0.7;           ///< a: how strongly cells gather in the wake, 0 .. 0.9
};

/// Patches: cylinder; of the far circle the inlet (|theta| > 135 degrees), far (between) and the outlet (|theta| < 45
/// degrees); z-, z+. InputError where a parameter is out of range or the first height does not reach the far field
/// with so few cells.
HexMesh cylinder_mesh(const CylinderShape& shape);

}  // namespace hemoflux::meshing

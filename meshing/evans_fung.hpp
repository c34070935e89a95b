/// Evans-Fung disc: the rest shape of a red blood cell (Evans and Fung 1972).
///
///   z = +- D (1 - 4 rho^2/D^2)^{1/2} (a0 + a1 rho^2/D^2 + a2 rho^4/D^4),  rho^2 = x^2 + y^2 (6.44)
///
/// with D = 7.82 um, a0 = 0.0518, a1 = 2.0026, a2 = -4.491: area 134.1 um^2, volume 94.1 um^3.
#pragma once

#include "meshing/surface_mesh.hpp"

namespace hemoflux::meshing {

/// Diameter of the average human red blood cell, um.
inline constexpr double evans_fung_diameter = 7.82;
/// Area of the disc of that diameter, um^2.
inline constexpr double evans_fung_area = 134.1;

/// Thickness 2 |z| of the disc at distance rho from its axis (um); 0 outside the rim.
double evans_fung_thickness(double rho, double diameter = evans_fung_diameter);

/// Maps a sphere mesh around the origin onto the disc: the direction n of a vertex goes to x = D n_x / 2, y =
/// D n_y / 2 and z of (6.44) on the side of n_z. The axis is z. InputError unless diameter > 0 (um).
SurfaceMesh evans_fung(const SurfaceMesh& sphere, double diameter = evans_fung_diameter);

}  // namespace hemoflux::meshing

/// Elastic moduli of a flat sheet: in closed form from the parameters, and measured on a mesh.
///
/// Small strains of a flat sheet cost, per area, K/2 (e_xx + e_yy)^2 + mu/2 [(e_xx - e_yy)^2 + 4 e_xy^2];
/// uniaxial tension meets Young's modulus Y = 4 K mu/(K + mu) and Poisson's ratio (K - mu)/(K + mu).
///   mu = K_S,   K = K_law + K_A,k,   K_law = 2 K_S (springs), 3 K_S (neo-Hookean), (1 + 2 C) K_S (Skalak).
/// The global area modulus K_A is left out: it belongs to a closed cell.
///
/// The mesh is a pillow, two regular hexagons of equilateral triangles sewn together along their border. Every
/// triangle has one edge in each of the three directions, so that its energy under a homogeneous deformation
/// is that of an infinite sheet, without any effect of the border.
#pragma once

#include "membrane/batch.hpp"
#include "meshing/surface_mesh.hpp"

namespace hemoflux::membrane {

/// Moduli of a flat sheet, 1e-5 N/m, and Poisson's ratio.
struct SheetModuli {
    double shear = 0, area = 0, young = 0, poisson = 0;
};

/// Closed form. InputError when the parameters are wrong.
SheetModuli sheet_moduli(const Parameters& parameters);

/// Flat pillow in the plane z = 0 about the origin: `rings` >= 1 rings of triangles of the given edge (um).
meshing::SurfaceMesh flat_pillow(int rings, double edge);

/// A batch of one flat pillow at rest, with the in-plane terms of the parameters only: law and K_A,k.
Batch flat_sheet(const Parameters& parameters, int rings, double edge,
                 double stretch_ratio = red_blood_cell::stretch_ratio);

/// Second differences of the energy of flat_sheet(). Young's modulus and Poisson's ratio are those of the
/// energy minimised over the lateral strain. InputError when the parameters are wrong.
SheetModuli measured_moduli(const Parameters& parameters, int rings = 4, double edge = 0.25,
                            double stretch_ratio = red_blood_cell::stretch_ratio);

}  // namespace hemoflux::membrane

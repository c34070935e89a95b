/// The preconditioning parameter gamma by the strategy of Table 4.1, with its reasons.
///
///   gamma = 2 Ma, the optimum of Izquierdo, Ma = U / c_s                                            (step 1)
///   Gamma_vc = C Lambda_v / Lambda_c of a cell at rest; 8 Ma N / (gamma Re) for cubes of edge L/N   (4.16), (4.17)
///   gamma is raised until Gamma_vc <= 1 at the most common cell size, at most to 1                  (steps 2 to 5)
///
///   condition number as the tables have it: 1 + gamma / Ma                                          (4.14)
///   and by the corrected eigenvalues [u +- sqrt(u^2 (1 - gamma) + gamma^2 c_s^2)] / gamma, u / gamma: largest over
///   smallest magnitude.
///
/// Gamma_vc is proportional to 1/gamma, so the gamma that makes it 1 is its value at gamma = 1.
#pragma once

#include <string>
#include <vector>

#include "exchange/vec3.hpp"
#include "meshing/hex_grid.hpp"
#include "meshing/rectilinear.hpp"

namespace hemoflux::fluid {

/// Volume of a cell and its areas projected along x, y and z (2.58); a direction one cell thick has none.
struct CellShape {
    double volume;
    Vec3d projection;
};

/// Shapes of all cells of a grid.
std::vector<CellShape> cell_shapes(const meshing::RectilinearGrid& grid);
std::vector<CellShape> cell_shapes(const meshing::HexGrid& grid);

/// Edge of the cube with the same ratio of the viscous to the convective radius, C Lambda_v / Lambda_c by (2.56) to (2.58):
/// V sum_a S_a / sum_a S_a^2.
double equivalent_edge(const CellShape& cell);
/// 1 + gamma / Ma (4.14).
double condition_number(double gamma, double mach);
/// Largest over smallest magnitude of the corrected eigenvalues at the speed U = Ma c_s.
double corrected_condition_number(double gamma, double mach);

/// Cells whose equivalent edge lies in [low, high).
struct SizeBin {
    double low, high;
    std::size_t count;
};

/// What gamma is chosen from.
struct PreconditioningInput {
    double speed = 0;      ///< reference speed U (c = 1)
    double nu = 0;         ///< kinematic viscosity
    double tau_floor = 0;  ///< floor of tau - 1/2; 0: none
    double gamma = 0;      ///< the user's choice; 0: choose
};

/// gamma and what speaks for it.
struct PreconditioningChoice {
    double gamma = 1, mach = 0;
    double condition = 0, corrected_condition = 0;
    double common_size = 0;                      ///< most common equivalent edge: median of the fullest bin
    double common_ratio = 0, largest_ratio = 0;  ///< Gamma_vc there, and of the finest cell
    double viscous_share = 0;                    ///< share of the cells with Gamma_vc > 1
    double delta_max = 0;                        ///< 3 nu / (gamma tau_floor); 0 without a floor
    std::vector<SizeBin> histogram;              ///< bins a factor 2^(1/4) wide
    std::string reasoning;                       ///< lines to print
};

/// Throws InputError when speed or viscosity is not positive, or the user's gamma is outside (0, 1].
PreconditioningChoice choose_preconditioning(const std::vector<CellShape>& cells,
                                             const PreconditioningInput& input);

}  // namespace hemoflux::fluid

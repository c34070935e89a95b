/// Stability limits of one time step for a whole unstructured grid: fluid/time_step.hpp, cell by cell.
///
///   lambda_v = 2 nu / gamma [1/2 sum_faces S / (V delta) + max_faces S / (V delta)]
///   lambda_c = [|u| sum_a S_a + c sqrt(sum_a S_a^2)] / (gamma V),  c = sqrt(u^2 (1 - gamma) + gamma^2 c_s^2)
///   lambda_r: as there, with sum_faces S / (2 V) for the sum over the axes and max_faces S / V for the largest
///
/// with S_a the projected areas (2.58); on a uniform box these are the eigenvalues of fluid/time_step.hpp. Idle faces (see
/// fluid/hex_boundary.hpp) do not count.
#pragma once

#include <vector>

#include "fluid/time_step.hpp"
#include "meshing/hex_grid.hpp"

namespace hemoflux::fluid {

/// Largest stable step of an explicit scheme. delta_max: limit of the streaming distance; idle: one value a face, from
/// idle_faces(); nu: largest viscosity; speed: largest velocity magnitude. std::invalid_argument for the factored scheme,
/// which needs rows of cells.
double stable_step(const meshing::HexGrid& grid, double delta_max, const std::vector<char>& idle,
                   Scheme scheme, double nu, double speed, double gamma = 1);

}  // namespace hemoflux::fluid

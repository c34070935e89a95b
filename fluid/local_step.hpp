/// Local time steps for steady flow: every cell advances by the largest step that is stable for itself.
///
///   dt_i = sigma V_i / (Lambda_c + C Lambda_v)_i                                            (2.55)
///   Lambda_c = sum_a [|u_a| + sqrt(u_a^2 (1 - gamma) + gamma^2 c_s^2)] S_a / gamma          (2.57; 4.13, corrected)
///   Lambda_v = sum_a 2 nu S_a^2 / (gamma V_i),   nu = mu / rho                              (2.57)
///   S_a = half the sum of |n_a| S over the cell's faces                                     (2.58)
///
/// On a rectilinear grid V / S_a is the cell's width along axis a. A direction one cell thick has no flow across and
/// adds nothing.
#pragma once

#include <cmath>

#include "exchange/macros.hpp"
#include "fluid/grid.hpp"
#include "fluid/state.hpp"

namespace hemoflux::fluid {

/// Convective spectral radius along one direction, per area: [|u| + sqrt(u^2 (1 - gamma) + gamma^2 c_s^2)]/gamma, with
/// c_s^2 = 1/3; |u| + c_s for gamma = 1.
HEMOFLUX_INLINE double convective_radius(double u, double gamma) {
    return (std::fabs(u) + std::sqrt((1 - gamma) * u * u + gamma * gamma / 3)) / gamma;
}

/// What the local steps depend on besides geometry and velocity.
struct LocalStepParameters {
    double sigma = 1;  ///< Courant number in (2.55)
    double c = 4;      ///< weight of the viscous radius in (2.55)
    double nu = 0;     ///< kinematic viscosity where the state has no viscosity field
    double gamma = 1;  ///< preconditioning parameter
};

/// Writes dt_i (2.55) of every interior cell to `dt`, a field in the state's layout. The state's viscosity field is used
/// where there is one.
void local_steps(const GridView& grid, const StateView& state, const LocalStepParameters& parameters,
                 double* dt);

}  // namespace hemoflux::fluid

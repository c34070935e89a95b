/// Overdamped motion of one cell without a fluid solver: elasticity against a local drag and the membrane's own
/// viscosity. A cross-check of the static solver, and the recovery of a stretched cell.
///
///   zeta_i dR_i/dt + sum_s g dL_s/dt e_s = -grad E + load,   zeta_i = beta A_i,  g = 4 mu_PM / sqrt 3.
///
/// Assumed of the fluid: no inertia, and a drag per area and velocity, beta, the same everywhere. In a Stokes
/// fluid beta belongs to a wavelength: a flow of wave number k along a flat membrane between fluids of
/// viscosities mu_o and mu_i is resisted by (mu_o + mu_i) k per area and velocity, one across it by twice that.
/// stokes_drag() takes k = 2/R_0, the largest deformation of a cell. Hydrodynamic interaction of distant parts
/// is left out, so that shapes on the way are approximate; the resting shapes do not depend on beta at all.
/// A_i is the rest area of a node.
///
/// Implicit in time (BDF2, the first step Euler), each step a minimisation of
///   E - load.R + sum_i (3/4) zeta_i |R_i - R*_i|^2/dt + sum_s (3/4) g (L_s - L*_s)^2/dt,
///   R* = (4 R_n - R_{n-1})/3,  L* likewise  (Euler: 1/2 in place of 3/4, R* = R_n),
/// hence stable at any step, with the membrane viscosity of viscosity.hpp in full and no Maxwell spring.
#pragma once

#include <functional>
#include <vector>

#include "membrane/relax.hpp"

namespace hemoflux::membrane {

/// beta = 2 (mu_o + mu_i)/R_0, 1e-4 Pa s/um, of viscosities in 1e-4 Pa s and R_0 in um.
double stokes_drag(double outer_viscosity, double inner_viscosity, double radius);

/// How a cell moves. Viscosities: of the membrane from the batch's parameters.
struct DynamicsOptions {
    double drag = 0;                         ///< beta, 1e-4 Pa s/um; positive
    double step = 0;                         ///< dt, 1e-5 s; positive
    int steps = 0;                           ///< greatest number of them
    RelaxOptions solver{.tolerance = 1e-4};  ///< of each step; its tolerance bounds the unbalanced force

    /// Throws InputError when a value is out of range.
    void check() const;
};

/// Moves the batch's one cell from its present shape under a constant load (1e-11 N a vertex; empty: none).
/// After every step calls `observe` with the time since the start (1e-5 s), the batch holding that shape, and
/// stops when it returns false. Errors as relax().
void evolve(Batch& batch, const DynamicsOptions& options, const std::vector<Vec3d>& load,
            const std::function<bool(double time)>& observe);

}  // namespace hemoflux::membrane

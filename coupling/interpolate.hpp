/// Velocity of the markers: V_m = sum_c w_mc u_c  (5.4).
#pragma once

#include "coupling/stencil.hpp"
#include "exchange/field.hpp"

namespace hemoflux::coupling {

/// Writes the velocity of every marker to vx[m], vy[m], vz[m] (device, size stencils.size()) in the unit of
/// `velocity`, a padded vector field on the grid of the stencils. Reads interior cells only.
void interpolate(const StencilSet& stencils, const exchange::FieldView& velocity, double* vx, double* vy,
                 double* vz);

}  // namespace hemoflux::coupling

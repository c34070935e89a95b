/// Momentum that the fluid loses through the sides of its box, from the same face fluxes that the residual is made of.
#pragma once

#include <array>

#include "exchange/vec3.hpp"
#include "fluid/boundary.hpp"
#include "fluid/residual.hpp"

namespace hemoflux::fluid {

/// Momentum per time through each side x-, x+, y-, y+, z-, z+ outwards, pressure included; nothing through periodic
/// sides. Ghost cells must be filled as for evaluate_residual().
std::array<Vec3d, 6> border_momentum(const GridView& grid, const StateView& state,
                                     const BoundaryView& boundary, const FlowParameters& parameters);

}  // namespace hemoflux::fluid

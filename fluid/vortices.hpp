/// Centres of vortices: the extrema of the streamfunction, (3.14).
#pragma once

#include <vector>

#include "fluid/streamfunction.hpp"

namespace hemoflux::fluid {

/// Centre of a vortex and the streamfunction there; psi < 0 turns clockwise.
struct Vortex {
    double x, y, psi;
};

/// All vortices, the strongest |psi| first. An extremum is a cell above or below its eight neighbours; its place and
/// value are those of the quadratic through the nine by least squares, exact for a quadratic field on any spacing.
/// Extrema weaker than `weakest` times the strongest are left out.
std::vector<Vortex> find_vortices(const PlaneField& psi, double weakest = 1e-7);

}  // namespace hemoflux::fluid

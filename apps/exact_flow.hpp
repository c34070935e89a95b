/// The exact solution that a case names, in lattice units.
#pragma once

#include "apps/case.hpp"
#include "apps/flow_setup.hpp"
#include "fluid/analytical.hpp"

namespace hemoflux::apps {

/// An exact solution with the clock that its times are counted in.
struct ExactCase {
    fluid::ExactFlow flow;  ///< lattice units
    double clock_s = 0;     ///< decay time or period, s; 0 for steady solutions
    bool periodic = false;  ///< whether it repeats after clock_s
};

/// [analytical] of a case with its geometry, viscosity and force. Throws InputError where they do not fit the solution.
ExactCase exact_case(const Case& c, const meshing::RectilinearGrid& grid, const Scales& scales);

/// Largest speed of the case's exact solution, um/s.
double largest_exact_speed(const Case& c, const meshing::RectilinearGrid& grid);

/// Decay time or period of the case's exact solution, s; 0 for steady ones.
double exact_clock(const Case& c, const meshing::RectilinearGrid& grid);

}  // namespace hemoflux::apps

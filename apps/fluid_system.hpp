/// The solver of a fluid case, with the numbers chosen for it.
#pragma once

#include "apps/case.hpp"
#include "apps/flow_setup.hpp"
#include "apps/schedule.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::apps {

/// A fluid case set up at t = 0. The lattice speed c follows from the fastest stream expected, so that its
/// Mach number sqrt(3) u/c is the chosen one.
struct FluidSystem {
    /// Throws InputError; what it accepts can be run.
    explicit FluidSystem(const Case& c);

    meshing::RectilinearGrid grid;
    double speed;  ///< fastest stream expected, um/s
    double mach;
    Scales scales;
    fluid::Solver solver;
    StepPlan plan;  ///< in s
};

}  // namespace hemoflux::apps

/// A coupled run: fluid and cells advanced together, with everything written that a run leaves behind.
#pragma once

#include <memory>

#include "apps/case.hpp"
#include "apps/cell_observer.hpp"
#include "apps/flow_setup.hpp"
#include "apps/rigid_bodies.hpp"
#include "apps/run.hpp"
#include "apps/run_files.hpp"
#include "apps/schedule.hpp"
#include "coupling/loop.hpp"
#include "coupling/scaling.hpp"
#include "membrane/shapes.hpp"

namespace hemoflux::apps {

/// The solvers of a coupled case, set up at t = 0.
class CoupledSystem {
  public:
    /// Checks the case, chooses the numbers and builds the fluid. Throws InputError.
    explicit CoupledSystem(const Case& c);
    /// Relaxes the cells, which may take a while, and couples them to the fluid; cells of a checkpoint keep its
    /// references and need no relaxation. Throws NumericalError (a relaxation failed), FileError.
    void add_cells(const Case& c, const output::Checkpoint* checkpoint = nullptr);

    /// State for a checkpoint, and back; cells must have been added.
    void save(output::Checkpoint& checkpoint) const;
    void load(const output::Checkpoint& checkpoint);

    double clock;  ///< clock_rate() of the case
    coupling::Numerics numerics;
    StepPlan plan;  ///< in strain
    Scales scales;
    std::unique_ptr<membrane::Batch> cells;
    std::unique_ptr<fluid::Solver> fluid;
    std::unique_ptr<coupling::Loop> loop;
    std::unique_ptr<RigidBodies> bodies;  ///< null without [[body]]
};

/// The numbers of a coupled case: capillary scaling and step. `cells` are those of the case.
coupling::Numerics numerics_of(const Case& c, const meshing::RectilinearGrid& grid);

/// Strain units per second: the shear rate, or without shear K_S/(mu R0) of the first cell, the rate at which its
/// membrane relaxes in the suspending fluid.
double clock_rate(const Case& c);

/// Total strain of a case, in units of that clock.
double strain_of(const Case& c);

/// The conversion table and the chosen numbers, for the start-up summary.
std::string describe(const Case& c, const CoupledSystem& system);

/// Runs a case of kind coupled; see run_case().
int run_coupled(const Case& c, const RunOptions& options);

}  // namespace hemoflux::apps

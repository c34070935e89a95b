/// A coupled run: fluid and cells advanced together, with everything written that a run leaves behind.
#pragma once

#include <memory>

#include "apps/case.hpp"
#include "apps/cell_observer.hpp"
#include "apps/flow_setup.hpp"
#include "apps/fluid_system.hpp"
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

    /// The fluid as the solver of a box, or of a mesh; null where it is the other.
    [[nodiscard]] fluid::Solver* box_solver() const { return dynamic_cast<fluid::Solver*>(fluid.get()); }
    [[nodiscard]] fluid::HexSolver* mesh_solver() const {
        return dynamic_cast<fluid::HexSolver*>(fluid.get());
    }
    /// Smallest cell width; on a mesh the smallest cube root of a volume, um.
    [[nodiscard]] double smallest() const { return smallest_; }

    FluidDomain domain;
    double clock;  ///< clock_rate() of the case
    coupling::Numerics numerics;
    StepPlan plan;  ///< in strain
    Scales scales;
    std::unique_ptr<membrane::Batch> cells;
    std::unique_ptr<fluid::Flow> fluid;
    std::unique_ptr<coupling::Loop> loop;
    std::unique_ptr<RigidBodies> bodies;  ///< null without [[body]]

  private:
    void make_flow(const Case& c, const std::optional<meshing::HexGrid>& grid);
    /// Shortens the step to what is stable on a mesh, whose cells are of many shapes.
    void limit_step();
    [[nodiscard]] std::unique_ptr<coupling::Loop> make_loop(const Case& c, std::vector<double> pull);

    double smallest_ = 0;
};

/// The numbers of a coupled case: capillary scaling and step. smallest: width of the smallest fluid cell; sheared: where a
/// shear flow about y = 0 is fastest; um.
coupling::Numerics numerics_of(const Case& c, double smallest, double sheared);

/// Membrane viscosity that the fluid carries, um^2 c.
double surface_viscosity_in_fluid(const Case& c, const coupling::Numerics& n);

/// The scheme of a coupled case: the one it names, but on a mesh Euler's in place of the factored one.
fluid::Scheme coupled_scheme(const Case& c);

/// Strain units per second: the shear rate, or without shear K_S/(mu R0) of the first cell, the rate at which its
/// membrane relaxes in the suspending fluid.
double clock_rate(const Case& c);

/// Total strain of a case, in units of that clock.
double strain_of(const Case& c);

/// The relative errors to expect from the numerical choices, in words.
std::string errors_text(const coupling::Numerics& numerics);

/// The conversion table and the chosen numbers, for the start-up summary.
std::string describe(const Case& c, const CoupledSystem& system);

/// Runs a case of kind coupled; see run_case().
int run_coupled(const Case& c, const RunOptions& options);

}  // namespace hemoflux::apps

/// The solver of a fluid case, with the numbers chosen for it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/case.hpp"
#include "apps/error_observer.hpp"
#include "apps/flow_observer.hpp"
#include "apps/flow_setup.hpp"
#include "apps/output/checkpoint.hpp"
#include "apps/output/summary.hpp"
#include "apps/rigid_bodies.hpp"
#include "apps/schedule.hpp"
#include "fluid/hex_solver.hpp"
#include "fluid/solver.hpp"
#include "meshing/hex_mesh.hpp"

namespace hemoflux::apps {

/// Where the flow lives: a box of cells, or a mesh.
struct FluidDomain {
    /// Throws InputError, FileError.
    explicit FluidDomain(const Case& c);

    std::optional<meshing::RectilinearGrid> box;
    std::optional<meshing::HexMesh> mesh;
    FlowBox bounds;
};

/// A fluid case set up at t = 0. The lattice speed c follows from the fastest stream expected, so that its
/// Mach number sqrt(3) u/c is the chosen one.
class FluidSystem {
  public:
    /// Throws InputError, FileError; what it accepts can be run.
    explicit FluidSystem(const Case& c);

    FluidDomain domain;
    double speed;  ///< fastest stream expected, um/s
    double mach;
    Scales scales;
    std::string reasoning;  ///< for gamma, where it was chosen; lines
    std::unique_ptr<fluid::Flow> flow;
    StepPlan plan;                         ///< in s; one step in steady runs
    std::optional<ErrorObserver> errors;   ///< where the case names an exact solution
    std::unique_ptr<coupling::Loop> loop;  ///< where the case has bodies
    std::unique_ptr<RigidBodies> bodies;

    /// One step of the flow and what is immersed in it.
    void step(double dt);

    /// The flow as the solver of a box; null on a mesh.
    [[nodiscard]] const fluid::Solver* box_solver() const {
        return dynamic_cast<const fluid::Solver*>(flow.get());
    }
    /// Of the flow, on whatever grid.
    [[nodiscard]] const fluid::SolverOptions& options() const;
    /// Smallest cell width; on a mesh the smallest cube root of a volume, um.
    [[nodiscard]] double smallest() const;
    /// "30 x 30 x 1 cells" or "23040 cells".
    [[nodiscard]] std::string describe_grid() const;

  private:
    [[nodiscard]] std::unique_ptr<fluid::Flow> make_flow(const Case& c);
    [[nodiscard]] double gamma_of(const Case& c, const fluid::SolverOptions& o, const meshing::HexGrid* grid);
};

/// What a run prints first: grid, numbers, conversion.
std::string describe(const Case& c, const FluidSystem& system);

/// What a run of so many steps cost, and its estimated error, for the summary. wall_s, cpu_s: its own, without those of
/// earlier runs of the process.
void add_performance(output::Summary& summary, const FluidSystem& system, double steps, double wall_s,
                     double cpu_s);

/// Density and velocity of a flow for a checkpoint, and back.
void save_flow(const fluid::Flow& flow, output::Checkpoint& checkpoint);
void load_flow(fluid::Flow& flow, const output::Checkpoint& checkpoint);

}  // namespace hemoflux::apps

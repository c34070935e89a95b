/// The time loop that partners the fluid and what is immersed in it: membrane cells, rigid bodies, or both. It is
/// sequential, each part using the newest data of the others:
///   (1) forces of everything immersed at the current nodes, spread to the cells; viscosity inside membrane cells
///   (2) one fluid step with the balanced impulse of those forces
///   (3) the NEW velocity interpolated to the nodes, nodes moved  (6.47)
/// Nodes moved with the new velocity allow twice to four times the step of a simultaneous exchange.
/// The fluid's grid is of either kind (fluid_grid.hpp); the loop is the same.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "coupling/fluid_grid.hpp"
#include "coupling/immersed.hpp"
#include "coupling/immersed_cells.hpp"
#include "exchange/field.hpp"
#include "fluid/hex_solver.hpp"
#include "fluid/solver.hpp"
#include "membrane/batch.hpp"

namespace hemoflux::coupling {

/// Choices of a coupled run that do not change during it. nu_outside is that of the fluid, whatever is given.
struct LoopOptions : CellOptions {
    Kernel kernel = Kernel::lagrange;
};

/// Forces of all nodes on the fluid in lattice units: their sum and the sum of their magnitudes.
struct NodalForce {
    Vec3d sum{0, 0, 0};
    double gross = 0;
};

/// Advances a fluid and its partners together; which they are is fixed before the first step.
class Loop {
  public:
    /// A loop with nothing immersed yet; the fluid must outlive it and needs a force field. InputError where its grid
    /// cannot serve the kernel, once something is added.
    Loop(fluid::Solver& fluid, Kernel kernel);
    Loop(fluid::HexSolver& fluid, Kernel kernel);
    /// A loop with membrane cells. fluid and cells must outlive it; the fluid needs a force field, and a viscosity
    /// field if nu_inside is given. Reads the nodes' positions for the centroid.
    Loop(fluid::Solver& fluid, membrane::Batch& cells, const LoopOptions& options);
    Loop(fluid::HexSolver& fluid, membrane::Batch& cells, const LoopOptions& options);
    ~Loop();

    /// Adds a partner, before the first step; it must outlive the loop, and no two may have one name.
    void add(Immersed& immersed);

    /// One step of dt (um/c). Throws NumericalError when a spring is overstretched.
    void step(double dt);

    /// Takes note, from now on, of how much the velocities of all nodes change in a step.
    void watch_velocities();
    /// The largest change of a node's velocity in the last step, c; nothing before the second step that was watched.
    [[nodiscard]] std::optional<double> velocity_change() const;
    /// The node whose velocity changed most, in words.
    [[nodiscard]] std::string most_changed() const;
    /// The velocities last seen, of all partners one after the other, for a checkpoint, and back. Empty unless watched.
    [[nodiscard]] std::vector<double> velocities() const;
    void restore_velocities(const std::vector<double>& velocities);

    /// Throws NumericalError that names the first node outside the box, the first fluid cell that is not finite, or a
    /// node inside another cell.
    void check();

    /// State of the membrane cells for a checkpoint, and back. restore() expects fluid and nodes to be restored
    /// already; without cells it only makes the loop forget what it has spread.
    [[nodiscard]] CellMemory memory() const { return cells_ ? cells_->memory() : CellMemory{}; }
    void restore(const CellMemory& memory);

    /// Sum of all shifts that recentring has made, um.
    [[nodiscard]] Vec3d total_shift() const { return cells_ ? cells_->total_shift() : Vec3d{0, 0, 0}; }
    /// How often the viscosity field has been computed.
    [[nodiscard]] std::size_t viscosity_updates() const { return cells_ ? cells_->viscosity_updates() : 0; }
    /// The membrane cells; null in a loop without.
    [[nodiscard]] ImmersedCells* cells() { return cells_.get(); }
    /// The forces of the last step.
    [[nodiscard]] NodalForce nodal_force() const;
    /// All fields that the partners exchange.
    [[nodiscard]] const exchange::FieldTable& fields() const { return fields_; }
    /// The fluid's grid as the partners see it.
    [[nodiscard]] const FluidGrid& grid() const { return *grid_; }

  private:
    struct Partner;
    [[nodiscard]] const Partner* most_changed_partner() const;

    Loop(fluid::Flow& fluid, std::unique_ptr<FluidGrid> grid, Kernel kernel);
    void add_cells(membrane::Batch& cells, const LoopOptions& options, double nu);

    fluid::Flow& fluid_;
    Kernel kernel_;
    std::unique_ptr<FluidGrid> grid_;
    exchange::FieldTable fields_;
    FluidFields at_cells_;
    exchange::FieldView force_density_;
    std::unique_ptr<ImmersedCells> cells_;
    std::vector<std::unique_ptr<Partner>> partners_;
};

}  // namespace hemoflux::coupling

/// The time loop that partners fluid and membrane. It is sequential, each part using the newest data of the
/// others:
///   (1) membrane forces at the current nodes, spread to the cells; viscosity inside the cells
///   (2) one fluid step with the balanced impulse of those forces
///   (3) the NEW velocity interpolated to the nodes, nodes moved  (6.47)
/// Nodes moved with the new velocity allow twice to four times the step of a simultaneous exchange.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "coupling/cell_grid.hpp"
#include "coupling/interpolate.hpp"
#include "coupling/motion.hpp"
#include "coupling/spread.hpp"
#include "coupling/stencil.hpp"
#include "coupling/viscosity.hpp"
#include "exchange/field.hpp"
#include "fluid/solver.hpp"
#include "membrane/batch.hpp"

namespace hemoflux::coupling {

/// Choices of a coupled run that do not change during it.
struct LoopOptions {
    Kernel kernel = Kernel::lagrange;
    double force_factor = 1;        ///< membrane force (1e-11 N) -> lattice force
    std::vector<double> nu_inside;  ///< one per cell, um c; empty: as outside, no viscosity field
    HalfWidth smoothing{};          ///< of the viscosity step
    bool recentre = false;          ///< hold the volume centroid of all cells where it is at the start
};

/// What a loop's future depends on besides fluid and nodes.
struct LoopMemory {
    std::array<std::vector<double>, 3> viscosity_nodes;  ///< nodes when the viscosity was last computed
    std::array<double, 3> target{};                      ///< where the centroid is held
    std::array<double, 3> shift{};                       ///< sum of all shifts so far
    bool operator==(const LoopMemory&) const = default;
};

class Loop {
  public:
    /// fluid and cells must outlive the loop; the fluid needs a force field, and a viscosity field if
    /// nu_inside is given. Reads the nodes' positions for the centroid.
    Loop(fluid::Solver& fluid, membrane::Batch& cells, const LoopOptions& options);
    ~Loop();

    /// One step of dt (um/c). Throws NumericalError when a spring is overstretched.
    void step(double dt);

    /// Throws NumericalError that names the first node outside the box or the first fluid cell that is not
    /// finite.
    void check();

    /// State for a checkpoint, and back. restore() expects fluid and nodes to be restored already.
    [[nodiscard]] LoopMemory memory() const;
    void restore(const LoopMemory& memory);

    /// Sum of all shifts that recentring has made, um.
    [[nodiscard]] Vec3d total_shift() const { return shift_; }
    /// How often the viscosity field has been computed.
    [[nodiscard]] std::size_t viscosity_updates() const {
        return viscosity_ ? viscosity_->recomputations() : 0;
    }
    /// All fields that the partners exchange.
    [[nodiscard]] const exchange::FieldTable& fields() const { return fields_; }

  private:
    fluid::Solver& fluid_;
    membrane::Batch& cells_;
    LoopOptions options_;
    CellGrid grid_;
    std::size_t nodes_;
    StencilSet stencils_;
    Spreader spreader_;
    std::unique_ptr<InteriorViscosity> viscosity_;
    std::unique_ptr<Recentring> recentring_;
    exchange::Buffer<double> vx_, vy_, vz_;
    exchange::FieldTable fields_;
    exchange::FieldView velocity_, force_density_, nodal_force_, position_;
    double* nu_ = nullptr;
    std::array<double, 3> target_{};
    Vec3d shift_{0, 0, 0};
};

}  // namespace hemoflux::coupling

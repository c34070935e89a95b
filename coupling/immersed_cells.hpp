/// Membrane cells as partners of the fluid: their forces, the viscosity inside them (6.45), their motion with the
/// fluid (6.47), and the recentring of all of them together.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "coupling/constraint_damping.hpp"
#include "coupling/contact.hpp"
#include "coupling/fluid_grid.hpp"
#include "coupling/immersed.hpp"
#include "coupling/motion.hpp"
#include "coupling/overlap.hpp"
#include "coupling/viscosity.hpp"
#include "membrane/batch.hpp"
#include "membrane/viscosity.hpp"

namespace hemoflux::coupling {

/// What does not change during a run.
struct CellOptions {
    double force_factor = 1;        ///< membrane force (1e-11 N) -> lattice force
    std::vector<double> nu_inside;  ///< one per cell, um c; empty: as outside, no viscosity field
    double nu_outside = 0;          ///< um c
    HalfWidth smoothing{};          ///< of the viscosity step
    bool recentre = false;          ///< hold the volume centroid of all cells where it is at the start
    std::optional<ContactOptions> contact = {};  ///< forces between cells, and from walls
    std::vector<double> pull =
        {};  ///< constant force along x on every node of the batch, 1e-11 N; empty: none
    /// Membrane viscosity as the fluid's, raised in cells that a membrane crosses: surface viscosity over density,
    /// um^2 c; 0: none. Needs nu_inside.
    double surface_nu = 0;
    /// Membrane viscosity as the membrane's own (Maxwell elements along its springs): what a lattice time (um/c) is in
    /// 1e-5 s; 0: none.
    double membrane_time = 0;
    double maxwell_stiffness = membrane::maxwell_stiffness;  ///< k' of those elements, 1e-5 N/m
    /// Strength of ConstraintDamping, which steps beyond the explicit limit of the membrane need; 0: none.
    double constraint_damping = 0;
    /// The step (um/c) that this strength is of; shorter ones need less. 0: all steps are alike.
    double damped_step = 0;
};

/// What the cells' future depends on besides fluid and nodes.
struct CellMemory {
    std::array<std::vector<double>, 3> viscosity_nodes;  ///< where each membrane was last measured
    std::array<double, 3> target{};                      ///< where the centroid is held
    std::array<double, 3> shift{};                       ///< sum of all shifts so far
    std::vector<double> pull{};                          ///< the constant load, as given
    membrane::ViscousState viscous{};                    ///< of the membrane's Maxwell elements
    bool operator==(const CellMemory&) const = default;
};

/// The membrane cells of a batch as one partner of the fluid.
class ImmersedCells final : public Immersed {
  public:
    /// `grid` and `cells` must outlive it. InputError unless there is a pull for every node of the batch or for none.
    /// nu: the fluid's viscosity field, used where nu_inside is given.
    /// Reads the nodes' positions for the centroid.
    ImmersedCells(const FluidGrid& grid, membrane::Batch& cells, const CellOptions& options,
                  const exchange::FieldView& nu);
    ~ImmersedCells() override;

    [[nodiscard]] std::string name() const override { return "membrane"; }
    [[nodiscard]] std::size_t nodes() const override { return nodes_; }
    [[nodiscard]] exchange::FieldView positions() override;
    [[nodiscard]] exchange::FieldView forces() override;
    [[nodiscard]] std::string force_unit() const override { return "1e-11 N"; }
    [[nodiscard]] double force_factor() const override { return options_.force_factor; }

    /// Throws NumericalError when a spring is overstretched.
    void compute_forces(double dt) override;
    /// Changes the velocity where constraint_damping asks for it.
    void advance(double dt, const exchange::FieldView& velocity) override;
    /// Throws NumericalError when a node is inside another cell.
    void check() override;
    [[nodiscard]] std::string describe_node(std::size_t node) const override;
    [[noreturn]] void report_lost(std::size_t node) const override;

    /// State for a checkpoint, and back. restore() expects the nodes to be restored already.
    [[nodiscard]] CellMemory memory() const;
    void restore(const CellMemory& memory);

    /// The smallest distance between two cells now; see OverlapCheck. Infinite (1e300) for a cell alone.
    [[nodiscard]] Gap smallest_gap();
    /// How far smallest_gap() looks, um.
    [[nodiscard]] double gap_reach() const { return overlap_ ? overlap_->reach() : 0; }
    /// Energy of the contacts where forces were last computed, 1e-17 J.
    [[nodiscard]] double contact_energy() { return contact_ ? contact_->energy() : 0; }

    /// Sum of all shifts that recentring has made, um.
    [[nodiscard]] Vec3d total_shift() const { return shift_; }
    /// How often the viscosity field has been computed.
    [[nodiscard]] std::size_t viscosity_updates() const {
        return viscosity_ ? viscosity_->recomputations() : 0;
    }

  private:
    /// The strength of the damping in a step of dt.
    [[nodiscard]] double damping_in(double dt) const;

    membrane::Batch& cells_;
    CellOptions options_;
    std::size_t nodes_;
    exchange::FieldView nu_;
    exchange::Buffer<double> pull_;
    std::unique_ptr<membrane::MembraneViscosity> elements_;
    std::unique_ptr<InteriorViscosity> viscosity_;
    std::unique_ptr<Recentring> recentring_;
    std::unique_ptr<Contact> contact_;
    std::unique_ptr<OverlapCheck> overlap_;
    std::array<double, 3> target_{};
    Vec3d shift_{0, 0, 0};
    std::unique_ptr<ConstraintDamping> damping_;
};

}  // namespace hemoflux::coupling

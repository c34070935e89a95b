/// What is immersed in the fluid, as the time loop sees it: nodes with positions and forces. Membrane cells and rigid
/// bodies are of this kind. Outermost level only: inner loops work on the arrays.
#pragma once

#include <cstddef>
#include <string>

#include "coupling/fluid_grid.hpp"
#include "exchange/field.hpp"

namespace hemoflux::coupling {

/// One partner of the fluid. A step goes: compute_forces, spread, fluid step, correct, velocity interpolated, advance.
class Immersed {
  public:
    virtual ~Immersed() = default;

    /// Under which its fields lie on the exchange table, e.g. "membrane".
    [[nodiscard]] virtual std::string name() const = 0;
    /// Number of nodes, fixed; those that pad the arrays count.
    [[nodiscard]] virtual std::size_t nodes() const = 0;
    /// Positions of the nodes (device, um); the pointers stay valid.
    [[nodiscard]] virtual exchange::FieldView positions() = 0;
    /// Forces of the nodes on the fluid (device, in force_unit()); the pointers stay valid.
    [[nodiscard]] virtual exchange::FieldView forces() = 0;
    /// In words, for output.
    [[nodiscard]] virtual std::string force_unit() const = 0;
    /// Force in force_unit() -> lattice force (rho_0 c^2 um^2).
    [[nodiscard]] virtual double force_factor() const = 0;

    /// Forces for the step of dt (um/c) to come, at the current nodes; also sets what else it changes in the fluid's
    /// fields (the viscosity inside cells).
    virtual void compute_forces(double dt) = 0;
    /// After the fluid step: may change the new velocity near the nodes, whose link is the one that spread the forces.
    /// Most do not.
    virtual void correct(double /*dt*/, const NodeLink& /*link*/, const FluidFields& /*fluid*/) {}
    /// Moves the nodes by a step of dt; velocity: the fluid's new velocity at the nodes (device, c).
    virtual void advance(double dt, const exchange::FieldView& velocity) = 0;

    /// Throws NumericalError when something of its own is wrong that the loop does not see.
    virtual void check() {}
    /// A node in words, for messages.
    [[nodiscard]] virtual std::string describe_node(std::size_t node) const {
        return "node " + std::to_string(node) + " of " + name();
    }
    /// Throws the NumericalError for a node that has left the box or is not a number.
    [[noreturn]] virtual void report_lost(std::size_t node) const = 0;

  protected:
    Immersed() = default;
    Immersed(const Immersed&) = default;
    Immersed(Immersed&&) = default;
    Immersed& operator=(const Immersed&) = default;
    Immersed& operator=(Immersed&&) = default;
};

}  // namespace hemoflux::coupling

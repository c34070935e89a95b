/// The balance of momentum of one step, each part measured on its own:
///
///   sum V (rho u)_new - sum V (rho u)_old = dt [sum F_nodes + f V - flux through the sides]
///                                           + what the implicit operator passes
///
/// Nodes give their forces (not what was spread), the sides the face fluxes of the residual at the old state.
#pragma once

#include <array>
#include <vector>

#include "coupling/loop.hpp"
#include "exchange/vec3.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::coupling {

/// Impulses in lattice units (rho_0 c um^3).
struct MomentumStep {
    Vec3d gained{0, 0, 0};        ///< by the fluid
    Vec3d nodes{0, 0, 0};         ///< from all nodes
    Vec3d force{0, 0, 0};         ///< from the uniform body force
    Vec3d sides{0, 0, 0};         ///< through the sides of the box, inwards
    double gross = 0;             ///< sum of the magnitudes of all nodal impulses, and of the body force's
    std::array<Vec3d, 6> flux{};  ///< momentum per time through each side outwards, at the old state

    /// What is missing, over the gross impulse.
    [[nodiscard]] double error() const { return norm(gained - nodes - force - sides) / gross; }
};

/// Measures a step of the schemes euler and factored with forces that do not change in time, and partners that act by
/// their forces alone.
class MomentumBalance {
  public:
    /// Fluid and loop must outlive this object.
    MomentumBalance(fluid::Solver& fluid, const Loop& loop) : fluid_(fluid), loop_(loop) {}

    /// Notes the fluid before a step.
    void before();
    /// The balance of the step of dt since; leaves the fluid as it is.
    [[nodiscard]] MomentumStep after(double dt);

  private:
    using Fields = std::array<std::vector<double>, 4>;
    [[nodiscard]] Fields read() const;
    void write(const Fields& q);

    fluid::Solver& fluid_;
    const Loop& loop_;
    Fields old_;
};

}  // namespace hemoflux::coupling

/// Rigid bodies held in a steady flow, as the constraint of its implicit method (fluid/constraint.hpp): the forces at
/// the nodes are unknowns beside the fluid's,
///
///   g_j = s_j [U_j - u_j - c_j (t_j - m_j)],   t_j = F_j / A_j,   m_j = (W f)_j / r_j,   f = W^T F / V,
///   s_j = sqrt(A_j / h_j^2) (nu / h_j + u_s) / h_j,   c_j = compliance h_j / (rho nu),   r = W (W^T A / V)
///   estimate  F_j = A_j rho nu / (response h_j) g_j / s_j
///
/// u_j the fluid's velocity interpolated to node j, U_j the body's, zero; A_j the area it stands for, h_j the local cell.
/// s_j makes the violation a rate: that by which viscosity and the stream, whose largest speed at the start is u_s, would
/// change the velocity of a cell. Stresses t that alternate from node to node are hardly felt by the cells and would
/// have no bound, so the surface gives way a little to what distinguishes a stress from its mean m over the
/// neighbourhood; smooth stresses are held without slip. The estimate is the fluid's answer to stresses that vary over a
/// few cells; Krylov iterations add what longer waves need.
#pragma once

#include <vector>

#include "coupling/cell_grid.hpp"
#include "coupling/rigid_body.hpp"
#include "coupling/spread.hpp"
#include "coupling/stencil.hpp"
#include "fluid/constraint.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::coupling {

/// The bodies of a steady flow and the forces that hold them.
class HeldBodies final : public fluid::Constraint {
  public:
    /// The bodies and the fluid must outlive this object; nobody else may write to the fluid's force meanwhile.
    /// InputError for a body that moves or is not held.
    HeldBodies(fluid::Solver& fluid, Kernel kernel, const std::vector<RigidBody*>& bodies);

    [[nodiscard]] std::size_t size() const override { return 3 * stencils_.size(); }
    void exert(const double* forces) override;
    void violation(const double* forces, double* g) override;
    void estimate(const float* g, double* forces) override;

    /// Hands the forces last exerted and the fluid's present velocity over to the bodies, whose drag, torque and slip
    /// they then are.
    void settle();

  private:
    [[nodiscard]] exchange::FieldView velocities();

    fluid::Solver& fluid_;
    std::vector<RigidBody*> bodies_;
    CellGrid grid_;
    StencilSet stencils_;
    Spreader spreader_;
    exchange::FieldView velocity_, force_density_;
    exchange::Buffer<double> force_, node_velocity_[3], node_density_[3];
    exchange::Buffer<double> weight_, slip_per_force_, slip_per_density_, force_per_violation_;
};

}  // namespace hemoflux::coupling

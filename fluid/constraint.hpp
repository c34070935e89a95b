/// Forces inside a flow that hold it to given velocities, as an implicit method sees them: m unknown forces beside the
/// cells' Q, and m equations.
///
///   R(Q, F) = 0,   g(Q, F) = 0
///
/// The outermost level only: the loops lie behind it. F and g are arrays of size() values in device memory.
#pragma once

#include <cstddef>

namespace hemoflux::fluid {

/// The forces and what they must bring about; HeldBodies of the coupling room is one.
class Constraint {
  public:
    virtual ~Constraint() = default;

    /// m.
    [[nodiscard]] virtual std::size_t size() const = 0;
    /// Makes the flow's next evaluations act under these forces.
    virtual void exert(const double* forces) = 0;
    /// g at the flow's present state, in the unit of a momentum residual and so weighted that the sum of its squares
    /// compares with that of the residual over the cells. g may be the same memory as forces.
    virtual void violation(const double* forces, double* g) = 0;
    /// About the forces that would undo a violation g, for the preconditioner: (E A^-1 B)^-1 g, A = I/dt - dR/dQ,
    /// B = dR/dF, E = -dg/dQ.
    virtual void estimate(const float* g, double* forces) = 0;

  protected:
    Constraint() = default;
    Constraint(const Constraint&) = default;
    Constraint(Constraint&&) = default;
    Constraint& operator=(const Constraint&) = default;
    Constraint& operator=(Constraint&&) = default;
};

}  // namespace hemoflux::fluid

/// Right-hand side of the finite-volume equations (2.3):
///   dQ/dt = R(Q) = -1/V sum_faces F.n S + (0, f),   Q = (rho, rho u, rho v, rho w), f the body force per
///   volume.
/// On the CPU one task is a tile of rows: every face flux is computed once and kept in small stack buffers. A
/// CUDA thread computes one cell with its six faces. Both call the same face_flux().
#pragma once

#include "fluid/boundary.hpp"
#include "fluid/grid.hpp"
#include "fluid/state.hpp"

namespace hemoflux::fluid {

/// What the residual needs besides geometry and state.
struct FlowParameters {
    double nu = 0;     ///< kinematic viscosity where the state has no viscosity field (length c)
    double gamma = 1;  ///< preconditioning parameter of (4.2); 1: none
    double uniform_force[3] = {0, 0, 0};  ///< body force per volume everywhere, acts if with_force
    bool with_force = false;  ///< the state's body force acts as well, with the balanced impulse on faces
    bool with_viscosity =
        false;  ///< the state's viscosity field is used; on faces the arithmetic mean of both cells
};

/// Where R is written, in the state's layout; interior cells only.
template <class Real>
struct BasicResidualView {
    Real* r[4] = {nullptr, nullptr, nullptr, nullptr};
};
using ResidualView = BasicResidualView<double>;
using SingleResidualView = BasicResidualView<float>;

/// Evaluates R for all interior cells. Ghost cells of the state (and of force and viscosity, if used) must be
/// filled.
void evaluate_residual(const GridView& grid, const StateView& state, const BoundaryView& boundary,
                       const FlowParameters& parameters, const ResidualView& out);

/// The same in single precision, on the CPU, for cubic cells (GridView::delta is set), constant viscosity and
/// no body force: std::invalid_argument otherwise. grid.layout is that of the state.
void evaluate_residual(const GridView& grid, const SingleStateView& state, const BoundaryView& boundary,
                       const FlowParameters& parameters, const SingleResidualView& out);

/// The same cell by cell, each face computed twice, in plain doubles: how a CUDA thread does it, and the
/// reference that tests and benchmarks compare with.
void evaluate_residual_by_cell(const GridView& grid, const StateView& state, const BoundaryView& boundary,
                               const FlowParameters& parameters, const ResidualView& out);

}  // namespace hemoflux::fluid

/// Implicit pseudo-time steps towards a steady state: inexact Newton with Krylov solutions of the linear systems and
/// products with the Jacobian by differences of residuals (Knoll and Keyes 2004).
///
///   (I/dt - J) dQ = R(Q),   J z ~ [R(Q + e z) - R(Q)] / e,   Q <- Q + dQ
///   dt_i = CFL times the convective local step of cell i     CFL <- CFL |R_old| / |R_new|   (switched evolution relaxation)
///
/// GMRES is preconditioned from the right with the incomplete factors of a CompactMatrix. Every Krylov iteration costs
/// one residual evaluation.
///
/// With a Constraint the forces F that hold the flow inside are unknowns beside Q, and the system becomes
///
///   [ I/dt - dR/dQ   -B ] [dQ]   [R]
///   [      E          C ] [dF] = [g],   B = dR/dF, E = -dg/dQ, C = -dg/dF
///
/// preconditioned with its upper block triangle: dF from the constraint's own estimate of (C + E A^-1 B)^-1 g, then
/// A dQ = R + B dF, B dF by a second difference of residuals. Every Krylov iteration then costs two evaluations.
///
/// Why this one: on a cubic cavity of 24^3 cells at Ma 0.017, gamma = 0.02, a residual reduction by 1e5 takes 4764 (Re 100)
/// and 9512 (Re 1000) evaluations of Runge-Kutta local steps and 99 and 230 to 320 of this. Acceleration methods without a
/// linearisation only filter the history of the explicit iteration and stay bound to its stable steps.
#pragma once

#include <memory>
#include <optional>

#include "exchange/buffer.hpp"
#include "fluid/compact_matrix.hpp"
#include "fluid/constraint.hpp"
#include "fluid/flow.hpp"
#include "fluid/krylov.hpp"

namespace hemoflux::fluid {

/// Choices of the implicit steps.
struct NewtonOptions {
    double first_courant = 100;     ///< CFL of the first step
    double largest_courant = 1e8;   ///< bound of CFL
    double growth = 10;             ///< most that CFL grows by in one step
    double linear_tolerance = 0.1;  ///< reduction of the linear residual at which GMRES stops
    std::size_t krylov = 50;        ///< most Krylov iterations of one step
    /// Level of fill of the incomplete factors; empty: chosen by CompactMatrix.
    std::optional<std::uint32_t> fill;
};

/// Newton steps of pseudo-transient continuation, each solved by GMRES without a matrix.
class NewtonKrylov {
  public:
    /// What a step did.
    struct Step {
        bool accepted =
            false;  ///< false: the residual rose too much, the state is as before and CFL a quarter
        std::size_t krylov = 0;  ///< Krylov iterations
        double courant = 0;      ///< CFL of the step
    };

    /// The present state of the flow is the start, with zero forces of the constraint; its conditions and viscosity must
    /// not change while this object lives. constraint: null, or what must outlive this object.
    NewtonKrylov(Flow& flow, const NewtonOptions& options, Constraint* constraint = nullptr);

    /// One step. Leaves the flow with the new state and its residual. Throws NumericalError when CFL has fallen so far
    /// that no step is possible.
    Step step();

    /// Bytes of device memory beside the flow's own.
    [[nodiscard]] std::size_t bytes() const;
    /// Scaled residual of all equations over that at the start.
    [[nodiscard]] double relative_residual() const { return first_norm_ > 0 ? norm_ / first_norm_ : 0; }

  private:
    void set_scales();
    /// Solves the linear system for `change_`; returns the Krylov iterations.
    std::size_t solve();
    double norm(const double* r);
    /// out <- the scaled residual.
    void scale(const double* r, double* out);
    /// Residual and violation at the unknowns x; r may be x.
    void residual_at(const double* x, double* r);
    /// z <- M^-1 v.
    void precondition(const float* v, double* z);
    /// product_ <- the matrix times change_.
    void multiply_change();

    Flow& flow_;
    NewtonOptions options_;
    Constraint* constraint_;
    std::size_t cells_, fluid_unknowns_, forces_;
    CompactMatrix matrix_;
    KrylovBasis basis_;
    exchange::Buffer<double> q_, r_, moved_, product_, change_, trial_, dt_;
    exchange::Buffer<float> combined_, shifted_;
    double scale_[4] = {1, 1, 1, 1};
    double courant_, norm_ = 0, first_norm_ = 0, typical_force_ = 0;
};

}  // namespace hemoflux::fluid

/// The fluid solver on a rectilinear grid: owns the fields and advances them in time.
/// Units: the grid's length unit, velocity c = 1, density 1; pressure = gamma rho / 3.
#pragma once

#include <functional>
#include <memory>

#include "exchange/field.hpp"
#include "exchange/vec3.hpp"
#include "fluid/boundary.hpp"
#include "fluid/factored.hpp"
#include "fluid/grid.hpp"
#include "fluid/residual.hpp"
#include "fluid/state.hpp"
#include "fluid/time_step.hpp"

namespace hemoflux::fluid {

/// Choices of a run that do not change during it.
struct SolverOptions {
    double nu = 0;                        ///< kinematic viscosity (of the suspending fluid, where it varies)
    double largest_nu = 0;                ///< largest viscosity that will occur; 0: nu
    double smallest_nu = 0;               ///< smallest viscosity that will occur, for tau_floor; 0: nu
    bool with_viscosity = false;          ///< viscosity varies in space
    bool with_force = false;              ///< a body force acts
    double uniform_force[3] = {0, 0, 0};  ///< body force per volume everywhere, added to the field
    double gamma = 1;      ///< preconditioning parameter (4.2); other than 1 only for steady flow
    double tau_floor = 0;  ///< smallest tau - 1/2 on any face; 0: no floor
    Scheme scheme = Scheme::rk4;
};

/// Density and velocity at a point.
struct FlowPoint {
    double density = 1;
    Vec3d velocity{0, 0, 0};
};

/// Root mean square of dQ/dt over the cells: density and the three momenta, each in its own unit per time.
struct ResidualNorm {
    double density = 0, momentum[3] = {0, 0, 0};
};

class Solver {
  public:
    /// Throws InputError when options or patches are impossible.
    Solver(const meshing::RectilinearGrid& grid, const Patches& patches, const SolverOptions& options);

    /// Sets density and velocity at every cell centre.
    void initialise(const std::function<FlowPoint(const Vec3d&)>& flow);

    /// One time step of the chosen scheme. Force and viscosity, if used, are taken as they stand in their
    /// fields.
    void step(double dt);

    /// Evaluates R(Q) into residual().
    void evaluate();

    /// Root mean squares of the last residual evaluated, NaN before the first. After a factored step only its
    /// density part is a residual.
    ResidualNorm residual_norm();

    /// Volume-averaged density.
    double mean_density();
    /// Largest velocity magnitude. NaN if any velocity is.
    double largest_speed();
    /// Index (x fastest) of the first cell whose density or velocity is not finite, or whose density is
    /// outside (0.5, 1.5); the number of cells if there is none.
    std::size_t first_bad_cell();

    /// Centre of a cell numbered x fastest.
    [[nodiscard]] Vec3d centre(std::size_t cell) const;

    [[nodiscard]] const Grid& grid() const { return grid_; }
    [[nodiscard]] const SolverOptions& options() const { return options_; }
    [[nodiscard]] State& state() { return state_; }
    [[nodiscard]] const State& state() const { return state_; }
    [[nodiscard]] const Boundary& boundary() const { return boundary_; }
    [[nodiscard]] const State& residual() const { return residual_; }
    /// Residual evaluations since construction.
    [[nodiscard]] std::size_t evaluations() const { return evaluations_; }

    /// Lays density, velocity, and force and viscosity where used, on the table as fluid.*.
    void offer(exchange::FieldTable& table) const;

  private:
    [[nodiscard]] FlowParameters flow_parameters() const;
    [[nodiscard]] ResidualView residual_view(const State& fields) const;

    SolverOptions options_;
    Grid grid_;
    Boundary boundary_;
    State state_, residual_;
    std::unique_ptr<State> base_, sum_;
    std::unique_ptr<Factored> factored_;
    std::size_t evaluations_ = 0;
};

}  // namespace hemoflux::fluid

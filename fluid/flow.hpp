/// What a fluid solver is to its callers, whatever its grid: the outermost level of the fluid room. Inner loops never
/// see this interface.
/// Units: the grid's length unit, velocity c = 1, density 1; pressure = gamma rho / 3.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "exchange/field.hpp"
#include "exchange/vec3.hpp"
#include "fluid/compact_model.hpp"

namespace hemoflux::fluid {

/// Density and velocity at a point.
struct FlowPoint {
    double density = 1;
    Vec3d velocity{0, 0, 0};
};

/// Root mean square of dQ/dt over the cells: density and the three momenta, each in its own unit per time.
struct ResidualNorm {
    double density = 0, momentum[3] = {0, 0, 0};
};

/// One face of a border patch and the force of the fluid on what lies behind it. area points out of the fluid, its
/// length is the face's area. The forces are in lattice units and carry the factor gamma of (4.22); the pressure is
/// counted from that of density 1.
struct WallFace {
    Vec3d centre, area, pressure, viscous;
};

/// Fields and time stepping of one fluid domain. Cells are numbered 0 .. cells() - 1 in the order of the grid.
class Flow {
  public:
    virtual ~Flow() = default;

    /// Number of cells.
    [[nodiscard]] virtual std::size_t cells() const = 0;
    /// Centre and volume of a cell.
    [[nodiscard]] virtual Vec3d centre(std::size_t cell) const = 0;
    [[nodiscard]] virtual double volume(std::size_t cell) const = 0;
    /// Names of the border patches.
    [[nodiscard]] virtual std::vector<std::string> patches() const = 0;

    /// Values of one field at all cells, copied from the device: component 0 density, 1 to 3 velocity.
    [[nodiscard]] virtual std::vector<double> values(int component) const = 0;
    /// Replaces them; values.size() must be cells() (std::length_error).
    virtual void set_values(int component, const std::vector<double>& values) = 0;
    /// Sets density and velocity at every cell centre.
    void initialise(const std::function<FlowPoint(const Vec3d&)>& flow);

    /// The time at which the state stands, 0 at first. Boundary conditions and forces that change in time are taken at
    /// this time by evaluate(), and at the times of the stages by step().
    virtual void set_time(double t) = 0;
    [[nodiscard]] virtual double time() const = 0;
    /// Evaluates R(Q) = dQ/dt.
    virtual void evaluate() = 0;
    /// One time step of the solver's scheme; the time moves on by dt.
    virtual void step(double dt) = 0;
    /// Chooses every cell's own step for steady flow, by (2.55) from the current state (see fluid/local_step.hpp).
    /// sigma: Courant number; c: weight of the viscous radius.
    virtual void set_local_steps(double sigma, double c) = 0;
    /// One Runge-Kutta iteration (2.29) in which every cell takes its own step. Throws std::logic_error before
    /// set_local_steps().
    virtual void local_step() = 0;

    /// Q = (rho, rho u, rho v, rho w) of all cells, one component after the other: q[c cells() + cell], device memory of
    /// 4 cells() values.
    virtual void read_conserved(double* q) const = 0;
    /// Replaces density and velocity of all cells by those of Q, laid out as above.
    virtual void write_conserved(const double* q) = 0;
    /// The residual dQ/dt last evaluated, laid out as above.
    virtual void read_residual(double* r) const = 0;
    /// The local steps, one a cell, device memory. Throws std::logic_error before set_local_steps().
    virtual void read_local_steps(double* dt) const = 0;

    /// The faces and boundary conditions as an implicit method sees them.
    [[nodiscard]] virtual CompactModel compact_model() const = 0;

    /// Lays density, velocity, and force and viscosity where used, on the table as fluid.*.
    virtual void offer(exchange::FieldTable& table) = 0;

    /// Residual evaluations since construction.
    [[nodiscard]] virtual std::size_t evaluations() const = 0;

    /// Root mean squares of the last residual evaluated, NaN before the first.
    virtual ResidualNorm residual_norm() = 0;
    /// Volume-averaged density.
    virtual double mean_density() = 0;
    /// Largest velocity magnitude. NaN if any velocity is.
    virtual double largest_speed() = 0;
    /// First cell whose density or velocity is not finite, or whose density is outside (0.5, 1.5); cells() if there is
    /// none.
    virtual std::size_t first_bad_cell() = 0;

    /// Gradients of density and velocity x, y, z at every cell, as the solver takes them.
    [[nodiscard]] virtual std::vector<std::array<Vec3d, 4>> gradients() const = 0;
    /// The faces of a patch with the forces on what lies behind them. InputError when there is no such patch, or it is
    /// periodic.
    [[nodiscard]] virtual std::vector<WallFace> wall_faces(const std::string& patch) const = 0;

  protected:
    Flow() = default;
    Flow(const Flow&) = default;
    Flow(Flow&&) = default;
    Flow& operator=(const Flow&) = default;
    Flow& operator=(Flow&&) = default;
};

}  // namespace hemoflux::fluid

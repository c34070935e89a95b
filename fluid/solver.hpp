/// The fluid solver on a rectilinear grid: owns the fields and advances them in time.
/// Units: the grid's length unit, velocity c = 1, density 1; pressure = gamma rho / 3.
#pragma once

#include <memory>

#include "exchange/field.hpp"
#include "exchange/vec3.hpp"
#include "fluid/boundary.hpp"
#include "fluid/factored.hpp"
#include "fluid/flow.hpp"
#include "fluid/grid.hpp"
#include "fluid/oscillating_force.hpp"
#include "fluid/residual.hpp"
#include "fluid/single_residual.hpp"
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
    OscillatingForce oscillating_force;   ///< added as well, acts with with_force
    double gamma = 1;               ///< preconditioning parameter (4.2); other than 1 only for steady flow
    double tau_floor = 0;           ///< smallest tau - 1/2 on any face; 0: no floor
    bool single_precision = false;  ///< residuals in single precision, the state stays in double; see Solver
    Scheme scheme = Scheme::rk4;
    GradientMethod gradient = GradientMethod::least_squares;
};

/// Largest streaming distance that keeps tau - 1/2 at its floor: 3 nu / (gamma tau_floor).
double largest_delta(const SolverOptions& options);

/// The options themselves. Throws InputError when viscosity or gamma is out of range.
const SolverOptions& checked(const SolverOptions& options);

/// What the residual takes from the options at time t.
FlowParameters parameters_at(const SolverOptions& options, double t);

/// The flow solver on a rectilinear grid; cells are numbered x fastest.
class Solver final : public Flow {
  public:
    /// Throws InputError when options or patches are impossible. single_precision needs cubic cells, a constant
    /// viscosity, no body force and a processor (see fluid/single_residual.hpp).
    Solver(const meshing::RectilinearGrid& grid, const Patches& patches, const SolverOptions& options);

    [[nodiscard]] std::size_t cells() const override { return grid_.view().layout.cells(); }
    [[nodiscard]] Vec3d centre(std::size_t cell) const override;
    [[nodiscard]] double volume(std::size_t cell) const override;
    [[nodiscard]] std::vector<std::array<Vec3d, 4>> gradients() const override;
    [[nodiscard]] std::vector<WallFace> wall_faces(const std::string& patch) const override;
    [[nodiscard]] std::vector<std::string> patches() const override;
    [[nodiscard]] std::vector<double> values(int component) const override;
    void set_values(int component, const std::vector<double>& values) override;

    void set_time(double t) override;
    [[nodiscard]] double time() const override { return time_; }
    /// Force and viscosity, if used, are taken as they stand in their fields. The factored scheme takes what changes
    /// in time at the end of the step.
    void step(double dt) override;

    void set_local_steps(double sigma, double c) override;
    void local_step() override;
    void read_conserved(double* q) const override;
    void write_conserved(const double* q) override;
    void read_residual(double* r) const override;
    void read_local_steps(double* dt) const override;
    [[nodiscard]] CompactModel compact_model() const override;

    /// Momentum per time through each side outwards (border_flux.hpp), at the state, force and viscosity as they stand.
    [[nodiscard]] std::array<Vec3d, 6> border_momentum();
    /// What the factored scheme lets through the sides beyond that in a step with these increments of momentum; see
    /// Factored::side_impulse(). Zero for other schemes.
    [[nodiscard]] Vec3d side_impulse(const std::array<std::vector<double>, 3>& increments) const {
        return factored_ ? factored_->side_impulse(increments) : Vec3d{0, 0, 0};
    }

    /// Evaluates R(Q) into residual().
    void evaluate() override;

    /// After a factored step only the density part is a residual.
    ResidualNorm residual_norm() override;
    double mean_density() override;
    double largest_speed() override;
    std::size_t first_bad_cell() override;

    /// The grid as the kernels see it.
    [[nodiscard]] const Grid& grid() const { return grid_; }
    [[nodiscard]] const SolverOptions& options() const { return options_; }
    /// The fields; kernels of other rooms write force and viscosity into them.
    [[nodiscard]] State& state() { return state_; }
    [[nodiscard]] const State& state() const { return state_; }
    [[nodiscard]] const Boundary& boundary() const { return boundary_; }
    /// dQ/dt as last evaluated, laid out like the state: density, then momentum.
    [[nodiscard]] const State& residual() const { return residual_; }
    [[nodiscard]] std::size_t evaluations() const override { return evaluations_; }

    void offer(exchange::FieldTable& table) override;

  private:
    [[nodiscard]] FlowParameters flow_parameters() const;
    /// Takes what changes in time at a stage's time.
    void evaluate_at(double t);
    /// The four stages of (2.29) from time `start` to start + dt. A cell advances by `scale`, times its local_dt if that is
    /// not null.
    void step_rk4(double start, double dt, double scale, const double* local_dt);
    [[nodiscard]] ResidualView residual_view(const State& fields) const;
    /// Ghost values of force and viscosity, where used.
    void fill_coefficients();

    SolverOptions options_;
    Grid grid_;
    Boundary boundary_;
    State state_, residual_;
    std::unique_ptr<State> base_, sum_;
    std::unique_ptr<SingleResidual> single_;
    std::unique_ptr<Factored> factored_;
    exchange::Buffer<double> local_dt_;
    std::size_t evaluations_ = 0;
    double time_ = 0, stage_time_ = 0;
};

}  // namespace hemoflux::fluid

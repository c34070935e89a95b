/// The fluid solver on an unstructured grid of hexahedra: owns the fields and advances them in time.
/// Units: the grid's length unit, velocity c = 1, density 1; pressure = gamma rho / 3.
#pragma once

#include <array>

#include "exchange/buffer.hpp"
#include "fluid/flow.hpp"
#include "fluid/hex_boundary.hpp"
#include "fluid/hex_geometry.hpp"
#include "fluid/hex_residual.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::fluid {

/// Cells are numbered as in the grid; HexGrid::original gives their numbers in the mesh.
class HexSolver final : public Flow {
  public:
    /// Throws InputError when options or patches are impossible: beyond what Solver refuses, the factored scheme, which is
    /// for rectilinear grids, and cells too distorted for a gradient. A viscosity that varies in space has its place
    /// beside the body force and brings that with it.
    HexSolver(meshing::HexGrid grid, const HexPatches& patches, const SolverOptions& options);

    [[nodiscard]] std::size_t cells() const override { return grid_.cells(); }
    [[nodiscard]] Vec3d centre(std::size_t cell) const override { return grid_.centre[cell]; }
    [[nodiscard]] double volume(std::size_t cell) const override { return grid_.volume[cell]; }
    [[nodiscard]] std::vector<std::string> patches() const override;
    [[nodiscard]] std::vector<double> values(int component) const override;
    void set_values(int component, const std::vector<double>& values) override;
    /// Replaces one component (0 to 2) of the body force per volume; values.size() must be cells() (std::length_error).
    /// std::logic_error unless the options say with_force.
    void set_force(int component, const std::vector<double>& values);
    /// Replaces the viscosity, which starts as options().nu. std::logic_error unless the options say with_viscosity.
    void set_viscosity(const std::vector<double>& values);
    /// One component of the body force per volume (0 to 2), or the viscosity (3), at all cells; empty without it.
    [[nodiscard]] std::vector<double> coefficient(int component) const;

    void set_time(double t) override;
    [[nodiscard]] double time() const override { return time_; }
    void evaluate() override;
    void step(double dt) override;
    [[nodiscard]] std::size_t evaluations() const override { return evaluations_; }
    /// Largest stable step of the solver's scheme for the given largest velocity magnitude, see fluid/hex_time_step.hpp.
    [[nodiscard]] double largest_step(double speed) const;

    void set_local_steps(double sigma, double c) override;
    void local_step() override;
    void read_conserved(double* q) const override;
    void write_conserved(const double* q) override;
    void read_residual(double* r) const override;
    void read_local_steps(double* dt) const override;
    [[nodiscard]] CompactModel compact_model() const override;

    void offer(exchange::FieldTable& table) override;

    ResidualNorm residual_norm() override;
    double mean_density() override;
    double largest_speed() override;
    std::size_t first_bad_cell() override;

    /// Gradients of density and velocity x, y, z at the cell centres, from the current state.
    [[nodiscard]] std::vector<std::array<Vec3d, 4>> gradients() const override;
    /// The faces of a patch with the forces of the fluid on what lies behind it: the momentum flux through each face
    /// times gamma, less what is convected through it, split into pressure gamma (rho - 1) / 3 and the rest, the viscous
    /// stress. InputError when there is no such patch.
    [[nodiscard]] std::vector<WallFace> wall_faces(const std::string& patch) const override;

    /// The grid in the numbering of the cells.
    [[nodiscard]] const meshing::HexGrid& grid() const { return grid_; }
    [[nodiscard]] const SolverOptions& options() const { return options_; }
    [[nodiscard]] const HexBoundary& boundary() const { return boundary_; }

  private:
    [[nodiscard]] FlowParameters flow_parameters() const;
    [[nodiscard]] HexFields fields() const;
    /// Values of one column of records of four, and back.
    [[nodiscard]] std::vector<double> column(const exchange::Buffer<double>& records, int component) const;
    void set_column(exchange::Buffer<double>& records, int component, const std::vector<double>& values);
    /// Takes what changes in time at a stage's time and evaluates there.
    void evaluate_at(double t);
    /// The four stages of (2.29), with the step dt or dt times every cell's own; time moves on by `advance`.
    void runge_kutta(double dt, const double* local_dt, double advance);

    SolverOptions options_;
    meshing::HexGrid grid_;
    HexGeometry geometry_;
    HexBoundary boundary_;
    /// Records and fluxes are scratch of every evaluation, and so are the ghost cells behind values and force.
    mutable exchange::Buffer<double> values_, force_, records_, flux_, rate_;
    exchange::Buffer<double> base_, sum_, local_dt_;
    std::size_t evaluations_ = 0, rings_ = 0;
    double time_ = 0, stage_time_ = 0;
};

}  // namespace hemoflux::fluid

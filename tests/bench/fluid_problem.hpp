/// Fluid fields with smooth flow in them, for the benchmarks of the fluid room.
#pragma once

#include <array>
#include <vector>

#include "fluid/residual.hpp"

namespace hemoflux::bench {

/// What the residual has to cope with.
enum class Features {
    plain,  ///< uniform grid, periodic, constant viscosity, no force, gamma = 1
    full    ///< plateau grid, given velocity on all sides, viscosity field and body force
};

/// Grid, boundary, state with ghosts filled, and room for the residual.
struct FluidProblem {
    /// n: cells along x, y, z of a box whose cells are 0.4 um on average.
    FluidProblem(std::array<int, 3> n, Features features);
    FluidProblem(const FluidProblem&) = delete;
    FluidProblem& operator=(const FluidProblem&) = delete;

    /// The residual's output.
    [[nodiscard]] fluid::ResidualView out() const;
    /// Evaluates the residual by tiles, as the solver does.
    void evaluate() const;
    /// Evaluates the residual cell by cell.
    void evaluate_by_cell() const;
    /// Number of cells.
    [[nodiscard]] std::size_t cells() const { return grid.view().layout.cells(); }

    /// Mean cell width, um.
    static constexpr double width = 0.4;

    fluid::Patches patches;
    fluid::Grid grid;
    fluid::Boundary boundary;
    fluid::State state, residual;
    fluid::FlowParameters parameters;
};

/// Relative L2 differences of the scalar kernel (scalar_lbfs.hpp) from the solver's residual on a small box
/// of unequal sides, summed over the four components. NaN if either has one.
double scalar_kernel_error();

}  // namespace hemoflux::bench

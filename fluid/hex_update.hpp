/// Explicit updates, norms and vectors of an unstructured flow, whose fields are records of four values per cell.
#pragma once

#include "fluid/flow.hpp"
#include "fluid/hex_residual.hpp"
#include "fluid/local_step.hpp"
#include "fluid/update.hpp"

namespace hemoflux::fluid {

/// values <- base + increment in conserved variables, as update() of fluid/update.hpp does on padded rows, here in records
/// of four; local_dt: one step a cell. base and values may be the same; sum may be null without accumulate and use_sum.
void update_hex(std::size_t cells, const double* base, const double* rate, double* sum,
                const UpdateParameters& parameters, double* values);

/// Step of every cell, (2.55) to (2.58) with the preconditioned radii of fluid/local_step.hpp, into dt[cells].
void hex_local_steps(const HexView& grid, const double* values, const LocalStepParameters& parameters,
                     double* dt);

/// q[4][cells] = (rho, rho V), and back.
void hex_conserved(std::size_t cells, const double* values, double* q);
void hex_values(std::size_t cells, const double* q, double* values);
/// to[4][cells] from records of four.
void hex_components(std::size_t cells, const double* records, double* to);

/// Root mean squares of the four components of `rate`.
ResidualNorm hex_norm(std::size_t cells, const double* rate);
/// Volume-averaged density.
double hex_mean_density(const HexView& grid, const double* values);
/// Largest velocity magnitude; NaN if any is.
double hex_largest_speed(std::size_t cells, const double* values);
/// First cell that is not finite or whose density is outside (0.5, 1.5); `cells` if there is none.
std::size_t hex_first_bad(std::size_t cells, const double* values);

}  // namespace hemoflux::fluid

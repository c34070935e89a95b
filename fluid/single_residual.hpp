/// The residual in single precision for a state that is kept in double precision: half the time of the double
/// residual, and no small increments lost in the state. The density is rounded as rho - 1, so that pressure
/// differences keep their digits. Cubic cells, constant viscosity, no body force, CPU.
#pragma once

#include "exchange/buffer.hpp"
#include "fluid/boundary.hpp"
#include "fluid/residual.hpp"

namespace hemoflux::fluid {

/// Owns the rounded state and its residual. Rows are padded for packs of floats.
class SingleResidual {
  public:
    /// std::invalid_argument if the grid's cells are not cubes of one streaming distance.
    explicit SingleResidual(const GridView& grid);

    /// R of a state whose ghost cells are filled, written to `out` in double precision.
    void evaluate(const StateView& state, const BoundaryView& boundary, const FlowParameters& parameters,
                  const ResidualView& out);

    /// The steps of evaluate(): rounding the state, its residual in single precision, and widening that.
    void round(const StateView& state);
    /// Evaluates R of the state last rounded, in single precision.
    void evaluate_rounded(const BoundaryView& boundary, const FlowParameters& parameters);
    /// Writes R in double precision.
    void widen(const ResidualView& out) const;

  private:
    exchange::Layout wide_;  // of the double fields
    GridView grid_;
    exchange::Buffer<float> values_;
    SingleStateView state_;
    SingleResidualView residual_;
};

}  // namespace hemoflux::fluid

/// The cells and weights of every marker: one object, computed once per step, serves interpolation and
/// spreading, so that the two are adjoint by construction:
///
///   V_m = sum_c w_mc u_c,   f_c = sum_m F_m w_mc / V_c,   w_mc = wx wy wz over 4 x 4 x 4 cells      (5.15)
#pragma once

#include <cstddef>

#include "coupling/cell_grid.hpp"
#include "coupling/delta_kernel.hpp"
#include "exchange/buffer.hpp"
#include "exchange/macros.hpp"

namespace hemoflux::coupling {

/// Cells and weights of one marker, kept together because both uses read all of it at once.
struct Stencil {
    /// weight[axis][a] belongs to cell (first[axis] + a) mod n on that axis.
    double weight[3][stencil_width];
    /// Lowest cell, 0 .. n-1.
    int first[3];
    /// Whether the cells along x run over the periodic seam, so that they are not neighbours in memory.
    bool wraps_x;
    /// Whether the marker lies outside the domain or is not a number; its weights are then those of the lower
    /// or upper end.
    bool lost;
};

/// The stencils of a fixed number of markers.
class StencilSet {
  public:
    /// `grid` must outlive this object.
    StencilSet(const CellGrid& grid, Kernel kernel, std::size_t markers);

    /// Recomputes all stencils for markers at x[m], y[m], z[m] (device, um); on periodic axes markers may be
    /// anywhere, they are wrapped.
    void update(const double* x, const double* y, const double* z);
    /// Index of the first marker that was outside the domain or NaN at the last update; size() if there is
    /// none.
    [[nodiscard]] std::size_t first_lost() const;

    /// Number of markers.
    [[nodiscard]] std::size_t size() const { return stencils_.size(); }
    /// The stencils, device memory.
    [[nodiscard]] const Stencil* data() const { return stencils_.data(); }
    /// The grid they belong to.
    [[nodiscard]] CellGridView grid() const { return grid_.view(); }

  private:
    const CellGrid& grid_;
    Kernel kernel_;
    exchange::Buffer<Stencil> stencils_;
};

}  // namespace hemoflux::coupling

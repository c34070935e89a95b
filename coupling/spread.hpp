/// Forces of the markers spread to the cells: f_c = sum_m F_m w_mc / V_c  (5.5), F_m the total force of
/// marker m.
///
/// Each task owns a tile of rows and gathers from the markers whose stencil may reach it, which are found by
/// a counting sort on the lowest cell of their stencils. No atomics; every cell adds its markers in an order
/// that depends on their positions and numbers only.
#pragma once

#include <cstddef>

#include "coupling/stencil.hpp"
#include "coupling/tiles.hpp"
#include "exchange/buffer.hpp"
#include "exchange/field.hpp"

namespace hemoflux::coupling {

/// Spreads forces of one set of markers into one force field, alone or after others; keeps the memory it needs between
/// steps.
class Spreader {
  public:
    /// For the markers of `stencils`, which must outlive this object. With `first`, another spreader that must outlive
    /// it too, it adds to what that one has spread in the same step.
    explicit Spreader(const StencilSet& stencils, Spreader* first = nullptr);

    /// Sets `density` (padded vector field, interior cells; force per volume in the unit of factor * force /
    /// um^3) to the spread of factor * (fx, fy, fz)[m] (device), or adds it. Cells that no stencil reaches become zero.
    /// Always pass the same field, and let nobody else write to it: cells untouched twice in a row are not
    /// cleared again.
    void spread(const double* fx, const double* fy, const double* fz, double factor,
                const exchange::FieldView& density);
    /// u += dt f / rho in the cells that the last spread has reached, f the field it was given.
    void accelerate(double dt, const exchange::FieldView& density, const FluidFields& fluid) const;
    /// Makes the next spread clear the whole field, after somebody else wrote to it.
    void forget();

  private:
    const StencilSet& stencils_;
    Spreader* first_;
    Tiles tiles_;
    std::size_t chunk_, chunks_;
    /// Markers ordered by tile; where each (tile, chunk) begins; counts and cursors of the sort; tiles not
    /// zero.
    exchange::Buffer<int> order_, start_, cursor_, touched_;
};

}  // namespace hemoflux::coupling

/// Shares out the rows of a grid among tiles. Only kernel sources include this header.
#pragma once

#include <algorithm>

#include "exchange/parallel.hpp"
#include "fluid/tile_residual.hpp"

namespace hemoflux::fluid {

/// Tiles for `threads` threads: as tall as can be, for what two tiles share is computed twice, but enough of
/// them for every thread.
template <class F, class Real>
void launch_tiles(const Balance<F, Real>& balance) {
    const auto& n = balance.grid.layout.n;
    const Split sx(n[0], max_segment, exchange::row_alignment), sy(n[1], max_rows, 1);
    const auto threads = static_cast<std::size_t>(exchange::threads());
    constexpr std::size_t tiles_per_thread = 4, least_planes = 4;
    const std::size_t wanted = threads == 1 ? 1 : tiles_per_thread * threads / (sx.pieces * sy.pieces) + 1;
    const Split sz(n[2], std::max((n[2] + wanted - 1) / wanted, least_planes), 1);
    exchange::for_each_index(sx.pieces * sy.pieces * sz.pieces, TileResidual<F, Real>{balance, sx, sy, sz});
}

/// The same for cells that are no cubes, in a source file of its own: what helps the compiler there is not what helps it
/// with cubes. Viscosity, Force and Preconditioned: see Features.
template <bool Viscosity, bool Force, bool Preconditioned>
void launch_stretched_tiles(const Balance<Features<false, Viscosity, Force, Preconditioned>>& balance);

}  // namespace hemoflux::fluid

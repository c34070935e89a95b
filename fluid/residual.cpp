#include "fluid/residual.hpp"

#include <algorithm>
#include <stdexcept>

#include "exchange/parallel.hpp"
#include "fluid/cell_residual.hpp"
#include "fluid/tile_residual.hpp"

namespace hemoflux::fluid {
namespace {

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

template <class F>
struct ByTiles {
    static void launch(const Balance<F>& balance) {
        if constexpr (!exchange::on_gpu) launch_tiles(balance);
    }
};

template <class F>
struct ByCells {
    static void launch(const Balance<F>& balance) {
        exchange::for_each_index(balance.grid.layout.cells(), CellResidual<F>{balance});
    }
};

/// Turns the run-time choices into template arguments, one at a time.
template <template <class> class Arrangement, bool... Chosen, class... Rest>
void dispatch(const GridView& grid, const StateView& state, const BoundaryView& boundary,
              const FlowParameters& parameters, const ResidualView& out, Rest... rest) {
    if constexpr (sizeof...(Rest) == 0) {
        using F = Features<Chosen...>;
        Arrangement<F>::launch(Balance<F>{grid, state, boundary, parameters, out, 1 / parameters.gamma});
    } else {
        const auto next = [&](bool first, auto... others) {
            if (first)
                dispatch<Arrangement, Chosen..., true>(grid, state, boundary, parameters, out, others...);
            else
                dispatch<Arrangement, Chosen..., false>(grid, state, boundary, parameters, out, others...);
        };
        next(rest...);
    }
}

}  // namespace

void evaluate_residual(const GridView& grid, const StateView& state, const BoundaryView& boundary,
                       const FlowParameters& p, const ResidualView& out) {
    if constexpr (exchange::on_gpu)
        evaluate_residual_by_cell(grid, state, boundary, p, out);
    else
        dispatch<ByTiles>(grid, state, boundary, p, out, grid.delta > 0, p.with_viscosity, p.with_force,
                          p.gamma != 1);
}

void evaluate_residual(const GridView& grid, const SingleStateView& state, const BoundaryView& boundary,
                       const FlowParameters& p, const SingleResidualView& out) {
    if (exchange::on_gpu || grid.delta == 0 || p.with_viscosity || p.with_force)
        throw std::invalid_argument("evaluate_residual: no single precision for this case");
    if constexpr (!exchange::on_gpu) {
        if (p.gamma != 1)
            launch_tiles(Balance<Features<true, false, false, true>, float>{grid, state, boundary, p, out,
                                                                            1 / p.gamma});
        else
            launch_tiles(
                Balance<Features<true, false, false, false>, float>{grid, state, boundary, p, out, 1});
    }
}

void evaluate_residual_by_cell(const GridView& grid, const StateView& state, const BoundaryView& boundary,
                               const FlowParameters& p, const ResidualView& out) {
    dispatch<ByCells, false>(grid, state, boundary, p, out, p.with_viscosity, p.with_force, p.gamma != 1);
}

}  // namespace hemoflux::fluid

#include "fluid/residual.hpp"

#include "exchange/parallel.hpp"
#include "fluid/cell_residual.hpp"
#include "fluid/tile_residual.hpp"

namespace hemoflux::fluid {
namespace {

enum class Arrangement { tiles, cells };

template <class F>
void launch(Arrangement arrangement, const Balance<F>& balance) {
    const auto& n = balance.grid.layout.n;
    if constexpr (!exchange::on_gpu) {
        if (arrangement == Arrangement::tiles) {
            const Split sx(n[0], max_segment, exchange::row_alignment, false), sy(n[1], max_rows, 1, true),
                sz(n[2], max_rows, 1, true);
            exchange::for_each_index(sx.pieces * sy.pieces * sz.pieces, TileResidual<F>{balance, sx, sy, sz});
            return;
        }
    }
    exchange::for_each_index(n[0] * n[1] * n[2], CellResidual<F>{balance});
}

/// Turns the run-time choices into template arguments, one at a time.
template <bool... Chosen, class... Rest>
void dispatch(Arrangement arrangement, const GridView& grid, const StateView& state,
              const BoundaryView& boundary, const FlowParameters& parameters, const ResidualView& out,
              Rest... rest) {
    if constexpr (sizeof...(Rest) == 0) {
        launch(arrangement,
               Balance<Features<Chosen...>>{grid, state, boundary, parameters, out, 1 / parameters.gamma});
    } else {
        const auto next = [&](bool first, auto... others) {
            if (first)
                dispatch<Chosen..., true>(arrangement, grid, state, boundary, parameters, out, others...);
            else
                dispatch<Chosen..., false>(arrangement, grid, state, boundary, parameters, out, others...);
        };
        next(rest...);
    }
}

}  // namespace

void evaluate_residual(const GridView& grid, bool uniform, const StateView& state,
                       const BoundaryView& boundary, const FlowParameters& p, const ResidualView& out) {
    dispatch<>(Arrangement::tiles, grid, state, boundary, p, out, uniform, p.with_viscosity, p.with_force,
               p.gamma != 1);
}

void evaluate_residual_by_cell(const GridView& grid, bool uniform, const StateView& state,
                               const BoundaryView& boundary, const FlowParameters& p,
                               const ResidualView& out) {
    dispatch<>(Arrangement::cells, grid, state, boundary, p, out, uniform, p.with_viscosity, p.with_force,
               p.gamma != 1);
}

}  // namespace hemoflux::fluid

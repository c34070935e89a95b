#include "fluid/residual.hpp"

#include <stdexcept>

#include "fluid/cell_residual.hpp"
#include "fluid/launch_tiles.hpp"

namespace hemoflux::fluid {
namespace {

template <class F>
struct ByTiles {
    static void launch(const Balance<F>& balance) {
        if constexpr (!exchange::on_gpu) {
            if constexpr (F::cubic)
                launch_tiles(balance);
            else
                launch_stretched_tiles(balance);
        }
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

#include "fluid/border_flux.hpp"

#include "exchange/parallel.hpp"
#include "fluid/cell_residual.hpp"

namespace hemoflux::fluid {
namespace {

struct Momentum {
    Vec3d value{0, 0, 0};
    HEMOFLUX_FN Momentum& operator+=(const Momentum& b) {
        value += b.value;
        return *this;
    }
};

/// Flux times area, outwards, through face number `face` of one side.
template <class F, int Axis>
struct SideFace {
    static constexpr int low = Axis == 0 ? 1 : 0, high = Axis == 2 ? 1 : 2;  ///< the other axes
    CellResidual<F> cells;
    bool upper;

    HEMOFLUX_FN Momentum operator()(std::size_t face) const {
        const GridView& grid = cells.balance.grid;
        const std::size_t n = grid.layout.n[low];
        std::ptrdiff_t ijk[3];
        ijk[low] = static_cast<std::ptrdiff_t>(face % n);
        ijk[high] = static_cast<std::ptrdiff_t>(face / n);
        ijk[Axis] = upper ? static_cast<std::ptrdiff_t>(grid.layout.n[Axis]) - 1 : -1;
        const Quad<double> q = cells.template face<Axis>(ijk[0], ijk[1], ijk[2]);
        const double area =
            (upper ? 1 : -1) / (grid.axis[low].inverse[ijk[low]] * grid.axis[high].inverse[ijk[high]]);
        return {area * Vec3d{q.c[1], q.c[2], q.c[3]}};
    }
};

template <class F, int Axis>
void sum_sides(const CellResidual<F>& cells, std::array<Vec3d, 6>& out) {
    if (cells.balance.boundary.periodic[Axis]) return;
    const auto& n = cells.balance.grid.layout.n;
    using Face = SideFace<F, Axis>;
    exchange::Reduction<Momentum> reduction;
    for (std::size_t side = 0; side < 2; ++side)
        out[2 * Axis + side] = reduction.sum(n[Face::low] * n[Face::high], Face{cells, side == 1}).value;
}

template <bool Viscosity, bool Force>
std::array<Vec3d, 6> all_sides(const GridView& grid, const StateView& state, const BoundaryView& boundary,
                               const FlowParameters& p) {
    using F = Features<false, Viscosity, Force, true>;
    const CellResidual<F> cells{Balance<F>{grid, state, boundary, p, {}, 1 / p.gamma}};
    std::array<Vec3d, 6> out;
    out.fill({0, 0, 0});
    sum_sides<F, 0>(cells, out);
    sum_sides<F, 1>(cells, out);
    sum_sides<F, 2>(cells, out);
    return out;
}

}  // namespace

std::array<Vec3d, 6> border_momentum(const GridView& grid, const StateView& state,
                                     const BoundaryView& boundary, const FlowParameters& p) {
    if (p.with_viscosity)
        return p.with_force ? all_sides<true, true>(grid, state, boundary, p)
                            : all_sides<true, false>(grid, state, boundary, p);
    return p.with_force ? all_sides<false, true>(grid, state, boundary, p)
                        : all_sides<false, false>(grid, state, boundary, p);
}

}  // namespace hemoflux::fluid

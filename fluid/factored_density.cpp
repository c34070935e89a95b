// The implicit density of the AF scheme (see factored.hpp).
#include "fluid/line_solver.hpp"
#include "fluid/row_kernel.hpp"

namespace hemoflux::fluid {
namespace {

using exchange::load;
using exchange::Pack;

/// r[0] <- r[0] - div r[1..3], with values on the faces linear between the centres. Adds the mass that the increments of
/// momentum carry to what the residual says of the old momentum.
struct NewMassFlux : RowKernel {
    GridView grid;
    ResidualView r;

    HEMOFLUX_FN void operator()(std::size_t row, std::size_t pack) const {
        const std::size_t i = at(row, pack), x = pack * exchange::lanes<Pack>;
        const AxisView& ax = grid.axis[0];
        const double* weight = ax.weight_left + x;
        const Pack low = load<Pack>(weight - 1), high = load<Pack>(weight), u = load<Pack>(r.r[1] + i);
        const Pack below = low * load<Pack>(r.r[1] + i - 1) + (1.0 - low) * u;
        const Pack above = high * u + (1.0 - high) * load<Pack>(r.r[1] + i + 1);
        Pack divergence = (above - below) * load<Pack>(ax.inverse + x);
        const std::size_t index[2] = {row % layout.n[1], row / layout.n[1]};
        const std::size_t stride[2] = {layout.row, layout.plane};
        for (int a = 0; a < 2; ++a) {
            const AxisView& axis = grid.axis[a + 1];
            const double* w = axis.weight_left + index[a];
            const double* q = r.r[a + 2] + i;
            const Pack v = load<Pack>(q);
            const Pack from = w[-1] * load<Pack>(q - stride[a]) + (1 - w[-1]) * v;
            const Pack to = w[0] * v + (1 - w[0]) * load<Pack>(q + stride[a]);
            divergence = divergence + (to - from) * axis.inverse[index[a]];
        }
        exchange::store_first(r.r[0] + i, load<Pack>(r.r[0] + i) - divergence, count(pack));
    }
};

}  // namespace

void Factored::solve_density(const GridView& grid, const Boundary& boundary, const ResidualView& r) const {
    boundary.fill_increments(grid, {r.r[1], r.r[2], r.r[3]});
    exchange::for_each_row(layout_.n[1] * layout_.n[2], packs_per_row(layout_),
                           NewMassFlux{{layout_}, grid, r}, exchange::Cost::cheap);
    solve_factors<1>(layout_, [&](std::size_t axis) {
        return Lines<1>{layout_, {r.r[0]}, {density_factors_[axis]}, 1.0};
    });
}

}  // namespace hemoflux::fluid

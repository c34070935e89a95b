#include "fluid/local_step.hpp"

#include "exchange/parallel.hpp"
#include "fluid/row_kernel.hpp"

namespace hemoflux::fluid {
namespace {

struct LocalStepRow : RowKernel {
    GridView grid;
    StateView state;
    LocalStepParameters p;
    double* dt;

    HEMOFLUX_FN void operator()(std::size_t row, std::size_t pack) const {
        const std::size_t first = pack * exchange::lanes<exchange::Pack>;
        for (std::size_t l = 0; l < exchange::lanes<exchange::Pack> && first + l < layout.n[0]; ++l) {
            const std::size_t i = at(row, pack) + l,
                              index[3] = {first + l, row % layout.n[1], row / layout.n[1]};
            const double nu = state.nu ? state.nu[i] : p.nu;
            double rate = 0;
            for (int a = 0; a < 3; ++a) {
                if (layout.n[a] == 1) continue;
                const double area = grid.axis[a].inverse[index[a]];  // S_a / V
                rate +=
                    area * (convective_radius(state.q[1 + a][i], p.gamma) + 2 * p.c * nu * area / p.gamma);
            }
            dt[i] = p.sigma / rate;
        }
    }
};

}  // namespace

void local_steps(const GridView& grid, const StateView& state, const LocalStepParameters& parameters,
                 double* dt) {
    const exchange::Layout& layout = grid.layout;
    exchange::for_each_row(layout.n[1] * layout.n[2], packs_per_row(layout),
                           LocalStepRow{{layout}, grid, state, parameters, dt}, exchange::Cost::cheap);
}

}  // namespace hemoflux::fluid

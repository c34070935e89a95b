#include "fluid/update.hpp"

#include "exchange/pack.hpp"
#include "exchange/parallel.hpp"
#include "fluid/row_kernel.hpp"

namespace hemoflux::fluid {
namespace {

using exchange::load;
using exchange::Pack;

struct UpdateRow : RowKernel {
    StateView base, state;
    ResidualView r, sum;
    UpdateParameters p;

    HEMOFLUX_FN void operator()(std::size_t row, std::size_t pack) const {
        const std::size_t i = at(row, pack);
        const std::ptrdiff_t n = count(pack);
        const Pack rho = load<Pack>(base.q[0] + i);
        const Pack step = p.local_dt ? p.a * load<Pack>(p.local_dt + i) : Pack(p.a);
        Pack increment[4];
        for (int c = 0; c < 4; ++c) {
            const Pack rate = load<Pack>(r.r[c] + i);
            increment[c] = step * rate;
            if (p.accumulate || p.use_sum) {
                Pack total = p.w * rate;
                if (!p.first) total = total + load<Pack>(sum.r[c] + i);
                if (p.accumulate) exchange::store_first(sum.r[c] + i, total, n);
                if (p.use_sum) increment[c] = step * total;
            }
        }
        const Pack new_rho = rho + increment[0];
        for (int c = 1; c < 4; ++c) {
            const Pack v = (rho * load<Pack>(base.q[c] + i) + increment[c]) / new_rho;
            exchange::store_first(state.q[c] + i, v, n);
        }
        exchange::store_first(state.q[0] + i, new_rho, n);
    }
};

struct UpdateFactoredRow : RowKernel {
    StateView state;
    ResidualView r;
    double dt;

    HEMOFLUX_FN void operator()(std::size_t row, std::size_t pack) const {
        const std::size_t i = at(row, pack);
        const std::ptrdiff_t n = count(pack);
        const Pack rho = load<Pack>(state.q[0] + i);
        const Pack new_rho = rho + dt * load<Pack>(r.r[0] + i);
        for (int c = 1; c < 4; ++c) {
            const Pack v = (rho * load<Pack>(state.q[c] + i) + load<Pack>(r.r[c] + i)) / new_rho;
            exchange::store_first(state.q[c] + i, v, n);
        }
        exchange::store_first(state.q[0] + i, new_rho, n);
    }
};

}  // namespace

void update(const exchange::Layout& layout, const StateView& base, const ResidualView& r,
            const ResidualView& sum, const UpdateParameters& parameters, const StateView& state) {
    exchange::for_each_row(layout.n[1] * layout.n[2], packs_per_row(layout),
                           UpdateRow{{layout}, base, state, r, sum, parameters}, exchange::Cost::cheap);
}

void update_factored(const exchange::Layout& layout, const ResidualView& r, double dt,
                     const StateView& state) {
    exchange::for_each_row(layout.n[1] * layout.n[2], packs_per_row(layout),
                           UpdateFactoredRow{{layout}, state, r, dt}, exchange::Cost::cheap);
}

}  // namespace hemoflux::fluid

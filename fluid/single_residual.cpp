#include "fluid/single_residual.hpp"

#include <stdexcept>

#include "exchange/parallel.hpp"

namespace hemoflux::fluid {
namespace {

using exchange::Layout;

/// Rows for packs of `align` values.
Layout padded(const Layout& wide, std::size_t align) {
    Layout l = wide;
    l.row = exchange::round_up(align + l.n[0] + exchange::ghosts, align) + align;
    l.plane = l.row * (l.n[1] + 2 * exchange::ghosts);
    l.origin = align + exchange::ghosts * l.row + exchange::ghosts * l.plane;
    l.size = l.plane * (l.n[2] + 2 * exchange::ghosts);
    return l;
}

/// Rounds one row of all fields, ghosts too.
struct Round {
    Layout from, to;
    StateView wide;
    SingleStateView narrow;

    HEMOFLUX_FN void operator()(std::size_t row) const {
        constexpr auto g = static_cast<std::ptrdiff_t>(exchange::ghosts);
        const std::size_t rows = from.n[1] + 2 * exchange::ghosts;
        const auto j = static_cast<std::ptrdiff_t>(row % rows) - g,
                   k = static_cast<std::ptrdiff_t>(row / rows) - g;
        for (int c = 0; c < 4; ++c) {
            const double* in = wide.q[c] + from.at(-g, j, k);
            float* out = narrow.q[c] + to.at(-g, j, k);
            const double reference = c == 0 ? 1 : 0;
            for (std::size_t i = 0; i < from.n[0] + 2 * exchange::ghosts; ++i)
                out[i] = static_cast<float>(in[i] - reference);
        }
    }
};

/// Widens one interior row of all components.
struct Widen {
    Layout from, to;
    SingleResidualView narrow;
    ResidualView wide;

    HEMOFLUX_FN void operator()(std::size_t row) const {
        const auto j = static_cast<std::ptrdiff_t>(row % from.n[1]),
                   k = static_cast<std::ptrdiff_t>(row / from.n[1]);
        for (int c = 0; c < 4; ++c) {
            const float* in = narrow.r[c] + from.at(0, j, k);
            double* out = wide.r[c] + to.at(0, j, k);
            for (std::size_t i = 0; i < from.n[0]; ++i) out[i] = static_cast<double>(in[i]);
        }
    }
};

}  // namespace

SingleResidual::SingleResidual(const GridView& grid) : wide_(grid.layout), grid_(grid) {
    if (grid.delta == 0) throw std::invalid_argument("SingleResidual: the cells are not cubes");
    grid_.layout = padded(wide_, exchange::lanes<exchange::SinglePack>);
    const std::size_t size = grid_.layout.size;
    values_ = exchange::Buffer<float>(8 * size);
    for (std::size_t c = 0; c < 4; ++c) {
        state_.q[c] = values_.data() + c * size;
        residual_.r[c] = values_.data() + (4 + c) * size;
    }
}

void SingleResidual::evaluate(const StateView& state, const BoundaryView& boundary,
                              const FlowParameters& parameters, const ResidualView& out) {
    round(state);
    evaluate_rounded(boundary, parameters);
    widen(out);
}

void SingleResidual::round(const StateView& state) {
    const auto& n = wide_.n;
    exchange::for_each_index((n[1] + 2 * exchange::ghosts) * (n[2] + 2 * exchange::ghosts),
                             Round{wide_, grid_.layout, state, state_});
}

void SingleResidual::evaluate_rounded(const BoundaryView& boundary, const FlowParameters& parameters) {
    evaluate_residual(grid_, state_, boundary, parameters, residual_);
}

void SingleResidual::widen(const ResidualView& out) const {
    exchange::for_each_index(wide_.n[1] * wide_.n[2], Widen{grid_.layout, wide_, residual_, out});
}

}  // namespace hemoflux::fluid

// Kernels that fill ghost cells: x for interior rows, then y rows with their x ghosts, then z rows with all
// ghosts.
#include "exchange/pack.hpp"
#include "exchange/parallel.hpp"
#include "fluid/boundary.hpp"

namespace hemoflux::fluid {
namespace {

using exchange::ghosts;
using exchange::Layout;
using exchange::Pack;

/// Index of the cell a ghost takes its value from: layer 0 is next to the boundary.
HEMOFLUX_INLINE std::ptrdiff_t source_cell(std::ptrdiff_t n, int side, std::ptrdiff_t layer, bool periodic) {
    if (periodic) {
        const std::ptrdiff_t i = side == 0 ? n - 1 - layer : layer;
        return ((i % n) + n) % n;
    }
    const std::ptrdiff_t inner = layer < n ? layer : n - 1;
    return side == 0 ? inner : n - 1 - inner;
}

/// A few fields that share an axis' ghost fill.
template <int Fields>
struct Ghosts {
    Layout layout;
    double* field[Fields];
    BoundaryView boundary;

    HEMOFLUX_INLINE std::ptrdiff_t n(int axis) const { return static_cast<std::ptrdiff_t>(layout.n[axis]); }
    HEMOFLUX_INLINE static std::ptrdiff_t ghost_cell(std::ptrdiff_t count, int side, std::ptrdiff_t layer) {
        return side == 0 ? -1 - layer : count + layer;
    }
};

/// x ghosts of one interior row.
template <int Fields>
struct FillX : Ghosts<Fields> {
    HEMOFLUX_FN void operator()(std::size_t row) const {
        const auto j = static_cast<std::ptrdiff_t>(row % this->layout.n[1]);
        const auto k = static_cast<std::ptrdiff_t>(row / this->layout.n[1]);
        for (int side = 0; side < 2; ++side)
            for (int f = 0; f < Fields; ++f) {
                const GhostRule& r = this->boundary.rule[side][f];
                const double b = r.value ? r.value[static_cast<std::ptrdiff_t>(r.pitch) * k + j] : 0.0;
                for (std::ptrdiff_t l = 0; l < static_cast<std::ptrdiff_t>(ghosts); ++l) {
                    const std::ptrdiff_t from = source_cell(this->n(0), side, l, this->boundary.periodic[0]);
                    const std::ptrdiff_t to = this->ghost_cell(this->n(0), side, l);
                    this->field[f][this->layout.at(to, j, k)] =
                        r.sign * this->field[f][this->layout.at(from, j, k)] + r.offset[l] * b;
                }
            }
    }
};

/// One pack of one y or z ghost row. Rows are numbered (side, layer, other index), x runs over all ghosts.
template <int Fields, int Axis>
struct FillRow : Ghosts<Fields> {
    HEMOFLUX_FN void operator()(std::size_t row, std::size_t pack) const {
        constexpr auto g = static_cast<std::ptrdiff_t>(ghosts);
        const std::ptrdiff_t others = Axis == 1 ? this->n(2) : this->n(1) + 2 * g;
        const auto index = static_cast<std::ptrdiff_t>(row);
        const std::ptrdiff_t other = index % others - (Axis == 1 ? 0 : g), l = index / others % g;
        const int side = static_cast<int>(index / (others * g));
        const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(pack * exchange::lanes<Pack>) - g;
        const std::ptrdiff_t from = source_cell(this->n(Axis), side, l, this->boundary.periodic[Axis]);
        const std::ptrdiff_t to = this->ghost_cell(this->n(Axis), side, l);
        const std::size_t a = Axis == 1 ? this->layout.at(i, from, other) : this->layout.at(i, other, from);
        const std::size_t b = Axis == 1 ? this->layout.at(i, to, other) : this->layout.at(i, other, to);
        for (int f = 0; f < Fields; ++f) {
            const GhostRule& r = this->boundary.rule[2 * Axis + side][f];
            Pack value = r.sign * exchange::load<Pack>(this->field[f] + a);
            if (r.value)
                value = value + r.offset[l] * exchange::load<Pack>(
                                                  r.value + static_cast<std::ptrdiff_t>(r.pitch) * other + i);
            exchange::store(this->field[f] + b, value);
        }
    }
};

template <int Fields>
void fill_all(const Ghosts<Fields>& ghosts_of) {
    const Layout& l = ghosts_of.layout;
    const std::size_t packs =
        exchange::round_up(l.n[0] + 2 * ghosts, exchange::lanes<Pack>) / exchange::lanes<Pack>;
    using exchange::Cost;
    exchange::for_each_index(l.n[1] * l.n[2], FillX<Fields>{ghosts_of}, Cost::cheap);
    exchange::for_each_row(2 * ghosts * l.n[2], packs, FillRow<Fields, 1>{ghosts_of}, Cost::cheap);
    exchange::for_each_row(2 * ghosts * (l.n[1] + 2 * ghosts), packs, FillRow<Fields, 2>{ghosts_of},
                           Cost::cheap);
}

/// Copies the border cell (or wraps): what force and viscosity need.
template <int Fields>
Ghosts<Fields> copies(const Layout& layout, const BoundaryView& boundary) {
    Ghosts<Fields> g{layout, {}, {}};
    for (int a = 0; a < 3; ++a) g.boundary.periodic[a] = boundary.periodic[a];
    return g;
}

}  // namespace

void Boundary::fill(const GridView& grid, const StateView& state) const {
    fill_all(Ghosts<4>{grid.layout, {state.q[0], state.q[1], state.q[2], state.q[3]}, view_});
}

void Boundary::fill_increments(const GridView& grid, const std::array<double*, 3>& increments) const {
    auto g = copies<3>(grid.layout, view_);
    for (int c = 0; c < 3; ++c) {
        g.field[c] = increments[static_cast<std::size_t>(c)];
        for (int p = 0; p < 6; ++p) g.boundary.rule[p][c].sign = view_.rule[p][1 + c].sign;
    }
    fill_all(g);
}

void Boundary::fill_force(const GridView& grid, const StateView& state) const {
    auto g = copies<3>(grid.layout, view_);
    for (int c = 0; c < 3; ++c) g.field[c] = state.force[c];
    fill_all(g);
}

void Boundary::fill_viscosity(const GridView& grid, const StateView& state) const {
    auto g = copies<1>(grid.layout, view_);
    g.field[0] = state.nu;
    fill_all(g);
}

}  // namespace hemoflux::fluid

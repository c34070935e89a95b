#include "fluid/residual.hpp"

#include "exchange/pack.hpp"
#include "exchange/parallel.hpp"
#include "fluid/face.hpp"

namespace hemoflux::fluid {
namespace {

using exchange::lanes;
using exchange::load;
using exchange::Pack;

/// Longest piece of an x row, and most rows each way, that a tile covers.
constexpr std::size_t max_segment = 128, max_rows = 16;

/// Even split of n cells into pieces of at most `most`; the number of pieces never depends on the thread
/// count.
struct Split {
    std::size_t pieces, size, n;
    Split(std::size_t count, std::size_t most, std::size_t multiple, bool even) : n(count) {
        pieces = (n + most - 1) / most;
        if (even && pieces > 1) pieces += pieces % 2;
        size = exchange::round_up((n + pieces - 1) / pieces, multiple);
        pieces = (n + size - 1) / size;
    }
    HEMOFLUX_INLINE std::ptrdiff_t first(std::size_t p) const {
        return static_cast<std::ptrdiff_t>(p * size);
    }
    HEMOFLUX_INLINE std::ptrdiff_t last(std::size_t p) const {
        return static_cast<std::ptrdiff_t>((p + 1) * size < n ? (p + 1) * size : n);
    }
};

/// Data shared by both arrangements.
template <class F>
struct Residual {
    GridView grid;
    StateView state;
    BoundaryView boundary;
    FlowParameters parameters;
    ResidualView out;
    double inv_gamma;

    template <class Value, int Axis>
    HEMOFLUX_INLINE Quad<Value> flux(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t k) const {
        const FaceLoader<F, Value, Axis> loader{grid, state, parameters, inv_gamma};
        const std::ptrdiff_t ijk[3] = {i, j, k};
        Quad<Value> q = loader.flux(grid.layout.at(i, j, k), ijk);
        return q;
    }

    /// Replaces the mass flux on a border face whose normal velocity is given. face: index of the cell below
    /// the face.
    template <class Value, int Axis>
    HEMOFLUX_INLINE void prescribe_mass(Quad<Value>& q, std::ptrdiff_t face, std::ptrdiff_t a,
                                        std::ptrdiff_t b) const {
        const auto n = static_cast<std::ptrdiff_t>(grid.layout.n[Axis]);
        if (face != -1 && face != n - 1) return;
        const MassFluxView& m = boundary.mass_flux[2 * Axis + (face == -1 ? 0 : 1)];
        if (m.value) q.c[0] = load<Value>(m.value + static_cast<std::ptrdiff_t>(m.pitch) * b + a);
    }

    /// R of the cells at (i, j, k) from their six face fluxes.
    template <class Value>
    HEMOFLUX_INLINE void write(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t k, std::ptrdiff_t count,
                               const Quad<Value>& xl, const Quad<Value>& xr, const Quad<Value>& yl,
                               const Quad<Value>& yr, const Quad<Value>& zl, const Quad<Value>& zr) const {
        const Value inv_dx =
            F::uniform ? Value(grid.axis[0].inverse[0]) : load<Value>(grid.axis[0].inverse + i);
        const double inv_dy = grid.axis[1].inverse[j], inv_dz = grid.axis[2].inverse[k];
        const std::size_t at = grid.layout.at(i, j, k);
        for (int c = 0; c < 4; ++c) {
            Value r =
                (xl.c[c] - xr.c[c]) * inv_dx + (yl.c[c] - yr.c[c]) * inv_dy + (zl.c[c] - zr.c[c]) * inv_dz;
            if constexpr (F::force) {
                if (c > 0) {
                    Value f = load<Value>(state.force[c - 1] + at);
                    if constexpr (F::preconditioned) f = f * inv_gamma;
                    r = r + f;
                }
            }
            exchange::store_first(out.r[c] + at, r, count);
        }
    }
};

/// One tile of rows. Fluxes through low y and z faces come from buffers; those on the tile's low border are
/// recomputed.
template <class F>
struct TileResidual {
    Residual<F> residual;
    Split sx, sy, sz;

    using Row = double[4][max_segment + 2 * exchange::row_alignment];
    static constexpr auto w = static_cast<std::ptrdiff_t>(lanes<Pack>);

    template <int Axis>
    HEMOFLUX_INLINE void fill(Row& row, std::ptrdiff_t i0, std::ptrdiff_t i1, std::ptrdiff_t j,
                              std::ptrdiff_t k) const {
        for (std::ptrdiff_t i = i0; i < i1; i += w) {
            Quad<Pack> q = residual.template flux<Pack, Axis>(i, j, k);
            residual.template prescribe_mass<Pack, Axis>(q, Axis == 1 ? j : k, i, Axis == 1 ? k : j);
            for (int c = 0; c < 4; ++c) exchange::store(&row[c][i - i0], q.c[c]);
        }
    }

    /// Fluxes through the x faces i0 - 1/2 .. i1 - 1/2 of one row.
    HEMOFLUX_INLINE void fill_x(Row& row, std::ptrdiff_t i0, std::ptrdiff_t i1, std::ptrdiff_t j,
                                std::ptrdiff_t k) const {
        std::ptrdiff_t i = i0 - 1;
        if ((i1 - i0) % w ==
            0) {  // one face more than whole packs: do it alone instead of as a nearly empty pack
            const Quad<double> q = residual.template flux<double, 0>(i, j, k);
            for (int c = 0; c < 4; ++c) row[c][0] = q.c[c];
            ++i;
        }
        for (; i < i1; i += w) {
            const Quad<Pack> q = residual.template flux<Pack, 0>(i, j, k);
            for (int c = 0; c < 4; ++c) exchange::store(&row[c][i - i0 + 1], q.c[c]);
        }
        Quad<double> mass{{row[0][0], 0, 0, 0}};
        residual.template prescribe_mass<double, 0>(mass, i0 - 1, j, k);
        row[0][0] = mass.c[0];
        mass.c[0] = row[0][i1 - i0];
        residual.template prescribe_mass<double, 0>(mass, i1 - 1, j, k);
        row[0][i1 - i0] = mass.c[0];
    }

    HEMOFLUX_FN void operator()(std::size_t tile) const {
        const std::size_t tx = tile % sx.pieces, ty = tile / sx.pieces % sy.pieces,
                          tz = tile / (sx.pieces * sy.pieces);
        const std::ptrdiff_t i0 = sx.first(tx), i1 = sx.last(tx), j0 = sy.first(ty), j1 = sy.last(ty),
                             k0 = sz.first(tz), k1 = sz.last(tz);
        Row x, y, z[max_rows];
        for (std::ptrdiff_t j = j0; j < j1; ++j) fill<2>(z[j - j0], i0, i1, j, k0 - 1);
        for (std::ptrdiff_t k = k0; k < k1; ++k) {
            fill<1>(y, i0, i1, j0 - 1, k);
            for (std::ptrdiff_t j = j0; j < j1; ++j) {
                fill_x(x, i0, i1, j, k);
                Row& zj = z[j - j0];
                for (std::ptrdiff_t i = i0; i < i1; i += w) {
                    Quad<Pack> yr = residual.template flux<Pack, 1>(i, j, k);
                    residual.template prescribe_mass<Pack, 1>(yr, j, i, k);
                    Quad<Pack> yl, xl, xr;
                    for (int c = 0; c < 4; ++c) {
                        yl.c[c] = load<Pack>(&y[c][i - i0]);
                        exchange::store(&y[c][i - i0], yr.c[c]);
                    }
                    Quad<Pack> zr = residual.template flux<Pack, 2>(i, j, k);
                    residual.template prescribe_mass<Pack, 2>(zr, k, i, j);
                    Quad<Pack> zl;
                    for (int c = 0; c < 4; ++c) {
                        zl.c[c] = load<Pack>(&zj[c][i - i0]);
                        exchange::store(&zj[c][i - i0], zr.c[c]);
                        xl.c[c] = load<Pack>(&x[c][i - i0]);
                        xr.c[c] = load<Pack>(&x[c][i - i0 + 1]);
                    }
                    residual.write(i, j, k, i1 - i, xl, xr, yl, yr, zl, zr);
                }
            }
        }
    }
};

/// One cell with its six faces.
template <class F>
struct CellResidual {
    Residual<F> residual;

    template <int Axis>
    HEMOFLUX_INLINE Quad<double> face(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t k) const {
        Quad<double> q = residual.template flux<double, Axis>(i, j, k);
        if constexpr (Axis == 0) residual.template prescribe_mass<double, 0>(q, i, j, k);
        if constexpr (Axis == 1) residual.template prescribe_mass<double, 1>(q, j, i, k);
        if constexpr (Axis == 2) residual.template prescribe_mass<double, 2>(q, k, i, j);
        return q;
    }

    HEMOFLUX_FN void operator()(std::size_t cell) const {
        const auto& n = residual.grid.layout.n;
        const auto i = static_cast<std::ptrdiff_t>(cell % n[0]),
                   j = static_cast<std::ptrdiff_t>(cell / n[0] % n[1]),
                   k = static_cast<std::ptrdiff_t>(cell / (n[0] * n[1]));
        residual.template write<double>(i, j, k, 1, face<0>(i - 1, j, k), face<0>(i, j, k),
                                        face<1>(i, j - 1, k), face<1>(i, j, k), face<2>(i, j, k - 1),
                                        face<2>(i, j, k));
    }
};

enum class Arrangement { tiles, cells };

template <class F>
void launch(Arrangement arrangement, const Residual<F>& residual) {
    const auto& n = residual.grid.layout.n;
    if constexpr (!exchange::on_gpu) {
        if (arrangement == Arrangement::tiles) {
            const Split sx(n[0], max_segment, exchange::row_alignment, false), sy(n[1], max_rows, 1, true),
                sz(n[2], max_rows, 1, true);
            exchange::for_each_index(sx.pieces * sy.pieces * sz.pieces,
                                     TileResidual<F>{residual, sx, sy, sz});
            return;
        }
    }
    exchange::for_each_index(n[0] * n[1] * n[2], CellResidual<F>{residual});
}

/// Turns the run-time choices into template arguments, one at a time.
template <bool... Chosen, class... Rest>
void dispatch(Arrangement arrangement, const GridView& grid, const StateView& state,
              const BoundaryView& boundary, const FlowParameters& parameters, const ResidualView& out,
              Rest... rest) {
    if constexpr (sizeof...(Rest) == 0) {
        launch(arrangement,
               Residual<Features<Chosen...>>{grid, state, boundary, parameters, out, 1 / parameters.gamma});
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

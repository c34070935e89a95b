/// The residual on the CPU: one task is a tile of rows, every face flux in it is computed once.
///
/// Rows are visited plane by plane. What faces share of a cell (cell_row.hpp) is computed as its row comes up;
/// then the fluxes through the row's x faces and through its lower y and z faces, which complete the balance
/// of the row below. Of the rows before, only the last of this plane's fluxes and the last plane is kept.
#pragma once

#include <type_traits>
#include <utility>

#include "exchange/pack.hpp"
#include "fluid/balance.hpp"
#include "fluid/cell_row.hpp"

namespace hemoflux::fluid {

/// Most rows of a tile in one plane.
constexpr std::size_t max_rows = 20;

/// Even split of n cells into pieces of at most `most`.
struct Split {
    std::size_t pieces, size, n;
    /// count cells in pieces whose size is a multiple of `multiple`, but for the last.
    Split(std::size_t count, std::size_t most, std::size_t multiple) : n(count) {
        pieces = (n + most - 1) / most;
        size = exchange::round_up((n + pieces - 1) / pieces, multiple);
        pieces = (n + size - 1) / size;
    }
    /// First cell of piece p.
    HEMOFLUX_INLINE std::ptrdiff_t first(std::size_t p) const {
        return static_cast<std::ptrdiff_t>(p * size);
    }
    /// One past its last cell.
    HEMOFLUX_INLINE std::ptrdiff_t last(std::size_t p) const {
        return static_cast<std::ptrdiff_t>((p + 1) * size < n ? (p + 1) * size : n);
    }
};

/// One tile of rows: cells i0 .. i1 - 1 of the rows j0 .. j1 - 1 in the planes k0 .. k1 - 1. Functions of one
/// row are compiled once and on their own, so that a flux is the same to the last bit in whatever tile it is
/// computed.
template <class F, class Real = double>
struct TileResidual {
    Balance<F, Real> balance;
    Split sx, sy, sz;

    using Pack = std::conditional_t<std::is_same_v<Real, float>, exchange::SinglePack, exchange::Pack>;
    using Cells = CellRow<F, Real>;
    static constexpr auto w = static_cast<std::ptrdiff_t>(exchange::lanes<Pack>);

    /// Fluxes through one kind of face of one row piece.
    struct Fluxes {
        alignas(64) Real values[4][Cells::pitch];
    };
    /// Cells i0 to i1 - 1 of a row.
    struct Range {
        std::ptrdiff_t i0, i1;
    };

    template <class Value>
    HEMOFLUX_INLINE void cell(Cells& row, const Range& r, std::ptrdiff_t i, std::ptrdiff_t j,
                              std::ptrdiff_t k) const {
        const std::ptrdiff_t ijk[3] = {i, j, k};
        row.template compute<Value>(balance.grid, balance.state, balance.inv_gamma, i - r.i0,
                                    balance.grid.layout.at(i, j, k), ijk);
    }

    /// The cells i0 .. i1 - 1 of one row.
    HEMOFLUX_NOINLINE void cells(Cells& row, Range r, std::ptrdiff_t j, std::ptrdiff_t k) const {
        for (std::ptrdiff_t i = r.i0; i < r.i1; i += w) cell<Pack>(row, r, i, j, k);
    }

    /// The cells i0 - 1 and i1 beside them, as far as they did not come with whole packs.
    HEMOFLUX_NOINLINE void end_cells(Cells& row, Range r, std::ptrdiff_t j, std::ptrdiff_t k) const {
        cell<Real>(row, r, r.i0 - 1, j, k);
        if ((r.i1 - r.i0) % w == 0) cell<Real>(row, r, r.i1, j, k);
    }

    template <class Value>
    HEMOFLUX_INLINE void x_flux(Fluxes& x, const Cells& row, const Range& r, std::ptrdiff_t i,
                                std::ptrdiff_t j, std::ptrdiff_t k) const {
        const std::ptrdiff_t left[3] = {i - 1, j, k};
        const Quad<Value> q =
            Cells::template flux<Value, 0>(balance.template loader<Value, 0>(), row, row, i - 1 - r.i0,
                                           balance.grid.layout.at(i - 1, j, k), left);
        for (int c = 0; c < 4; ++c) exchange::store(&x.values[c][i - r.i0], q.c[c]);
    }

    /// The mass flux through the lower x face of cell i, if that lies on the border and is given.
    HEMOFLUX_INLINE void prescribe_x(Fluxes& x, const Range& r, std::ptrdiff_t i, std::ptrdiff_t j,
                                     std::ptrdiff_t k) const {
        Quad<Real> mass;
        mass.c[0] = x.values[0][i - r.i0];
        balance.template prescribe_mass<Real, 0>(mass, i - 1, j, k);
        x.values[0][i - r.i0] = mass.c[0];
    }

    /// 1 / width of the cells from i on.
    HEMOFLUX_INLINE Pack inverse_width(std::ptrdiff_t i) const {
        const double* inverse = balance.grid.axis[0].inverse;
        Pack result = static_cast<Real>(inverse[0]);
        if constexpr (!F::cubic) {
            result = exchange::load<Pack>(inverse + i);
        }
        return result;
    }

    /// Fluxes through all x faces of one row, and what they and the body force give to R.
    HEMOFLUX_NOINLINE void x_faces(const Cells& row, Range r, std::ptrdiff_t j, std::ptrdiff_t k) const {
        Fluxes x;
        for (std::ptrdiff_t i = r.i0; i < r.i1; i += w) x_flux<Pack>(x, row, r, i, j, k);
        if ((r.i1 - r.i0) % w == 0) x_flux<Real>(x, row, r, r.i1, j, k);
        prescribe_x(x, r, r.i0, j, k);
        prescribe_x(x, r, r.i1, j, k);
        for (std::ptrdiff_t i = r.i0; i < r.i1; i += w) {
            const std::size_t at = balance.grid.layout.at(i, j, k);
            const Pack inv_dx = inverse_width(i);
            for (int c = 0; c < 4; ++c) {
                const Real* face = &x.values[c][i - r.i0];
                Pack rate = (exchange::load<Pack>(face) - exchange::load<Pack>(face + 1)) * inv_dx;
                if constexpr (F::force)
                    if (c > 0) rate = rate + balance.template source<Pack>(at, c);
                exchange::store_first(balance.out.r[c] + at, rate, r.i1 - i);
            }
        }
    }

    /// Fluxes through the faces between two rows, of which the upper is row (j, k); what they, with those
    /// through the other side of the lower row (in `kept`), give to R of the lower row, if `complete`; and
    /// keeps them for the upper row's turn.
    template <int Axis>
    HEMOFLUX_NOINLINE void faces(Fluxes& kept, const Cells& low, const Cells& high, Range r, std::ptrdiff_t j,
                                 std::ptrdiff_t k, bool complete) const {
        const std::ptrdiff_t lj = Axis == 1 ? j - 1 : j, lk = Axis == 2 ? k - 1 : k;
        const Pack inverse(Real(balance.grid.axis[Axis].inverse[Axis == 1 ? lj : lk]));
        for (std::ptrdiff_t i = r.i0; i < r.i1; i += w) {
            const std::ptrdiff_t left[3] = {i, lj, lk};
            const std::size_t at = balance.grid.layout.at(i, lj, lk);
            Quad<Pack> q = Cells::template flux<Pack, Axis>(balance.template loader<Pack, Axis>(), low, high,
                                                            i - r.i0, at, left);
            balance.template prescribe_mass<Pack, Axis>(q, Axis == 1 ? lj : lk, i, Axis == 1 ? k : j);
            for (int c = 0; c < 4; ++c) {
                Real* flux = &kept.values[c][i - r.i0];
                if (complete) {
                    const Pack rate = exchange::load<Pack>(balance.out.r[c] + at) +
                                      (exchange::load<Pack>(flux) - q.c[c]) * inverse;
                    exchange::store_first(balance.out.r[c] + at, rate, r.i1 - i);
                }
                exchange::store(flux, q.c[c]);
            }
        }
    }

    HEMOFLUX_FN void operator()(std::size_t tile) const {
        const std::size_t tx = tile % sx.pieces, ty = tile / sx.pieces % sy.pieces,
                          tz = tile / (sx.pieces * sy.pieces);
        const Range r{sx.first(tx), sx.last(tx)};
        const std::ptrdiff_t j0 = sy.first(ty), j1 = sy.last(ty), k0 = sz.first(tz), k1 = sz.last(tz);
        Cells rows[max_rows + 2], *fresh = &rows[max_rows + 1], *plane[max_rows + 1];
        Fluxes y, z[max_rows];
        for (std::size_t row = 0; row <= max_rows; ++row) plane[row] = &rows[row];
        // plane[0] is row j0 - 1 (later also row j1), plane[j - j0 + 1] row j
        for (std::ptrdiff_t j = j0; j < j1; ++j) cells(*plane[j - j0 + 1], r, j, k0 - 1);
        for (std::ptrdiff_t k = k0; k < k1; ++k) {
            cells(*plane[0], r, j0 - 1, k);
            for (std::ptrdiff_t j = j0; j < j1; ++j) {
                Cells*& last = plane[j - j0 + 1];
                cells(*fresh, r, j, k);
                end_cells(*fresh, r, j, k);
                x_faces(*fresh, r, j, k);
                faces<1>(y, *plane[j - j0], *fresh, r, j, k, j > j0);
                faces<2>(z[j - j0], *last, *fresh, r, j, k, k > k0);
                std::swap(last, fresh);
            }
            cells(*fresh, r, j1, k);
            faces<1>(y, *plane[j1 - j0], *fresh, r, j1, k, true);
        }
        for (std::ptrdiff_t j = j0; j < j1; ++j) {
            cells(*fresh, r, j, k1);
            faces<2>(z[j - j0], *plane[j - j0 + 1], *fresh, r, j, k1, true);
        }
    }
};

}  // namespace hemoflux::fluid

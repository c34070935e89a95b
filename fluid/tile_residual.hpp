/// The residual on the CPU: one task is a tile of rows, every face flux is computed once.
#pragma once

#include "exchange/pack.hpp"
#include "fluid/balance.hpp"

namespace hemoflux::fluid {

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

/// One tile of rows. Fluxes through low y and z faces come from buffers; those on the tile's low border are
/// recomputed.
template <class F>
struct TileResidual {
    Balance<F> balance;
    Split sx, sy, sz;

    using Row = double[4][max_segment + 2 * exchange::row_alignment];
    using Pack = exchange::Pack;
    static constexpr auto w = static_cast<std::ptrdiff_t>(exchange::lanes<exchange::Pack>);

    template <int Axis>
    HEMOFLUX_INLINE void fill(Row& row, std::ptrdiff_t i0, std::ptrdiff_t i1, std::ptrdiff_t j,
                              std::ptrdiff_t k) const {
        for (std::ptrdiff_t i = i0; i < i1; i += w) {
            Quad<Pack> q = balance.template flux<Pack, Axis>(i, j, k);
            balance.template prescribe_mass<Pack, Axis>(q, Axis == 1 ? j : k, i, Axis == 1 ? k : j);
            for (int c = 0; c < 4; ++c) exchange::store(&row[c][i - i0], q.c[c]);
        }
    }

    /// Fluxes through the x faces i0 - 1/2 .. i1 - 1/2 of one row.
    HEMOFLUX_INLINE void fill_x(Row& row, std::ptrdiff_t i0, std::ptrdiff_t i1, std::ptrdiff_t j,
                                std::ptrdiff_t k) const {
        std::ptrdiff_t i = i0 - 1;
        if ((i1 - i0) % w ==
            0) {  // one face more than whole packs: do it alone instead of as a nearly empty pack
            const Quad<double> q = balance.template flux<double, 0>(i, j, k);
            for (int c = 0; c < 4; ++c) row[c][0] = q.c[c];
            ++i;
        }
        for (; i < i1; i += w) {
            const Quad<Pack> q = balance.template flux<Pack, 0>(i, j, k);
            for (int c = 0; c < 4; ++c) exchange::store(&row[c][i - i0 + 1], q.c[c]);
        }
        Quad<double> mass{{row[0][0], 0, 0, 0}};
        balance.template prescribe_mass<double, 0>(mass, i0 - 1, j, k);
        row[0][0] = mass.c[0];
        mass.c[0] = row[0][i1 - i0];
        balance.template prescribe_mass<double, 0>(mass, i1 - 1, j, k);
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
                    Quad<Pack> yr = balance.template flux<Pack, 1>(i, j, k);
                    balance.template prescribe_mass<Pack, 1>(yr, j, i, k);
                    Quad<Pack> yl, xl, xr;
                    for (int c = 0; c < 4; ++c) {
                        yl.c[c] = exchange::load<Pack>(&y[c][i - i0]);
                        exchange::store(&y[c][i - i0], yr.c[c]);
                    }
                    Quad<Pack> zr = balance.template flux<Pack, 2>(i, j, k);
                    balance.template prescribe_mass<Pack, 2>(zr, k, i, j);
                    Quad<Pack> zl;
                    for (int c = 0; c < 4; ++c) {
                        zl.c[c] = exchange::load<Pack>(&zj[c][i - i0]);
                        exchange::store(&zj[c][i - i0], zr.c[c]);
                        xl.c[c] = exchange::load<Pack>(&x[c][i - i0]);
                        xr.c[c] = exchange::load<Pack>(&x[c][i - i0 + 1]);
                    }
                    balance.write(i, j, k, i1 - i, xl, xr, yl, yr, zl, zr);
                }
            }
        }
    }
};

}  // namespace hemoflux::fluid

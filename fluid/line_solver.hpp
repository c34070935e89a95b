/// Prefactored tridiagonal lines of the AF scheme solved in packs. Only kernel sources include it.
#pragma once

#include "exchange/pack.hpp"
#include "exchange/parallel.hpp"
#include "fluid/factored.hpp"

namespace hemoflux::fluid {

/// A pack of lines that run along y or z: lanes are neighbours in x.
struct StridedAccess {
    HEMOFLUX_INLINE static exchange::Pack get(const double* p, std::ptrdiff_t, std::ptrdiff_t) {
        return exchange::load<exchange::Pack>(p);
    }
    HEMOFLUX_INLINE static void put(double* p, std::ptrdiff_t, const exchange::Pack& v, std::ptrdiff_t) {
        exchange::store(p, v);
    }
};

/// A pack of lines that run along x: lanes are neighbouring rows, `pitch` apart; the first `count` are real.
struct TransposedAccess {
    HEMOFLUX_INLINE static exchange::Pack get(const double* p, std::ptrdiff_t pitch, std::ptrdiff_t count) {
        return exchange::load_strided<exchange::Pack>(p, pitch, count);
    }
    HEMOFLUX_INLINE static void put(double* p, std::ptrdiff_t pitch, const exchange::Pack& v,
                                    std::ptrdiff_t count) {
        exchange::store_strided(p, pitch, v, count);
    }
};

/// Solves one pack of lines for some fields, in place. step: distance between cells of a line.
template <class Access, int Fields>
HEMOFLUX_INLINE void solve_lines(double* const (&r)[Fields], const LineFactors (&factors)[Fields],
                                 std::ptrdiff_t n, std::ptrdiff_t step, std::ptrdiff_t pitch,
                                 std::ptrdiff_t count, double scale) {
    using exchange::Pack;
    Pack x[Fields];
    for (int c = 0; c < Fields; ++c) x[c] = Pack(0.0);
    for (std::ptrdiff_t i = 0; i < n; ++i)
        for (int c = 0; c < Fields; ++c) {
            const LineFactors& f = factors[c];
            x[c] = (scale * Access::get(r[c] + i * step, pitch, count) - f.lower[i] * x[c]) * f.pivot[i];
            Access::put(r[c] + i * step, pitch, x[c], count);
        }
    for (std::ptrdiff_t i = n - 2; i >= 0; --i)
        for (int c = 0; c < Fields; ++c) {
            x[c] = Access::get(r[c] + i * step, pitch, count) - factors[c].upper[i] * x[c];
            Access::put(r[c] + i * step, pitch, x[c], count);
        }
    if (!factors[0].cyclic) return;
    for (int c = 0; c < Fields; ++c) {
        const LineFactors& f = factors[c];
        const Pack first = Access::get(r[c], pitch, count),
                   last = Access::get(r[c] + (n - 1) * step, pitch, count);
        const Pack correction = (first + f.cyclic_last * last) * f.cyclic_scale;
        for (std::ptrdiff_t i = 0; i < n; ++i)
            Access::put(r[c] + i * step, pitch,
                        Access::get(r[c] + i * step, pitch, count) - correction * f.cyclic[i], count);
    }
}

/// Right-hand sides of some fields, which the solutions replace, the factors of their lines, and a factor of the right-hand
/// sides.
template <int Fields>
struct Lines {
    exchange::Layout layout;
    double* r[Fields];
    LineFactors factors[Fields];
    double scale;
};

/// x lines: `row` is the plane z = k, `pack` a group of neighbouring rows.
template <int Fields>
struct LinesX : Lines<Fields> {
    HEMOFLUX_FN void operator()(std::size_t row, std::size_t pack) const {
        constexpr std::size_t most = exchange::lanes<exchange::Pack>;
        const exchange::Layout& l = this->layout;
        const std::size_t j = pack * most, left = l.n[1] - j;
        const std::size_t at = l.at(0, static_cast<std::ptrdiff_t>(j), static_cast<std::ptrdiff_t>(row));
        double* p[Fields];
        for (int c = 0; c < Fields; ++c) p[c] = this->r[c] + at;
        solve_lines<TransposedAccess, Fields>(
            p, this->factors, static_cast<std::ptrdiff_t>(l.n[0]), 1, static_cast<std::ptrdiff_t>(l.row),
            static_cast<std::ptrdiff_t>(left < most ? left : most), this->scale);
    }
};

/// y lines (row: plane z = k) or z lines (row: plane y = j); `pack` along x.
template <int Axis, int Fields>
struct LinesYZ : Lines<Fields> {
    HEMOFLUX_FN void operator()(std::size_t row, std::size_t pack) const {
        const exchange::Layout& l = this->layout;
        const auto i = static_cast<std::ptrdiff_t>(pack * exchange::lanes<exchange::Pack>),
                   other = static_cast<std::ptrdiff_t>(row);
        const std::size_t at = Axis == 1 ? l.at(i, 0, other) : l.at(i, other, 0);
        double* p[Fields];
        for (int c = 0; c < Fields; ++c) p[c] = this->r[c] + at;
        solve_lines<StridedAccess, Fields>(p, this->factors, static_cast<std::ptrdiff_t>(l.n[Axis]),
                                           static_cast<std::ptrdiff_t>(Axis == 1 ? l.row : l.plane), 0, 0,
                                           this->scale);
    }
};

/// Solves x, then y, then z lines of all cells in place. axis(a) gives the Lines<Fields> of one axis.
template <int Fields, class Axis>
void solve_factors(const exchange::Layout& layout, const Axis& axis) {
    const auto packs = [](std::size_t n) {
        return exchange::round_up(n, exchange::lanes<exchange::Pack>) / exchange::lanes<exchange::Pack>;
    };
    exchange::for_each_row(layout.n[2], packs(layout.n[1]), LinesX<Fields>{axis(0)});
    exchange::for_each_row(layout.n[2], packs(layout.n[0]), LinesYZ<1, Fields>{axis(1)});
    exchange::for_each_row(layout.n[1], packs(layout.n[0]), LinesYZ<2, Fields>{axis(2)});
}

}  // namespace hemoflux::fluid

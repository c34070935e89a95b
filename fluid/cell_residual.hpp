/// The residual cell by cell: what one CUDA thread does.
#pragma once

#include "fluid/balance.hpp"

namespace hemoflux::fluid {

/// One cell with its six faces.
template <class F>
struct CellResidual {
    Balance<F> balance;

    /// Flux through the upper face along Axis of the cell (i, j, k).
    template <int Axis>
    HEMOFLUX_INLINE Quad<double> face(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t k) const {
        const std::ptrdiff_t ijk[3] = {i, j, k};
        Quad<double> q = balance.template loader<double, Axis>().flux(balance.grid.layout.at(i, j, k), ijk);
        if constexpr (Axis == 0) balance.template prescribe_mass<double, 0>(q, i, j, k);
        if constexpr (Axis == 1) balance.template prescribe_mass<double, 1>(q, j, i, k);
        if constexpr (Axis == 2) balance.template prescribe_mass<double, 2>(q, k, i, j);
        return q;
    }

    HEMOFLUX_FN void operator()(std::size_t cell) const {
        const auto& n = balance.grid.layout.n;
        const auto i = static_cast<std::ptrdiff_t>(cell % n[0]),
                   j = static_cast<std::ptrdiff_t>(cell / n[0] % n[1]),
                   k = static_cast<std::ptrdiff_t>(cell / (n[0] * n[1]));
        const Quad<double> xl = face<0>(i - 1, j, k), xr = face<0>(i, j, k), yl = face<1>(i, j - 1, k),
                           yr = face<1>(i, j, k), zl = face<2>(i, j, k - 1), zr = face<2>(i, j, k);
        const AxisView(&axis)[3] = balance.grid.axis;
        const std::size_t at = balance.grid.layout.at(i, j, k);
        for (int c = 0; c < 4; ++c) {
            double r = (xl.c[c] - xr.c[c]) * axis[0].inverse[i] + (yl.c[c] - yr.c[c]) * axis[1].inverse[j] +
                       (zl.c[c] - zr.c[c]) * axis[2].inverse[k];
            if constexpr (F::force)
                if (c > 0) r = r + balance.template source<double>(at, c);
            balance.out.r[c][at] = r;
        }
    }
};

}  // namespace hemoflux::fluid

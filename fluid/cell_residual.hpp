/// The residual cell by cell: what one CUDA thread does.
#pragma once

#include "fluid/balance.hpp"

namespace hemoflux::fluid {

/// One cell with its six faces.
template <class F>
struct CellResidual {
    Balance<F> balance;

    template <int Axis>
    HEMOFLUX_INLINE Quad<double> face(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t k) const {
        Quad<double> q = balance.template flux<double, Axis>(i, j, k);
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
        balance.template write<double>(i, j, k, 1, face<0>(i - 1, j, k), face<0>(i, j, k),
                                       face<1>(i, j - 1, k), face<1>(i, j, k), face<2>(i, j, k - 1),
                                       face<2>(i, j, k));
    }
};

}  // namespace hemoflux::fluid

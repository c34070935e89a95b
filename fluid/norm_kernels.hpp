/// What reductions over the cells of both kinds of grid share. Only kernel sources include this header.
#pragma once

#include "exchange/macros.hpp"

namespace hemoflux::fluid {

/// Sums of squares of density and the three momenta.
struct Squares {
    double c[4] = {0, 0, 0, 0};
    HEMOFLUX_FN Squares& operator+=(const Squares& b) {
        for (int i = 0; i < 4; ++i) c[i] += b.c[i];
        return *this;
    }
};

/// Whether a flow may have this density and squared speed: within half of the reference density, and slower than the
/// lattice's streaming. False for what is not a number.
HEMOFLUX_INLINE bool possible(double density, double speed2) {
    return density > 0.5 && density < 1.5 && speed2 < 1.0;
}

}  // namespace hemoflux::fluid

/// Shifted worm-like-chain springs on the edges, (6.30)-(6.38).
///
///   E_S = sum_s k_s L_c/4 [(3 l^2 - 2 l^3)/(1 - l) - 4 c_1 l - c_2],  l = L/L_c,  L_c = r L_0,  l_0 = 1/r,
///   dE/dL = k_s [1/(4 (1 - l)^2) - 1/4 + l - c_1],
///   c_1 = 1/(4 (1 - l_0)^2) - 1/4 + l_0,   c_2 = (3 l_0^2 - 2 l_0^3)/(1 - l_0) - 4 c_1 l_0,
///   k_s = kT/L_P = (4 r L_0 K_S / sqrt 3) 2 (1 - l_0)^3 / (2 (1 - l_0)^3 + 1)
///
/// (the leading lambda of (6.38) is r, the bracket's is 1/r), so that energy and force vanish at L_0 and a
/// hexagonal sheet shears with K_S. l >= 1 is beyond the contour length: an error, never a value.
#pragma once

#include <cmath>

#include "exchange/macros.hpp"

namespace hemoflux::membrane {

/// Constants that all springs of a network share.
struct WormLikeChain {
    double c1, c2;
    double stiffness;  ///< k_s / L_c, the same for every spring, 1e-5 N/m

    /// From the shear modulus K_S (1e-5 N/m) and the stretch ratio r > 1.
    WormLikeChain(double shear_modulus, double r) {
        const double l0 = 1 / r, cube = 2 * (1 - l0) * (1 - l0) * (1 - l0);
        c1 = 1 / (4 * (1 - l0) * (1 - l0)) - 0.25 + l0;
        c2 = (3 * l0 * l0 - 2 * l0 * l0 * l0) / (1 - l0) - 4 * c1 * l0;
        stiffness = 4 * shear_modulus / std::sqrt(3.0) * cube / (cube + 1);
    }

    /// Energy of one spring, 1e-17 J: l = L/L_c, `inverse` = 1/(1 - l), contour length L_c in um.
    template <class Value>
    HEMOFLUX_INLINE Value energy(const Value& l, const Value& inverse, const Value& contour) const {
        return (0.25 * stiffness) * (contour * contour) *
               (l * l * (3.0 - 2.0 * l) * inverse - 4.0 * c1 * l - c2);
    }

    /// Force dE/dL of one spring, 1e-11 N, positive in tension; arguments as energy().
    template <class Value>
    HEMOFLUX_INLINE Value tension(const Value& l, const Value& inverse, const Value& contour) const {
        return stiffness * contour * (0.25 * inverse * inverse - 0.25 + l - c1);
    }
};

}  // namespace hemoflux::membrane

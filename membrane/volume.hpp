/// Volume constraint of a closed surface, (6.3) and (6.5).
///
///   V = sum_k R_1.(R_2 x R_3) / 6,   E_V = K_V / (2 V_0) (V - V_0)^2,   dV/dR_1 = (R_2 x R_3) / 6, cyclic.
///
/// Around one vertex the triangles close a ring, so dV/dR_j = 1/6 sum_k xi_k over its triangles, where
/// xi_k = (R_2 - R_1) x (R_3 - R_1) points outward ((6.8) prints the inward one), and
/// V = 1/18 sum_j (R_j - O).sum_k xi_k for any origin O.
#pragma once

#include "exchange/macros.hpp"

namespace hemoflux::membrane {

/// E_V, 1e-17 J, of volume v under modulus k_v and reference v0.
HEMOFLUX_INLINE double volume_energy(double k_v, double v, double v0) {
    return 0.5 * k_v / v0 * (v - v0) * (v - v0);
}

/// dE_V/dV: the pressure by which the constraint pulls inward.
HEMOFLUX_INLINE double volume_pressure(double k_v, double v, double v0) { return k_v / v0 * (v - v0); }

}  // namespace hemoflux::membrane

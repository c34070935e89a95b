/// Global and local area constraints, (6.14) and (6.17).
///
///   A_k = |xi_k| / 2,  A = sum_k A_k,
///   E_A = K_A / (2 A_0) (A - A_0)^2 + sum_k K_Ak / (2 A_k0) (A_k - A_k0)^2,
///   dA_k/dR_1 = n_k x (R_3 - R_2) / 2, cyclic, with the outward unit normal n_k = xi_k / |xi_k|.
///
/// ((6.11)-(6.13) belong to the printed, inward (6.8) and are applied transposed.)
#pragma once

#include "exchange/macros.hpp"

namespace hemoflux::membrane {

/// Global part of E_A, 1e-17 J, of total area a under modulus k_a and reference a0.
HEMOFLUX_INLINE double area_energy(double k_a, double a, double a0) {
    return 0.5 * k_a / a0 * (a - a0) * (a - a0);
}

/// d(global E_A)/dA: a tension common to all triangles.
HEMOFLUX_INLINE double area_tension(double k_a, double a, double a0) { return k_a / a0 * (a - a0); }

/// Local part of E_A of one triangle: area a, reference a0, strain a / a0 - 1.
template <class Value>
HEMOFLUX_INLINE Value local_area_energy(double k_ak, const Value& strain, const Value& a0) {
    return 0.5 * k_ak * a0 * strain * strain;
}

/// d(local E_A)/dA_k: the tension of one triangle.
template <class Value>
HEMOFLUX_INLINE Value local_area_tension(double k_ak, const Value& strain) {
    return k_ak * strain;
}

}  // namespace hemoflux::membrane

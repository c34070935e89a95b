/// Worm-like-chain springs on the edges. With l = L/L_c, L_c = r L_0, l_0 = 1/r and the chain's force
///   f(l) = 1/(4 (1 - l)^2) - 1/4 + l,   f'(l) = 1/(2 (1 - l)^3) + 1,
/// three laws share E = sum_s k L_c/4 (3 l^2 - 2 l^3)/(1 - l) + ..., dE/dL = k f(l) + ...; they differ in what
/// balances the chain at its rest length L_0:
///
/// Shifted chain, (6.30)-(6.38):   dE/dL = k [f(l) - f(l_0)],
///   k = (4 r L_0 K_S / sqrt 3) / f'(l_0)
///   (the leading lambda of (6.38) is r, the bracket's is 1/r).
/// Power law, WLC-POW (Fedosov, Caswell, Karniadakis 2010, exponent m = 2):   dE/dL = k f(l) - k_p / L^m,
///   k_p = k f(l_0) L_0^m,   k = (4 r L_0 K_S / sqrt 3) / [f'(l_0) + m r f(l_0)].
/// Hydrostatic area term (Dao, Li, Suresh 2006; Pivkin, Karniadakis 2008, q = 1):   dE/dL = k f(l), and every
///   triangle adds C_k / A_k,  C_k = sqrt 3 k f(l_0) A_k0^2 / L_0,
///   k = (4 r L_0 K_S / sqrt 3) / [f'(l_0) + 3 r f(l_0)].
///
/// k / L_0 is the same for every spring. Each makes a flat hexagonal sheet at rest shear with K_S exactly: it
/// has mu_0 = sqrt(3)/4 (dF/dL + 3 F/L), F the tension that the area term alone balances; area modulus K = 2
/// K_S (+ K_A,k), Young's modulus 4 K mu_0/(K + mu_0) = 8/3 K_S, Poisson's ratio 1/3. Springs and area terms
/// of the hydrostatic law balance one by one on equilateral triangles only: where the rest triangles are not,
/// that law is pre-stressed, as published. l >= 1 is beyond the contour length: an error, never a value.
#pragma once

#include <cmath>

#include "exchange/macros.hpp"

namespace hemoflux::membrane {

namespace detail {
/// f(l) and f'(l) of a worm-like chain.
inline double chain_force(double l) { return 1 / (4 * (1 - l) * (1 - l)) - 0.25 + l; }
inline double chain_slope(double l) { return 1 / (2 * (1 - l) * (1 - l) * (1 - l)) + 1; }
/// 4 (energy over k L_c) of a worm-like chain.
inline double chain_energy(double l) { return (3 * l * l - 2 * l * l * l) / (1 - l); }
}  // namespace detail

/// Constants that all springs of a network share; shifted chain, or bare chain for the hydrostatic law.
struct WormLikeChain {
    double c1, c2;
    double stiffness;  ///< k / L_c, the same for every spring, 1e-5 N/m

    /// The shifted chain, from the shear modulus K_S (1e-5 N/m) and the stretch ratio r > 1.
    WormLikeChain(double shear_modulus, double r) {
        const double l0 = 1 / r;
        c1 = detail::chain_force(l0);
        c2 = detail::chain_energy(l0) - 4 * c1 * l0;
        stiffness = 4 * shear_modulus / std::sqrt(3.0) / detail::chain_slope(l0);
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

/// The springs of WLC-POW; constants that all springs of a network share.
struct PowerChain {
    double stiffness;  ///< k / L_c, 1e-5 N/m
    double power;      ///< k_p / (k L_c^2) = f(l_0) l_0^2
    double c2;         ///< 4 (energy over k L_c) at rest, subtracted so that it vanishes there

    /// From the shear modulus K_S (1e-5 N/m) and the stretch ratio r > 1.
    PowerChain(double shear_modulus, double r) {
        const double l0 = 1 / r;
        power = detail::chain_force(l0) * l0 * l0;
        c2 = detail::chain_energy(l0) + 4 * power / l0;
        stiffness =
            4 * shear_modulus / std::sqrt(3.0) / (detail::chain_slope(l0) + 2 * r * detail::chain_force(l0));
    }

    /// Energy of one spring, 1e-17 J: l = L/L_c, `inverse` = 1/(1 - l), contour length L_c in um.
    template <class Value>
    HEMOFLUX_INLINE Value energy(const Value& l, const Value& inverse, const Value& contour) const {
        return (0.25 * stiffness) * (contour * contour) *
               (l * l * (3.0 - 2.0 * l) * inverse + 4.0 * power / l - c2);
    }

    /// Force dE/dL of one spring, 1e-11 N, positive in tension; arguments as energy().
    template <class Value>
    HEMOFLUX_INLINE Value tension(const Value& l, const Value& inverse, const Value& contour) const {
        return stiffness * contour * (0.25 * inverse * inverse - 0.25 + l - power / (l * l));
    }
};

/// The hydrostatic law: bare chains and the area term of the triangles.
struct HydrostaticChain {
    WormLikeChain chain;
    double pressure;  ///< h = C_k / A_k0^2, the same for every triangle, 1e-5 N/m

    /// From the shear modulus K_S (1e-5 N/m) and the stretch ratio r > 1.
    HydrostaticChain(double shear_modulus, double r) : chain(shear_modulus, r) {
        const double l0 = 1 / r, force = detail::chain_force(l0);
        chain.c1 = 0;
        chain.c2 = detail::chain_energy(l0);
        chain.stiffness = 4 * shear_modulus / std::sqrt(3.0) / (detail::chain_slope(l0) + 3 * r * force);
        pressure = std::sqrt(3.0) * chain.stiffness * r * force;
    }

    /// Energy of one triangle, zero at rest, 1e-17 J: ratio = A_k/A_k0, rest area A_k0 in um^2.
    template <class Value>
    HEMOFLUX_INLINE Value area_energy(const Value& ratio, const Value& rest) const {
        return pressure * rest * (1.0 / ratio - 1.0);
    }

    /// dE/dA_k of one triangle, 1e-5 N/m.
    template <class Value>
    HEMOFLUX_INLINE Value area_tension(const Value& ratio) const {
        return -pressure / (ratio * ratio);
    }
};

}  // namespace hemoflux::membrane

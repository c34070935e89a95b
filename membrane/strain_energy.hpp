/// Continuum laws on the triangles: hyperelastic membranes of linear (constant-strain) triangles.
///
/// With principal stretches l_1, l_2 from the rest triangle, I = l_1^2 + l_2^2, J = l_1 l_2 = A_k/A_k0:
///   neo-Hookean (Barthes-Biesel, Diaz, Dhenin 2002):  W = G/2 (I - 3 + 1/J^2),
///     K = 3 G, Young's modulus 3 G, Poisson's ratio 1/2
///   Skalak et al. 1973:  W = G/4 [(I - 2)^2 + 2 (I - 2) - 2 (J^2 - 1) + C (J^2 - 1)^2],
///     K = (1 + 2 C) G, Young's modulus 2 G (1 + 2 C)/(1 + C), Poisson's ratio C/(1 + C)
/// per rest area; G = K_S is the shear modulus and K the area modulus of small deformations.
///
/// On a linear triangle A_k0 I = 1/2 sum_edges cot(a_e) L_e^2, a_e the angle of the REST triangle opposite to
/// edge e (the Dirichlet energy of the map), so that E = sum_k A_k0 W has, like springs and surface tension,
///   dE/dR_1 = dW/dI [cot a_3 (R_1 - R_2) + cot a_2 (R_1 - R_3)] + dW/dJ dA_k/dR_1.
/// The rest triangle is the one whose edges are the reference lengths L_0.
///
/// Principal Cauchy tensions: T_i = (l_i / J) dW/dl_i = 2 dW/dI l_i^2 / J + dW/dJ.
#pragma once

#include "exchange/macros.hpp"

namespace hemoflux::membrane {

/// W and its derivatives, 1e-5 N/m.
template <class Value>
struct StrainEnergy {
    Value density, by_i, by_j;
};

/// Neo-Hookean membrane of shear modulus G (1e-5 N/m).
struct NeoHookean {
    double shear;
    template <class Value>
    HEMOFLUX_INLINE StrainEnergy<Value> operator()(const Value& i, const Value& j) const {
        const Value inverse = 1.0 / j, inverse2 = inverse * inverse;
        return {0.5 * shear * (i - 3.0 + inverse2), Value(0.5 * shear), -shear * inverse2 * inverse};
    }
};

/// Skalak membrane of shear modulus G (1e-5 N/m) and area ratio C.
struct Skalak {
    double shear, ratio;
    template <class Value>
    HEMOFLUX_INLINE StrainEnergy<Value> operator()(const Value& i, const Value& j) const {
        const Value i1 = i - 2.0, i2 = j * j - 1.0;
        return {0.25 * shear * (i1 * i1 + 2.0 * i1 - 2.0 * i2 + ratio * (i2 * i2)), 0.5 * shear * (i1 + 1.0),
                shear * j * (ratio * i2 - 1.0)};
    }
};

}  // namespace hemoflux::membrane

/// Derivatives of the flux through a face with respect to the conserved variables of its two cells, with the nodes of the
/// local lattice at the values of the cell they lie in. One-sided differences of face_flux() in density and velocity,
/// in the face's frame, then the chain rule
///
///   dF/drho|_m = dF/drho|_u - (dF/du . u) / rho,   dF/dm = dF/du / rho,   m = rho u.
#pragma once

#include "fluid/flux.hpp"

namespace hemoflux::fluid {

/// Frame and lengths of a face as the Jacobian needs them.
template <class Value>
struct JacobianFace {
    Value n[3], t1[3], t2[3];
    Value weight_left, delta, nu;
};

/// Derivatives of the flux through one face with respect to the states on its two sides.
template <class Value>
struct FaceJacobian {
    JacobianFace<Value> face;
    double gamma;

    /// (rho, u) with the velocity turned into the face's frame.
    HEMOFLUX_INLINE void turn(const Value (&q)[4], Value (&phi)[4]) const {
        phi[0] = q[0];
        phi[1] = face.n[0] * q[1] + face.n[1] * q[2] + face.n[2] * q[3];
        phi[2] = face.t1[0] * q[1] + face.t1[1] * q[2] + face.t1[2] * q[3];
        phi[3] = face.t2[0] * q[1] + face.t2[1] * q[2] + face.t2[2] * q[3];
    }

    /// Flux per area in the face's frame.
    HEMOFLUX_INLINE Quad<Value> flux(const Value (&left)[4], const Value (&right)[4]) const {
        FaceSide<Value> a, b;
        for (int c = 0; c < 4; ++c) {
            a.phi[c] = left[c], b.phi[c] = right[c];
            a.n[c] = a.t1[c] = a.t2[c] = b.n[c] = b.t1[c] = b.t2[c] = Value(0.0);
        }
        const FaceGeometry<Value> lengths{face.delta, face.delta, face.weight_left, face.delta,
                                          1.0 / face.delta};
        const Value force[3] = {Value(0.0), Value(0.0), Value(0.0)};
        return face_flux<false, true>(a, b, lengths, face.nu, force, 1 / gamma);
    }

    /// d flux / d phi of the left (side 0) or right cell, in the face's frame: d[flux][phi].
    HEMOFLUX_INLINE void derivative(int side, const Value (&left)[4], const Value (&right)[4],
                                    Value (&d)[4][4]) const {
        constexpr double step = 1e-8;  // truncation and rounding both near 1e-8
        const Quad<Value> base = flux(left, right);
        for (int k = 0; k < 4; ++k) {
            Value l[4], r[4];
            for (int c = 0; c < 4; ++c) l[c] = left[c], r[c] = right[c];
            (side == 0 ? l : r)[k] = (side == 0 ? l : r)[k] + step;
            const Quad<Value> moved = flux(l, r);
            for (int i = 0; i < 4; ++i) d[i][k] = (moved.c[i] - base.c[i]) * (1 / step);
        }
    }

    /// From d flux / d phi in the face's frame to d flux / d Q in global components: chain rule, then rotation of
    /// columns and rows.
    HEMOFLUX_INLINE void conserved(const Value (&phi)[4], Value (&d)[4][4]) const {
        const Value inverse = 1.0 / phi[0];
        for (int i = 0; i < 4; ++i) {
            const Value a = d[i][1] * inverse, b = d[i][2] * inverse, c = d[i][3] * inverse;
            d[i][0] = d[i][0] - (a * phi[1] + b * phi[2] + c * phi[3]);
            for (int x = 0; x < 3; ++x) d[i][1 + x] = a * face.n[x] + b * face.t1[x] + c * face.t2[x];
        }
        for (int k = 0; k < 4; ++k) {
            const Value a = d[1][k], b = d[2][k], c = d[3][k];
            for (int x = 0; x < 3; ++x) d[1 + x][k] = a * face.n[x] + b * face.t1[x] + c * face.t2[x];
        }
    }
};

}  // namespace hemoflux::fluid

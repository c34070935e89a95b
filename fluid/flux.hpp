/// Flux through one axis-aligned face, from a local D3Q15 lattice Boltzmann solution at its centre (LBFS).
///
///   f_a^eq = rho w_a [1 + 3 e.V + (4.5 (e.V)^2 - 1.5 |V|^2) / gamma]                     (2.7), (4.2)
///   pre-streaming nodes at r - e_a delta, extrapolated from the cell they lie in         (2.13), (2.14)
///   rho = sum f_a,  rho V = sum e_a f_a                                                  (2.15)
///   mass flux = rho V.n,  momentum flux = Pi_eq - (tau - 1/2)(Pi_eq - Pi_pre)            (2.4), (2.9)
///   tau - 1/2 = 3 nu / (gamma delta)                                                     (2.6)
///
/// A body force f adds its balanced impulse delta f to the momentum that makes the mass flux and the
/// convective part of the momentum flux; the viscous part, a difference of moments before streaming, is left
/// as it is.
///
/// Here c = 1, c_s^2 = 1/3; weights 2/9 (rest), 1/9 (axis), 1/72 (corner). Only the n-row of the second
/// moments is needed, so the 15 nodes are summed in three groups: e.n = +1 (left cell), -1 (right cell), 0
/// (mean of both).
#pragma once

#include "exchange/macros.hpp"

namespace hemoflux::fluid {

/// Density and velocity (normal, first and second tangential component), or a flux of mass and momentum.
template <class Value>
struct Quad {
    Value c[4];
};

/// What one side of a face contributes: cell-centre values and their gradients along n, t1 and t2 (per
/// length).
template <class Value>
struct FaceSide {
    Value phi[4], n[4], t1[4], t2[4];
};

/// Lengths at a face. half: cell centre to face; weight: distance weight of the left cell (right: 1 -
/// weight); delta: streaming distance, and its reciprocal.
template <class Value>
struct FaceGeometry {
    Value half_left, half_right, weight_left, delta, inv_delta;
};

namespace detail {

/// Bracket of the equilibrium times rho: f / w.
template <bool Preconditioned, class Value>
HEMOFLUX_INLINE Value equilibrium(const Value& rho, const Value& ev, const Value& vv, double inv_gamma) {
    if constexpr (Preconditioned)
        return rho * ((1.0 - (1.5 * inv_gamma) * vv) + ev * (3.0 + (4.5 * inv_gamma) * ev));
    else
        return rho * ((1.0 - 1.5 * vv) + ev * (3.0 + 4.5 * ev));
}

/// Sum and first tangential moments of the nodes that stream in from one side.
template <class Value>
struct SideSums {
    Value all, t1, t2;
};

/// Nodes with e.n = Sign: one axis node at `a`, four corner nodes around it at -+d1, -+d2.
template <int Sign, bool Preconditioned, class Value>
HEMOFLUX_INLINE SideSums<Value> side_sums(const Value (&a)[4], const Value (&d1)[4], const Value (&d2)[4],
                                          double inv_gamma) {
    auto node = [&](const Value& rho, const Value& u, const Value& v, const Value& w, int s1, int s2) {
        const Value un = Sign > 0 ? u : -u;
        const Value ev = s1 > 0 ? (s2 > 0 ? un + v + w : un + v - w) : (s2 > 0 ? un - v + w : un - v - w);
        return equilibrium<Preconditioned>(rho, ev, u * u + v * v + w * w, inv_gamma);
    };
    Value p[4], m[4];
    for (int c = 0; c < 4; ++c) p[c] = a[c] - d1[c], m[c] = a[c] + d1[c];
    const Value pp = node(p[0] - d2[0], p[1] - d2[1], p[2] - d2[2], p[3] - d2[3], 1, 1);
    const Value pm = node(p[0] + d2[0], p[1] + d2[1], p[2] + d2[2], p[3] + d2[3], 1, -1);
    const Value mp = node(m[0] - d2[0], m[1] - d2[1], m[2] - d2[2], m[3] - d2[3], -1, 1);
    const Value mm = node(m[0] + d2[0], m[1] + d2[1], m[2] + d2[2], m[3] + d2[3], -1, -1);
    const Value un = Sign > 0 ? a[1] : -a[1];
    const Value axis =
        equilibrium<Preconditioned>(a[0], un, a[1] * a[1] + a[2] * a[2] + a[3] * a[3], inv_gamma);
    const Value plus = pp + pm, minus = mp + mm;
    constexpr double corner_weight = 1.0 / 72.0, axis_weight = 1.0 / 9.0;
    return {corner_weight * (plus + minus) + axis_weight * axis, corner_weight * (plus - minus),
            corner_weight * ((pp - pm) + (mp - mm))};
}

}  // namespace detail

/// Flux of mass and momentum (normal, t1, t2) per area through the face, positive from left to right. nu:
/// kinematic viscosity on the face. force: body force per volume on the face (read only when Force).
/// inv_gamma: 1 / gamma (read only when Preconditioned; the force must already be divided by gamma).
template <bool Force, bool Preconditioned, class Value>
HEMOFLUX_INLINE Quad<Value> face_flux(const FaceSide<Value>& left, const FaceSide<Value>& right,
                                      const FaceGeometry<Value>& face, const Value& nu,
                                      const Value (&force)[3], double inv_gamma) {
    const Value& delta = face.delta;
    const Value reach_left = face.half_left - delta, reach_right = face.half_right - delta;
    const Value weight_right = 1.0 - face.weight_left;

    Value a[4], d1[4], d2[4], centre[4], m1[4], m2[4];
    for (int c = 0; c < 4; ++c) {
        d1[c] = delta * left.t1[c];
        d2[c] = delta * left.t2[c];
        a[c] = left.phi[c] + reach_left * left.n[c];
        centre[c] = face.weight_left * (left.phi[c] + face.half_left * left.n[c]);
        m1[c] = face.weight_left * d1[c];
        m2[c] = face.weight_left * d2[c];
    }
    const auto from_left = detail::side_sums<1, Preconditioned>(a, d1, d2, inv_gamma);
    for (int c = 0; c < 4; ++c) {
        d1[c] = delta * right.t1[c];
        d2[c] = delta * right.t2[c];
        a[c] = right.phi[c] - reach_right * right.n[c];
        centre[c] = centre[c] + weight_right * (right.phi[c] - face.half_right * right.n[c]);
        m1[c] = m1[c] + weight_right * d1[c];
        m2[c] = m2[c] + weight_right * d2[c];
    }
    const auto from_right = detail::side_sums<-1, Preconditioned>(a, d1, d2, inv_gamma);

    // Nodes in the plane of the face: at rest, and one step along +-t1 and +-t2.
    auto in_plane = [&](const Value(&m)[4], double s, int tangent) {
        Value q[4];
        for (int c = 0; c < 4; ++c) q[c] = centre[c] - s * m[c];
        return detail::equilibrium<Preconditioned>(q[0], Value(s * q[tangent]),
                                                   Value(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), inv_gamma);
    };
    const Value t1_plus = in_plane(m1, 1.0, 2), t1_minus = in_plane(m1, -1.0, 2);
    const Value t2_plus = in_plane(m2, 1.0, 3), t2_minus = in_plane(m2, -1.0, 3);
    const Value speed2 = centre[1] * centre[1] + centre[2] * centre[2] + centre[3] * centre[3];
    const Value rest = detail::equilibrium<Preconditioned>(centre[0], Value(0.0), speed2, inv_gamma);

    constexpr double axis_weight = 1.0 / 9.0, rest_weight = 2.0 / 9.0;
    const Value pre_nn = from_left.all + from_right.all;
    const Value rho =
        pre_nn + axis_weight * ((t1_plus + t1_minus) + (t2_plus + t2_minus)) + rest_weight * rest;
    const Value mn = from_left.all - from_right.all;
    const Value mt1 = from_left.t1 + from_right.t1 + axis_weight * (t1_plus - t1_minus);
    const Value mt2 = from_left.t2 + from_right.t2 + axis_weight * (t2_plus - t2_minus);
    const Value pre_nt1 = from_left.t1 - from_right.t1, pre_nt2 = from_left.t2 - from_right.t2;
    Value relax = 3.0 * nu * face.inv_delta, inv_rho = 1.0 / rho;
    if constexpr (Preconditioned) {
        relax = relax * inv_gamma;
        inv_rho = inv_rho * inv_gamma;
    }
    const Value carry = mn * inv_rho;
    const Value eq_nn = (1.0 / 3.0) * rho + carry * mn, eq_nt1 = carry * mt1, eq_nt2 = carry * mt2;
    Quad<Value> flux{{mn, eq_nn - relax * (eq_nn - pre_nn), eq_nt1 - relax * (eq_nt1 - pre_nt1),
                      eq_nt2 - relax * (eq_nt2 - pre_nt2)}};
    if constexpr (Force) {
        // The impulse changes what is convected, not the viscous stress: Pi_pre knows nothing of it.
        const Value in = delta * force[0], new_n = mn + in;
        const Value new_carry = new_n * inv_rho;
        flux.c[0] = new_n;
        flux.c[1] = flux.c[1] + (new_carry * new_n - carry * mn);
        flux.c[2] = flux.c[2] + (new_carry * (mt1 + delta * force[1]) - carry * mt1);
        flux.c[3] = flux.c[3] + (new_carry * (mt2 + delta * force[2]) - carry * mt2);
    }
    return flux;
}

}  // namespace hemoflux::fluid

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
///
/// The sums are not taken node by node. The four corner nodes of one side, e = (+-1, s1, s2) with s1, s2 =
/// +-1, hold V = a - s1 d1 - s2 d2, and because s1^2 = s2^2 = 1 everything about them is of the form
/// x0 + s1 x1 + s2 x2 + s1 s2 x12; the sums over the nodes of f, s1 f and s2 f are 4 x0, 4 x1 and 4 x2 of the
/// product rho * [...]. Likewise the two nodes on a tangent, m ahead and behind the face's centre, have an
/// even and an odd part: about half the operations (fluid/roofline.hpp counts them). All sums are kept times 6,
/// where most weights become one; and f/w - 1 is summed instead of f/w, which lets single precision store rho - 1.
#pragma once

#include "exchange/pack.hpp"

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

/// Lengths at a face. half: cell centre to face; weight: distance weight of the left cell, half_right / (half_left +
/// half_right); delta: streaming distance, and its reciprocal.
template <class Value>
struct FaceGeometry {
    Value half_left, half_right, weight_left, delta, inv_delta;
};

/// Nodes of one side of a face: the axis node's values a, and what a step of delta along t1 and t2 changes.
template <class Value>
struct SideNodes {
    Value a[4], d1[4], d2[4];
};

/// Scalar products of the velocities of SideNodes, all divided by gamma.
template <class Value>
struct SideProducts {
    Value aa, a1, a2;  ///< a.a, a.d1, a.d2
    Value dd, d12;     ///< d1.d1 + d2.d2, d1.d2
};

/// Twice the mean of both sides in the plane of the face: at its centre, and what a step of delta along t1
/// and t2 changes.
template <class Value>
struct PlaneNodes {
    Value c[4], m1[4], m2[4];
};

namespace detail {

template <class Value>
HEMOFLUX_INLINE Value dot(const Value (&a)[4], const Value (&b)[4]) {
    return a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/// The density that a stored one stands for: single precision keeps rho - 1.
template <class Value>
HEMOFLUX_INLINE Value density(const Value& stored) {
    if constexpr (exchange::is_single<Value>)
        return stored + exchange::Scalar<Value>(1);
    else
        return stored;
}

/// Sum and first tangential moments (times 6) of the nodes that stream in from one side. In single precision the sum
/// lacks the part of a unit density at rest, 1.
template <class Value>
struct SideSums {
    Value all, t1, t2;
};

/// Nodes with e.n = Sign: one axis node, four corner nodes around it.
template <int Sign, bool Preconditioned, class Value>
HEMOFLUX_INLINE SideSums<Value> side_sums(const SideNodes<Value>& s, const SideProducts<Value>& p,
                                          double inverse_gamma) {
    using R = exchange::Scalar<Value>;
    const R ig = Preconditioned ? R(inverse_gamma) : R(1);
    // e.V = e0 + s1 e1 + s2 e2 - s1 s2 e12
    const Value trace = s.d1[2] + s.d2[3], e12 = s.d1[3] + s.d2[2];
    const Value e0 = Sign > 0 ? s.a[1] - trace : -(s.a[1] + trace);
    const Value e1 = Sign > 0 ? s.a[2] - s.d1[1] : s.a[2] + s.d1[1];
    const Value e2 = Sign > 0 ? s.a[3] - s.d2[1] : s.a[3] + s.d2[1];
    const Value squares = ((e0 * e0 + e1 * e1) + e2 * e2) + e12 * e12;
    // [...] / 3 = 1/3 + b0 + s1 b1 + s2 b2 + s1 s2 b12
    const Value b0 = e0 + (R(1.5) * ig) * squares - R(0.5) * (p.aa + p.dd);
    const Value g = R(1) + (R(3) * ig) * e0, e12_3 = (R(3) * ig) * e12;
    const Value b1 = (p.a1 + e1 * g) - e12_3 * e2;
    const Value b2 = (p.a2 + e2 * g) - e12_3 * e1;
    const Value b12 = ((R(3) * ig) * (e1 * e2) - p.d12) - e12 * g;
    // the axis node's bracket: 1 + 3/2 axis
    const Value along = Sign > 0 ? s.a[1] : -s.a[1];
    const Value axis = along * (R(2) + (R(3) * ig) * along) - p.aa;
    const Value rho = density(s.a[0]);
    const Value bracket = R(1.0 / 3) + b0;
    return {((s.a[0] + rho * (b0 + axis)) - s.d1[0] * b1) - s.d2[0] * b2,
            rho * b1 - s.d1[0] * bracket - s.d2[0] * b12, rho * b2 - s.d2[0] * bracket - s.d1[0] * b12};
}

/// Nodes in the plane of the face: at rest, and one step along +-t1 and +-t2. In single precision the sum
/// lacks the part of a unit density at rest, 4.
template <bool Preconditioned, class Value>
HEMOFLUX_INLINE SideSums<Value> plane_sums(const PlaneNodes<Value>& p, double inverse_gamma) {
    using R = exchange::Scalar<Value>;
    const R ig = Preconditioned ? R(inverse_gamma) : R(1);
    // two thirds of the brackets, for s = +-1 along the tangent: 2/3 + even + s odd
    const Value nn = p.c[1] * p.c[1], tt[2] = {p.c[2] * p.c[2], p.c[3] * p.c[3]};
    const auto even = [&](const Value(&m)[4], int t, int other) {
        const Value along = tt[t - 2] + m[t] * m[t];
        const Value across = ((nn + tt[other - 2]) + m[1] * m[1]) + m[other] * m[other];
        return ((R(0.5) * ig) * along - m[t]) - (R(0.25) * ig) * across;
    };
    const auto odd = [&](const Value(&m)[4], int t, int other) {
        return (p.c[t] - (ig * m[t]) * p.c[t]) + (R(0.5) * ig) * (p.c[1] * m[1] + p.c[other] * m[other]);
    };
    const Value even1 = even(p.m1, 2, 3), odd1 = odd(p.m1, 2, 3);
    const Value even2 = even(p.m2, 3, 2), odd2 = odd(p.m2, 3, 2);
    const Value rest = (R(-0.25) * ig) * (nn + (tt[0] + tt[1]));
    Value rho = p.c[0];
    if constexpr (exchange::is_single<Value>) rho = rho + R(2);
    return {(((p.c[0] + p.c[0]) + rho * ((even1 + even2) + rest)) - p.m1[0] * odd1) - p.m2[0] * odd2,
            rho * odd1 - p.m1[0] * (R(2.0 / 3) + even1), rho * odd2 - p.m2[0] * (R(2.0 / 3) + even2)};
}

}  // namespace detail

/// Flux of mass and momentum (normal, t1, t2) per area through the face, positive from left to right.
/// relax: tau - 1/2 on the face. impulse: delta times the body force per volume on the face (read only when
/// Force). inv_gamma: 1 / gamma (read only when Preconditioned; the force must already be divided by gamma).
template <bool Force, bool Preconditioned, class Value>
HEMOFLUX_INLINE Quad<Value> flux_of_nodes(const SideNodes<Value>& left, const SideProducts<Value>& of_left,
                                          const SideNodes<Value>& right, const SideProducts<Value>& of_right,
                                          const PlaneNodes<Value>& plane, const Value& relax,
                                          const Value (&impulse)[3], double inv_gamma) {
    using R = exchange::Scalar<Value>;
    const auto l = detail::side_sums<1, Preconditioned>(left, of_left, inv_gamma);
    const auto r = detail::side_sums<-1, Preconditioned>(right, of_right, inv_gamma);
    const auto p = detail::plane_sums<Preconditioned>(plane, inv_gamma);
    constexpr R sixth = R(1) / R(6);

    const Value pre_nn = l.all + r.all, pre_nt1 = l.t1 - r.t1, pre_nt2 = l.t2 - r.t2;
    const Value excess = pre_nn + p.all;  // 6 (rho - 1), or 6 rho
    const Value mn = l.all - r.all, mt1 = l.t1 + r.t1 + p.t1, mt2 = l.t2 + r.t2 + p.t2;
    Value rho = excess;
    if constexpr (exchange::is_single<Value>) rho = rho + R(6);
    const Value inv_rho = (Preconditioned ? R(inv_gamma) : R(1)) / rho;
    // Pi = (1/6 - r) Pi_eq + r Pi_pre = Pi_eq / 6 + r (Pi_pre - Pi_eq), both times 6; Pi_eq = carry m, and the pressure
    const Value carry = mn * inv_rho, of_pre = sixth * relax, of_eq = sixth - of_pre;
    const Value pressure = (R(1.0 / 3) * of_eq) * excess;
    if constexpr (Force) {
        // The impulse changes what is convected, not the viscous stress: Pi_pre knows nothing of it.
        const Value mass = sixth * mn + impulse[0], new_carry = R(6) * mass * inv_rho;
        return {{mass, (pressure + of_pre * (pre_nn - carry * mn)) + new_carry * mass,
                 of_pre * (pre_nt1 - carry * mt1) + new_carry * (sixth * mt1 + impulse[1]),
                 of_pre * (pre_nt2 - carry * mt2) + new_carry * (sixth * mt2 + impulse[2])}};
    } else {
        const Value convected = of_eq * carry;
        return {{sixth * mn, (pressure + of_pre * pre_nn) + convected * mn,
                 of_pre * pre_nt1 + convected * mt1, of_pre * pre_nt2 + convected * mt2}};
    }
}

namespace detail {

/// Scalar products of a side's nodes, divided by gamma.
template <bool Preconditioned, class Value>
HEMOFLUX_INLINE SideProducts<Value> products(const SideNodes<Value>& s, double inverse_gamma) {
    SideProducts<Value> p{dot(s.a, s.a), dot(s.a, s.d1), dot(s.a, s.d2),
                          ((dot(s.d1, s.d1) + s.d2[1] * s.d2[1]) + s.d2[2] * s.d2[2]) + s.d2[3] * s.d2[3],
                          dot(s.d1, s.d2)};
    if constexpr (Preconditioned) {
        const exchange::Scalar<Value> ig(inverse_gamma);
        p = {ig * p.aa, ig * p.a1, ig * p.a2, ig * p.dd, ig * p.d12};
    }
    return p;
}

}  // namespace detail

/// The same from cell values and gradients, for cells of any widths. nu: kinematic viscosity on the face.
/// force: body force per volume on the face.
template <bool Force, bool Preconditioned, class Value>
HEMOFLUX_INLINE Quad<Value> face_flux(const FaceSide<Value>& left, const FaceSide<Value>& right,
                                      const FaceGeometry<Value>& face, const Value& nu,
                                      const Value (&force)[3], double inv_gamma) {
    using R = exchange::Scalar<Value>;
    const Value reach_left = face.half_left - face.delta, reach_right = face.delta - face.half_right;
    // The weight of one side is the distance to the other, so that both gradients have the same factor, bend.
    const Value twice_left = R(2) * face.weight_left, twice_right = R(2) - twice_left,
                bend = twice_left * face.half_left;
    SideNodes<Value> l, r;
    PlaneNodes<Value> plane;
    for (int c = 0; c < 4; ++c) {
        l.d1[c] = face.delta * left.t1[c];
        l.d2[c] = face.delta * left.t2[c];
        l.a[c] = left.phi[c] + reach_left * left.n[c];
        r.d1[c] = face.delta * right.t1[c];
        r.d2[c] = face.delta * right.t2[c];
        r.a[c] = right.phi[c] + reach_right * right.n[c];
        plane.c[c] =
            (twice_left * left.phi[c] + twice_right * right.phi[c]) + bend * (left.n[c] - right.n[c]);
        plane.m1[c] = twice_left * l.d1[c] + twice_right * r.d1[c];
        plane.m2[c] = twice_left * l.d2[c] + twice_right * r.d2[c];
    }
    Value relax = R(3) * nu * face.inv_delta;
    if constexpr (Preconditioned) relax = relax * R(inv_gamma);
    Value impulse[3] = {};
    if constexpr (Force)
        for (int c = 0; c < 3; ++c) impulse[c] = face.delta * force[c];
    return flux_of_nodes<Force, Preconditioned>(l, detail::products<Preconditioned>(l, inv_gamma), r,
                                                detail::products<Preconditioned>(r, inv_gamma), plane, relax,
                                                impulse, inv_gamma);
}

}  // namespace hemoflux::fluid

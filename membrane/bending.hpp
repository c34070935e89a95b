/// Helfrich and area-difference bending, (6.20)-(6.25), with signed edge angles.
///
///   theta_s = atan2((xi_a x xi_b).e / |e|, xi_a.xi_b), convex > 0      ((6.27)'s acos has no sign)
///   S_j = 1/2 sum_s theta_s L_s,  A_j = 1/3 sum_k A_k,  C_j = S_j / A_j = c_1 + c_2 (sphere: + 2/R)
///   E_B = K_B/2 sum_j A_j (C_j - C_0)^2 + K_ADE / A_0 (M - M_0)^2,  M = sum_s theta_s L_s
///   dE/dS_j = K_B (C_j - C_0),   dE/dA_j = -K_B/2 (C_j^2 - C_0^2),
///   per edge  w_s = (dE/dS_1 + dE/dS_2)/2 + 2 K_ADE (M - M_0)/A_0,  dE = w_s (theta_s dL_s + L_s dtheta_s).
///
/// ((6.20) lacks the square; the membrane thickness cancels.) For edge (1,2) with opposite vertices 3, 4, and
/// a_i = (R_i - R_1).e / L^2,
///   dtheta/dR_3 = -L xi_a/|xi_a|^2,  dtheta/dR_4 = -L xi_b/|xi_b|^2,
///   dtheta/dR_2 = -a_3 dtheta/dR_3 - a_4 dtheta/dR_4,  dtheta/dR_1 = (a_3 - 1) dtheta/dR_3 + (a_4 - 1) ...
/// Each term belongs to one triangle. The three edges of triangle (j, m, n), with d_m = R_m - R_j, u_m =
/// d_m.(d_m - d_n) and u_n = d_n.(d_n - d_m), hence L_mn^2 = u_m + u_n, give vertex j together
///   sum_s w_s L_s dtheta_s/dR_j = [w_jm u_m + w_jn u_n - w_mn (u_m + u_n)] xi/|xi|^2
///                               = [(D_j - D_n) u_m + (D_j - D_m) u_n] xi / (2 |xi|^2),    D = dE/dS,
/// in which the area-difference term cancels: sum_s L_s dtheta_s = 0 on any closed polyhedron (Schlaefli).
#pragma once

#include "exchange/vec3.hpp"
#include "membrane/arctangent.hpp"

namespace hemoflux::membrane {

/// Signed angle of the edge `along` (from the vertex, length `length`) between its left triangle, of normal
/// xi_a and third vertex at `to_opposite` from the same vertex, and its right triangle, of normal xi_b.
/// Uses (xi_a x xi_b).e = -|e|^2 (R_3 - R_1).xi_b.
template <class Value>
HEMOFLUX_INLINE Value edge_angle(const Value& length, const Vec3<Value>& to_opposite, const Vec3<Value>& xi_a,
                                 const Vec3<Value>& xi_b) {
    return arctangent<Value>(-length * dot(to_opposite, xi_b), dot(xi_a, xi_b));
}

/// Helfrich energy of one vertex of area a and curvature c, 1e-17 J.
template <class Value>
HEMOFLUX_INLINE Value helfrich_energy(double k_b, const Value& a, const Value& c, double c0) {
    return 0.5 * k_b * a * (c - c0) * (c - c0);
}

/// dE/dS_j of the Helfrich energy.
template <class Value>
HEMOFLUX_INLINE Value helfrich_by_curvature(double k_b, const Value& c, double c0) {
    return k_b * (c - c0);
}

/// dE/dA_j of the Helfrich energy.
template <class Value>
HEMOFLUX_INLINE Value helfrich_by_area(double k_b, const Value& c, double c0) {
    return -0.5 * k_b * (c * c - c0 * c0);
}

/// Area-difference energy, 1e-17 J, of the total curvature m under modulus k_ade.
HEMOFLUX_INLINE double area_difference_energy(double k_ade, double m, double m0, double a0) {
    return k_ade / a0 * (m - m0) * (m - m0);
}

/// dE/dM of the area-difference energy.
HEMOFLUX_INLINE double area_difference_by_curvature(double k_ade, double m, double m0, double a0) {
    return 2 * k_ade / a0 * (m - m0);
}

}  // namespace hemoflux::membrane

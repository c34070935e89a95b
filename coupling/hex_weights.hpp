/// Moment-correct immersed-boundary weights on hexahedra, from the cells around a node at X:
///
///   w_c = phi_c(X) p(x_c - X) . l,   M l = (1, 0, ..),   M = sum_c phi_c p p^T      moving least squares
///   phi_c(X) = phi(xi) phi(eta) phi(zeta),  (xi, eta, zeta) = A_c^-1 (X - x_c)
///
/// p: 1, x, y, z for the smooth kernels, and their products as well for `lagrange`; A_c: the three vectors between the
/// centres of opposite faces of cell c, so that phi, one of the kernels of delta_kernel.hpp, is measured in cells. Then
///
///   sum w_c = 1 and sum w_c (x_c - X) = 0 to rounding  (with `lagrange` the second moments vanish too),
///
/// so that forces and torques are conserved (5.10, 5.11) and linear (quadratic) velocities are met. Every cell brings a
/// window of its own, so the weights are continuous as X passes from cell to cell; on a uniform grid, away from walls,
/// phi3 and phi4 are those of the literature. Windows near the border are wider across it (WindowShape), so that they
/// reach a node on a wall from as many layers of cells as its moments need.
/// Levin, Math. Comput. 67, 1517 (1998); moving least squares for immersed boundaries: Vanella and Balaras, J. Comput.
/// Phys. 228, 6617 (2009).
#pragma once

#include <cmath>
#include <cstdint>

#include "coupling/delta_kernel.hpp"
#include "coupling/hex_walk.hpp"

namespace hemoflux::coupling {

/// Window of a cell: rows of A_c^-1.
struct HexWindow {
    double inverse[9];
};

/// A cell near another: the number of an offset to add to its centre, not 0 across a periodic pair.
struct HexCandidate {
    std::uint32_t cell, image;
};

/// Trivially copyable. The candidates of a cell are those whose windows reach into it.
struct HexNeighbourhoodView {
    const HexWindow* window = nullptr;        ///< [cell]
    const std::uint32_t* first = nullptr;     ///< [cells + 1]
    const HexCandidate* candidate = nullptr;  ///< of cell c: first[c] .. first[c + 1] - 1
    const Vec3d* image = nullptr;             ///< offsets, um
    const double* inverse_size = nullptr;     ///< [cell] 1 / cube root of the volume
};

namespace detail {

/// Monomials of d up to order 1 (N = 4) or 2 (N = 10), the constant first.
template <int N>
HEMOFLUX_INLINE void monomials(const Vec3d& d, double (&p)[N]) {
    p[0] = 1, p[1] = d.x, p[2] = d.y, p[3] = d.z;
    if constexpr (N == 10) {
        p[4] = d.x * d.x, p[5] = d.y * d.y, p[6] = d.z * d.z;
        p[7] = d.x * d.y, p[8] = d.y * d.z, p[9] = d.z * d.x;
    }
}

/// Solves the leading n x n part of the symmetric M l = (1, 0, ..), lower triangle by rows; the rest of l is zero. False
/// where it is not positive definite to rounding.
template <int N>
HEMOFLUX_INLINE bool solve_moments(const double (&m)[N][N], int n, double (&l)[N]) {
    double r[N][N];
    for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j) {
            double sum = m[i][j];
            for (int k = 0; k < j; ++k) sum -= r[i][k] * r[j][k];
            if (i != j) {
                r[i][j] = sum / r[j][j];
                continue;
            }
            if (!(sum > 1e-10 * m[i][i])) return false;
            r[i][i] = std::sqrt(sum);
        }
    for (int i = 0; i < n; ++i) {
        double sum = i == 0 ? 1 : 0;
        for (int k = 0; k < i; ++k) sum -= r[i][k] * l[k];
        l[i] = sum / r[i][i];
    }
    for (int i = n - 1; i >= 0; --i) {
        for (int k = i + 1; k < n; ++k) l[i] -= r[k][i] * l[k];
        l[i] /= r[i][i];
    }
    for (int i = n; i < N; ++i) l[i] = 0;
    return true;
}

}  // namespace detail

/// Writes the weights of all candidates of cell `host` for a node at x, in the place where the grid has this cell. Returns
/// how many monomials could be met: N, 4 where the cells around do not determine second moments, or less. w may be null.
template <class Phi, int N>
HEMOFLUX_INLINE int hex_weights(const HexNeighbourhoodView& g, const Vec3d* centre, std::uint32_t host,
                                const Vec3d& x, double* w) {
    const std::uint32_t first = g.first[host], count = g.first[host + 1] - first;
    const double scale = g.inverse_size[host];
    double m[N][N] = {}, p[N], l[N] = {};
    for (std::uint32_t j = 0; j < count; ++j) {
        const HexCandidate c = g.candidate[first + j];
        const HexWindow& a = g.window[c.cell];
        const Vec3d d = centre[c.cell] + g.image[c.image] - x;
        double phi = 1;
        for (int q = 0; q < 3; ++q)
            phi *= Phi::value(
                std::fabs(a.inverse[3 * q] * d.x + a.inverse[3 * q + 1] * d.y + a.inverse[3 * q + 2] * d.z));
        if (w) w[j] = phi;
        if (phi == 0) continue;
        detail::monomials(scale * d, p);
        for (int i = 0; i < N; ++i) {
            const double share = phi * p[i];
            for (int k = 0; k <= i; ++k) m[i][k] += share * p[k];
        }
    }
    int n = N;
    if (!detail::solve_moments(m, n, l)) {
        n = N > 4 ? 4 : 1;
        if (!detail::solve_moments(m, n, l)) {
            n = 1;
            if (!detail::solve_moments(m, n, l)) n = 0, l[0] = 0;
        }
    }
    for (std::uint32_t j = 0; w && j < count; ++j) {
        if (w[j] == 0) continue;
        const HexCandidate c = g.candidate[first + j];
        detail::monomials(scale * (centre[c.cell] + g.image[c.image] - x), p);
        double sum = 0;
        for (int i = 0; i < N; ++i) sum += p[i] * l[i];
        w[j] *= sum;
    }
    return n;
}

}  // namespace hemoflux::coupling

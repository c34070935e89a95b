/// Bending by the discrete Laplacian of Gompper and Kroll (1996), with cotangent weights and Voronoi areas.
///
///   V_j = sum_k dA_k/dR_j = 1/2 sum_m (cot a + cot b) (R_j - R_m),   s_j = 1/8 sum_m (cot a + cot b) L_jm^2,
///   H_j = V_j / s_j,  |H_j| = |c_1 + c_2|, along the normal,
///   E_B = K_B/2 sum_j |V_j|^2 / s_j - K_B C_0 M + K_B/2 C_0^2 A + K_ADE / A_0 (M - M_0)^2.
///
/// a, b are the angles opposite to edge (j, m). Multiplying out (C - C_0)^2 leaves C itself, whose sign |H|
/// lacks, only in its integral: there M = sum_s theta_s L_s stands, exact for a polyhedron, as in bending.hpp,
/// so that the scheme has C_0 and the area difference without any choice of a vertex normal.
///
/// Gradient, at fixed H and q_j = |H_j|^2 / 2, gathered triangle by triangle:
///   dE/dR_j = K_B sum_k [ (d^2 A_k/dR^2 . H)_j - dT_k/dR_j ],   T_k = sum_corners q s^k.
/// For triangle (j, m, n), d = R_m - R_j, e = R_n - R_j, rim = e - d, xi = d x e, normal N = xi/|xi|:
///   dA_k/dR_j = N x rim / 2;  (d^2 A.H)_j = [dN x rim + N x drim]/2,  drim = H_n - H_m,
///   dN = (dxi - N (N.dxi))/|xi|,  dxi = (H_m - H_j) x e + d x (H_n - H_j);
///   8 |xi| T_k = (q_j + q_m) (e.rim) d^2 - (q_j + q_n) (d.rim) e^2 + (q_m + q_n) (d.e) rim^2.
/// A Voronoi area s_j that is not positive (strongly obtuse triangles) is an error.
#pragma once

#include <cstddef>
#include <memory>

#include "membrane/forces.hpp"

namespace hemoflux::membrane {

/// Device pointers of one evaluation besides those of ForceView.
struct LaplacianView {
    double k_bending;      ///< K_B, 1e-17 J
    double *hx, *hy, *hz;  ///< H_j of each vertex of each cell, 1/um
    CellSums* sums;        ///< of each cell: the first term of E_B and `degenerate` only
};

/// Scratch memory of the sums; one per batch.
class LaplacianScratch {
  public:
    /// For a batch of so many cells, `stride` elements each.
    LaplacianScratch(std::size_t cells, std::size_t stride);
    ~LaplacianScratch();
    LaplacianScratch(LaplacianScratch&&) noexcept;
    LaplacianScratch& operator=(LaplacianScratch&&) noexcept;

  private:
    struct Memory;
    std::unique_ptr<Memory> memory_;
    friend void laplacian_pass(const ForceView& view, const LaplacianView& laplacian,
                               LaplacianScratch& scratch);
};

/// Fills H and the sums from the positions.
void laplacian_pass(const ForceView& view, const LaplacianView& laplacian, LaplacianScratch& scratch);

/// Adds the force of the first term of E_B to the forces; needs laplacian_pass() at the same positions.
void laplacian_force_pass(const ForceView& view, const LaplacianView& laplacian);

}  // namespace hemoflux::membrane

/// Linearly implicit Euler step in delta form with approximate factorisation (AF), momentum only:
///
///   (I - dt nu Lx)(I - dt nu Ly)(I - dt nu Lz) dQ = dt R(Q)
///   L_x phi_i = [ (phi_{i+1} - phi_i)/s_{i+1/2} - (phi_i - phi_{i-1})/s_{i-1/2} ] / dx_i,
///
/// s the distance of the cell centres (stiffened by s/(2 delta) where the streaming distance delta of the
/// faces is less than s/2, as in flat cells, because the explicit flux then is), with 2 nu instead of nu
/// along a component's own direction (2.45). A given velocity mirrors the increment (ghost = -dQ), a
/// zero-gradient one copies it, periodic lines are cyclic (Sherman-Morrison). nu is constant and must be at
/// least half the local viscosity everywhere; the steady state does not depend on it. The factors depend on
/// dt and the grid only and are computed once.
///
/// Density is advanced explicitly up to dt c = factored_limit h. Streaming from both sides of a face diffuses it by delta/3,
/// 2/(3 dx) along every axis for the shortest waves, which an explicit step bears up to dt c = h only. In longer steps it is
/// implicit too, with the mass that the new momentum carries (sound then passes from momentum to density and back within
/// a step):
///
///   (I - dt Mx)(I - dt My)(I - dt Mz) drho = dt (R_rho - div dq),   M_x = the operator L_x with delta/3 in place of nu
///
/// dq the increments of momentum found first. Again the steady state is that of the residual, and the mass of a closed
/// box is kept to rounding.
#pragma once

#include <array>
#include <vector>

#include "exchange/buffer.hpp"
#include "fluid/boundary.hpp"
#include "fluid/factored_lines.hpp"
#include "fluid/grid.hpp"
#include "fluid/residual.hpp"

namespace hemoflux::fluid {

/// Prefactored tridiagonal lines of one component along one axis; trivially copyable.
struct LineFactors {
    const double* lower = nullptr;   ///< coefficient of the cell below
    const double* pivot = nullptr;   ///< reciprocal pivot
    const double* upper = nullptr;   ///< eliminated coefficient of the cell above
    const double* cyclic = nullptr;  ///< correction vector of a periodic line, null otherwise
    double cyclic_last = 0;          ///< weight of the last unknown in the correction
    double cyclic_scale = 0;         ///< 1 / (1 + v.z)
};

/// Solves the three factors in place.
class Factored {
  public:
    /// nu: kinematic viscosity of the operator; dt: step. Both in the fluid's units.
    Factored(const Grid& grid, const Boundary& boundary, double nu, double dt);

    /// r[1..3] <- dQ from r[1..3] = R.
    void solve(const ResidualView& r) const;

    /// Whether the step is so long that the density must be implicit.
    [[nodiscard]] bool implicit_density() const { return implicit_density_; }
    /// r[0] <- drho / dt from r[0] = R and the increments r[1..3] that solve() has left; fills their ghost cells.
    void solve_density(const GridView& grid, const Boundary& boundary, const ResidualView& r) const;

    /// What the implicit operator, beyond dt R, lets through the sides that are not periodic: the momentum that the fluid
    /// gains by it in a step whose increments of momentum (per volume; three components of all cells, x fastest) these
    /// are. On the host, for the balance of momentum.
    [[nodiscard]] Vec3d side_impulse(std::array<std::vector<double>, 3> increments) const;

    /// The step the factors are for.
    [[nodiscard]] double dt() const { return dt_; }
    /// The viscosity the factors are for.
    [[nodiscard]] double nu() const { return nu_; }

  private:
    exchange::Layout layout_;
    double nu_, dt_;
    std::vector<exchange::Buffer<double>> buffers_;
    std::array<std::array<LineFactors, 3>, 3> factors_;     // [axis][component]
    std::array<std::array<LineOperator, 3>, 3> operators_;  // the same, not factored
    std::array<std::vector<double>, 3> widths_;
    std::array<LineFactors, 3> density_factors_;
    bool implicit_density_;
};

}  // namespace hemoflux::fluid

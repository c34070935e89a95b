/// Viscosity inside and outside the cells:
///
///   nu = nu_ext + sum_c (nu_int,c - nu_ext) H(d_c)                                      (6.45)
///   H(d) = 1/2 [1 + d/h + sin(pi d/h)/pi] for |d| <= h, 0 outside, 1 inside             (6.46)
///
/// the sum of (6.45) limited to the range of the given viscosities where cells overlap; d is the signed distance to
/// membrane c and h the local cell (signed_distance.hpp).
///
/// A membrane's own viscosity may be lent to the fluid (the proposal of section 7.6): a surface viscosity mu_s is
/// added over the band as mu_s delta(d), whose integral across the membrane is mu_s,
///
///   delta(d) = dH/dd = [1 + cos(pi d/h)] / (2 h),  h as in (6.46): local_cells times the cell's largest width
///
/// d to a membrane is measured again only when the membrane has moved noticeably since it was last measured: a node by
/// more than `normal` half-widths along its normal, or by more than `total` half-widths in any direction (a membrane
/// that slides along itself, as in tank treading, encloses the same cells). d is then off by no more than about
/// (normal + total^2 h kappa / 2) h, kappa the curvature of the membrane. Each membrane has its own turn.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "coupling/fluid_grid.hpp"
#include "coupling/signed_distance.hpp"
#include "exchange/buffer.hpp"

namespace hemoflux::coupling {

/// H of (6.46) as a function of d/h in [-1, 1].
HEMOFLUX_INLINE double heaviside(double ratio) {
    constexpr double pi = 3.14159265358979323846;
    if (ratio >= 1) return 1;
    if (ratio <= -1) return 0;
    return 0.5 * (1 + ratio + std::sin(pi * ratio) / pi);
}

/// h delta(d), delta = dH/dd.
HEMOFLUX_INLINE double heaviside_slope(double ratio) {
    constexpr double pi = 3.14159265358979323846;
    return ratio > -1 && ratio < 1 ? 0.5 * (1 + std::cos(pi * ratio)) : 0;
}

/// How far a node may move before the field is recomputed, in half-widths of the band. Zero: recompute
/// always.
struct MotionLimits {
    double normal = 0.05;
    double total = 0.5;
};

/// Keeps the viscosity of the fluid cells in step with the membranes.
class InteriorViscosity {
  public:
    /// Membranes as in SignedDistance; nu_inside has one value per membrane cell; surface_nu: surface viscosity over
    /// density (um^2 c). Viscosities must be positive, surface_nu not negative (InputError).
    InteriorViscosity(const FluidGrid& grid, const std::vector<std::array<int, 3>>& triangles,
                      std::size_t vertices, const std::vector<double>& nu_inside, double nu_outside,
                      HalfWidth half_width = {}, MotionLimits limits = {}, double surface_nu = 0);
    ~InteriorViscosity();

    /// Recomputes the viscosity of the fluid's cells, value i at nu[stride * i] (device), with the membranes of which a
    /// node of x, y, z (device, um, cell-major) has passed a limit, and says whether there was one. The first call
    /// takes all. Ghost cells are left to the fluid solver.
    bool update(const double* x, const double* y, const double* z, double* nu, std::size_t stride = 1);
    /// Recomputes with all membranes, moved or not. For a restart: with the positions() of the checkpoint, so that
    /// field and later decisions are those of the uninterrupted run.
    void recompute(const double* x, const double* y, const double* z, double* nu, std::size_t stride = 1);
    /// Node positions (x, y, z; host, um) with which each membrane was last measured, the state that a checkpoint must
    /// hold; empty before the first time.
    [[nodiscard]] std::array<std::vector<double>, 3> positions() const;
    /// Number of recomputations so far.
    [[nodiscard]] std::size_t recomputations() const { return recomputations_; }

  private:
    struct Motion;
    /// Recomputes with the membranes that are marked, and the others as they were.
    void recompute_moved(const std::vector<int>& moved, const double* x, const double* y, const double* z,
                         double* nu, std::size_t stride);

    std::unique_ptr<MembraneBand> band_;
    double nu_outside_, low_, high_, surface_nu_;
    HalfWidth half_width_;
    MotionLimits limits_;
    std::size_t vertices_, triangles_, recomputations_ = 0;
    /// Triangles around each vertex: vertex v has ring_[ring_begin_[v]] .. ring_[ring_begin_[v + 1] - 1].
    exchange::Buffer<int> ring_begin_, ring_;
    exchange::Buffer<double> nu_inside_;
    /// Membranes that the recomputation takes anew.
    exchange::Buffer<int> moved_;
    /// Positions and unit normals with which each membrane was last measured.
    exchange::Buffer<double> position_[3], normal_[3];
    std::unique_ptr<Motion> motion_;
};

}  // namespace hemoflux::coupling

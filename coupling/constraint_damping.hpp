/// The penalties of volume, area and triangle areas (6.3, 6.14), linearised and implicit at the nodes.
///
/// They are the stiffest springs of a cell: at 1.6 /s the explicit step of a red blood cell is bound by K_V first, then by
/// K_A,k and K_A, whose moduli of 1000 Pa, 100 and 1000 uN/m stand against a K_S of 6. An implicit step of a penalty with a
/// lumped mobility leaves of the rate at which its constraint changes the share 1/(1 + s). That is what happens here to the
/// velocity u that moves the nodes; the fluid receives all forces as they are:
///
///   u_i <- u_i - w/d_i sum_k g_ki (sum_j g_kj . u_j) / A_k        four times; g_ki = dA_k/dR_i, d_i = sum_k |g_ki|^2 / A_k
///   u <- u - s/(1 + s) P u          P the projection on grad V and grad A: dV/dt and dA/dt are divided by 1 + s
///
/// The first damps what varies from node to node most: no mode of it grows, since 3 w < 1. A rest state has no rates,
/// so it is not changed, nor are the volume and area errors, which the moduli set; rigid motions pass through.
/// s = 9 strength and w = 0.3 min(1, strength) with strength = step / explicit limit - 1: nothing at the explicit limit.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "exchange/buffer.hpp"
#include "exchange/vec3.hpp"

namespace hemoflux::coupling {

/// Gradients at one triangle: dA_k/dR of its corners, twice its area vector, 1/A_k.
struct TriangleGradient {
    Vec3d area[3];
    Vec3d normal2;
    double inverse_area;
};

/// Gradients at one node: dV/dR, dA/dR, and 1/d_i (0 at padding).
struct NodeGradient {
    Vec3d volume, area;
    double inverse_scale;
};

/// Inner products over one cell.
struct GradientSums {
    double volume2 = 0, mixed = 0, area2 = 0, volume_rate = 0, area_rate = 0;
    HEMOFLUX_FN GradientSums& operator+=(const GradientSums& b) {
        volume2 += b.volume2, mixed += b.mixed, area2 += b.area2;
        volume_rate += b.volume_rate, area_rate += b.area_rate;
        return *this;
    }
};

/// Damps the velocities of the nodes of `cells` closed surfaces of one connectivity.
class ConstraintDamping {
  public:
    /// stride: nodes from one cell to the next; triangles counter-clockwise seen from outside. strength > 0.
    ConstraintDamping(const std::vector<std::array<int, 3>>& triangles, std::size_t stride, std::size_t cells,
                      double strength);
    ~ConstraintDamping();

    /// For steps of another length; > 0.
    void set_strength(double strength);
    /// Damps velocities u (device, in place) of the nodes at x, y, z (device, um). Padding gets the velocity of the first
    /// node of its cell.
    void apply(const double* x, const double* y, const double* z, const std::array<double*, 3>& u);

  private:
    struct Scratch;
    /// Whether there are cells enough to give each to one thread.
    [[nodiscard]] bool taken_one_by_one() const;

    std::size_t triangles_, stride_, cells_;
    double share_ = 0, weight_ = 0;
    exchange::Buffer<int> corners_, ring_begin_, ring_;
    exchange::Buffer<TriangleGradient> triangle_;
    exchange::Buffer<NodeGradient> node_;
    exchange::Buffer<double> rate_;
    exchange::Buffer<Vec3d> pull_;
    exchange::Buffer<GradientSums> sums_;
    std::unique_ptr<Scratch> scratch_;
};

}  // namespace hemoflux::coupling

/// Membrane nodes carried by the fluid, and kept about the centre of the box.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "exchange/buffer.hpp"
#include "exchange/vec3.hpp"

namespace hemoflux::coupling {

/// Moves n nodes (device, um) by dt times their velocity: R <- R + dt V  (6.47).
void move(std::size_t n, double dt, const double* vx, const double* vy, const double* vz, double* x,
          double* y, double* z);

/// sum += term for n numbers (device): a constant load on the nodes of a membrane.
void add(std::size_t n, const double* term, double* sum);

/// Finds the common volume centroid of closed surfaces and shifts them back to where it was.
class Recentring {
  public:
    /// `cells` surfaces of `stride` nodes each, joined by `triangles`; the centroid is held at `target` (um).
    Recentring(const std::vector<std::array<int, 3>>& triangles, std::size_t stride, std::size_t cells,
               const Vec3d& target);
    ~Recentring();

    /// Shifts all nodes (device, um) so that the volume centroid of all cells together lies at the target.
    /// Returns the shift.
    Vec3d apply(double* x, double* y, double* z);

  private:
    struct Scratch;
    exchange::Buffer<int> corners_;
    std::size_t stride_, cells_, triangles_;
    Vec3d target_;
    std::unique_ptr<Scratch> scratch_;
};

}  // namespace hemoflux::coupling

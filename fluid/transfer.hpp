/// A flow known at points, carried to another grid: the start of a steady run from a coarser grid's solution.
/// Between the points: the mean of the eight nearest ones weighted by 1 / distance^2 (Shepard 1968). It never leaves the
/// range of the values; the iteration that follows makes good for the rest.
#pragma once

#include <vector>

#include "fluid/flow.hpp"

namespace hemoflux::fluid {

/// A flow known at points, as a function of place.
class PointFlow {
  public:
    /// One value a point. Throws InputError when there are none, or not as many values as points.
    PointFlow(std::vector<Vec3d> points, std::vector<FlowPoint> values);

    /// Density and velocity at x, the value of a point there if there is one.
    FlowPoint operator()(const Vec3d& x) const;

  private:
    [[nodiscard]] std::size_t bin_of(double x, std::size_t axis) const;

    std::vector<Vec3d> points_;
    std::vector<FlowPoint> values_;
    double low_[3], size_[3];                  // of the bins
    std::size_t bins_[3];                      // along each axis
    std::vector<std::size_t> first_, member_;  // points of every bin
};

/// Points and values of a flow, as PointFlow takes them.
PointFlow sample(const Flow& flow);

/// Replaces density and velocity of all cells of `to` by those of `from`.
void carry_over(const PointFlow& from, Flow& to);

}  // namespace hemoflux::fluid

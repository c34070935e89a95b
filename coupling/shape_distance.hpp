/// Signed distance to one closed surface, tabulated once on a lattice around it and interpolated: for the many questions
/// of a packing. Host only.
#pragma once

#include <array>
#include <vector>

#include "exchange/vec3.hpp"

namespace hemoflux::coupling {

/// Positive outside. Within an interpolation error of about spacing^2/8 times the curvature.
class ShapeDistance {
  public:
    /// margin: how far around the surface it is known, um; spacing of the lattice, um.
    ShapeDistance(const std::vector<Vec3d>& positions, const std::vector<std::array<int, 3>>& triangles,
                  double margin, double spacing = 0.15);

    /// Distance from r; beyond the lattice the margin.
    [[nodiscard]] double operator()(const Vec3d& r) const;

  private:
    [[nodiscard]] std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
        return (k * n_[1] + j) * n_[0] + i;
    }
    Vec3d lower_{0, 0, 0};
    double margin_, spacing_;
    std::size_t n_[3];
    std::vector<double> value_;
};

}  // namespace hemoflux::coupling

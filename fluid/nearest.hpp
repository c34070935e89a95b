/// Nearest of many points: a k-d tree, built once.
#pragma once

#include <cstddef>
#include <vector>

#include "exchange/vec3.hpp"

namespace hemoflux::fluid {

/// Finds the nearest of a fixed set of points.
class NearestPoint {
  public:
    /// points must not be empty.
    explicit NearestPoint(std::vector<Vec3d> points);

    /// Index of the point nearest to `at`.
    [[nodiscard]] std::size_t operator()(const Vec3d& at) const;

  private:
    void build(std::size_t first, std::size_t last);
    void search(std::size_t first, std::size_t last, const Vec3d& at, std::size_t& best,
                double& distance2) const;
    std::vector<Vec3d> points_;
    std::vector<std::size_t> order_;  // ranges of the tree: the middle entry splits its range
    std::vector<unsigned char> axis_;
};

}  // namespace hemoflux::fluid

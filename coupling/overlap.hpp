/// The smallest distance between the membranes of different cells, from the nodes of each to the surfaces of the others;
/// negative where a node is inside another cell.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "coupling/node_bins.hpp"
#include "exchange/buffer.hpp"

namespace hemoflux::coupling {

/// A node and how far it is from the nearest other cell.
struct Gap {
    double distance = 1e300;  ///< um; infinite (1e300) when no other cell is within the reach of the search
    int cell = 0, node = 0, other = 0;
};

/// Finds the smallest gap; keeps the memory it needs.
class OverlapCheck {
  public:
    /// Cells of one set of triangles; the vertices of cell c begin at c * stride. reach: how far to look, um; at least
    /// an edge, so that a node that lies on a triangle sees a corner of it.
    OverlapCheck(const NodeBox& box, double reach, const std::vector<std::array<int, 3>>& triangles,
                 std::size_t cells, std::size_t vertices, std::size_t stride);
    ~OverlapCheck();

    /// The smallest gap of cells at x, y, z (device, um).
    [[nodiscard]] Gap smallest(const double* x, const double* y, const double* z);
    /// How far it looks, um.
    [[nodiscard]] double reach() const { return bins_.reach(); }

  private:
    struct Scratch;

    NodeBins bins_;
    std::size_t stride_;
    /// Triangles around vertex v: corners ring_[3 i] .. of i = ring_begin_[v] .. ring_begin_[v + 1] - 1, v first.
    exchange::Buffer<int> ring_begin_, ring_;
    std::unique_ptr<Scratch> scratch_;
};

}  // namespace hemoflux::coupling

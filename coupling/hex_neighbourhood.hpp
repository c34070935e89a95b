/// The cells around every hexahedron whose windows (hex_weights.hpp) reach into it.
#pragma once

#include <cstddef>
#include <vector>

#include "coupling/hex_weights.hpp"
#include "exchange/buffer.hpp"

namespace hemoflux::coupling {

class HexCells;

/// How far the window of a kernel reaches, in cells; how much wider it is across the border in how many layers of cells
/// there, so that a node on a wall finds two layers, or three for second moments.
struct WindowShape {
    double reach = 0, stretch = 1;
    int layers = 0;
};
/// InputError for phi2, whose hat leaves a node at a cell's centre alone with this cell.
WindowShape window_shape(Kernel kernel);

/// Owns lists and windows on the device.
class HexNeighbourhood {
  public:
    /// Lists and windows of all cells. InputError as window_shape().
    HexNeighbourhood(const HexCells& cells, Kernel kernel);

    /// Valid as long as this object lives.
    [[nodiscard]] HexNeighbourhoodView view() const {
        return {window_.data(), first_.data(), candidate_.data(), image_.data(), inverse_size_.data()};
    }
    /// Length of the longest list: weights of a node.
    [[nodiscard]] std::size_t width() const { return width_; }
    /// The lists on the host.
    [[nodiscard]] const std::vector<std::uint32_t>& first() const { return host_first_; }
    [[nodiscard]] const std::vector<HexCandidate>& candidates() const { return host_candidate_; }

  private:
    std::vector<std::uint32_t> host_first_;
    std::vector<HexCandidate> host_candidate_;
    std::size_t width_ = 0;
    exchange::Buffer<HexWindow> window_;
    exchange::Buffer<std::uint32_t> first_;
    exchange::Buffer<HexCandidate> candidate_;
    exchange::Buffer<Vec3d> image_;
    exchange::Buffer<double> inverse_size_;
};

}  // namespace hemoflux::coupling

/// An unstructured grid of hexahedra as the coupling sees it.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "coupling/fluid_grid.hpp"
#include "coupling/hex_neighbourhood.hpp"
#include "coupling/hex_walk.hpp"
#include "exchange/buffer.hpp"
#include "fluid/nearest.hpp"
#include "meshing/hex_grid.hpp"

namespace hemoflux::coupling {

/// Owns what kernels know of the grid.
class HexCells final : public FluidGrid {
  public:
    /// InputError when a cell cannot be seen whole from its centre, or the grid has more than three different periods.
    /// The grid must outlive this object.
    explicit HexCells(const meshing::HexGrid& grid);

    [[nodiscard]] std::size_t field_size() const override { return grid_.cells(); }
    [[nodiscard]] double smallest() const override { return smallest_; }
    /// The box around the nodes. InputError unless every period is parallel to an axis.
    [[nodiscard]] NodeBox box() const override;
    [[nodiscard]] bool contains(const Vec3d& at) const override;
    [[nodiscard]] double cell_volume(const Vec3d& at) const override;
    [[nodiscard]] double width(const Vec3d& at, const Vec3d& n) const override;
    [[nodiscard]] std::unique_ptr<NodeLink> link(Kernel kernel, std::size_t nodes) const override;
    [[nodiscard]] std::unique_ptr<MembraneBand> band(const BandSurfaces& surfaces,
                                                     HalfWidth half_width) const override;

    /// Valid as long as this object lives.
    [[nodiscard]] const HexWalkView& walk() const { return walk_; }
    /// Reciprocal volumes of the cells, device.
    [[nodiscard]] const double* inverse_volume() const { return inverse_volume_.data(); }
    /// The cell with the centre nearest to a point, where the search for a node begins.
    [[nodiscard]] std::uint32_t nearest(const Vec3d& at) const {
        return static_cast<std::uint32_t>(nearest_(at));
    }
    /// The cells around every cell for a kernel, made when first asked for.
    [[nodiscard]] const HexNeighbourhood& neighbourhood(Kernel kernel) const;
    /// The grid it was made of.
    [[nodiscard]] const meshing::HexGrid& grid() const { return grid_; }
    /// What lies across the six faces of every cell, on the host.
    [[nodiscard]] const std::vector<HexStep>& steps() const { return steps_; }
    /// The three vectors between the centres of opposite faces of a cell.
    [[nodiscard]] const std::array<Vec3d, 3>& sides(std::uint32_t cell) const { return sides_[cell]; }

  private:
    void find_steps();
    void find_sides();
    void refuse_hidden_faces() const;

    const meshing::HexGrid& grid_;
    std::vector<HexStep> steps_;
    std::vector<Vec3d> periods_;
    std::vector<std::array<Vec3d, 3>> sides_;
    double smallest_ = 0;
    fluid::NearestPoint nearest_;
    HexWalkView host_walk_, walk_;
    exchange::Buffer<Vec3d> centre_, node_;
    exchange::Buffer<std::uint32_t> corner_;
    exchange::Buffer<HexStep> step_;
    exchange::Buffer<double> inverse_volume_;
    mutable std::map<Kernel, HexNeighbourhood> neighbourhoods_;
};

}  // namespace hemoflux::coupling

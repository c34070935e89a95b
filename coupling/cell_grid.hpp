/// The rectilinear fluid grid as the coupling sees it: three axes and the place of every cell in memory.
#pragma once

#include <array>

#include "coupling/axis_view.hpp"
#include "coupling/fluid_grid.hpp"
#include "exchange/layout.hpp"
#include "meshing/rectilinear.hpp"

namespace hemoflux::coupling {

/// Trivially copyable: what coupling kernels know of the grid.
struct CellGridView {
    AxisView axis[3];
    exchange::Layout layout;
};

/// Owns the axes on the device.
class CellGrid final : public FluidGrid {
  public:
    /// A grid whose axes are periodic or end at walls (every other boundary condition counts as a wall).
    /// InputError as AxisData.
    CellGrid(const meshing::RectilinearGrid& grid, std::array<bool, 3> periodic)
        : axes_{AxisData(grid.axes[0], periodic[0], "x"), AxisData(grid.axes[1], periodic[1], "y"),
                AxisData(grid.axes[2], periodic[2], "z")},
          layout_(grid.axes[0].cells(), grid.axes[1].cells(), grid.axes[2].cells()),
          grid_(grid) {}

    /// Valid as long as this object lives.
    [[nodiscard]] CellGridView view() const {
        return {{axes_[0].view(), axes_[1].view(), axes_[2].view()}, layout_};
    }

    [[nodiscard]] std::size_t field_size() const override { return layout_.size; }
    [[nodiscard]] double smallest() const override { return grid_.smallest(); }
    [[nodiscard]] NodeBox box() const override;
    [[nodiscard]] bool contains(const Vec3d& at) const override;
    [[nodiscard]] double cell_volume(const Vec3d& at) const override;
    [[nodiscard]] double width(const Vec3d& at, const Vec3d& n) const override;
    [[nodiscard]] std::unique_ptr<NodeLink> link(Kernel kernel, std::size_t nodes) const override;
    [[nodiscard]] std::unique_ptr<MembraneBand> band(const BandSurfaces& surfaces,
                                                     HalfWidth half_width) const override;

  private:
    std::array<AxisData, 3> axes_;
    exchange::Layout layout_;
    meshing::RectilinearGrid grid_;
};

}  // namespace hemoflux::coupling

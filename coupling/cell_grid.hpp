/// The fluid grid as the coupling sees it: three axes and the place of every cell in memory.
#pragma once

#include <array>

#include "coupling/axis_view.hpp"
#include "exchange/layout.hpp"
#include "meshing/rectilinear.hpp"

namespace hemoflux::coupling {

/// Trivially copyable: what coupling kernels know of the grid.
struct CellGridView {
    AxisView axis[3];
    exchange::Layout layout;
};

/// Owns the axes on the device.
class CellGrid {
  public:
    /// A grid whose axes are periodic or end at walls (every other boundary condition counts as a wall).
    /// InputError as AxisData.
    CellGrid(const meshing::RectilinearGrid& grid, std::array<bool, 3> periodic)
        : axes_{AxisData(grid.axes[0], periodic[0], "x"), AxisData(grid.axes[1], periodic[1], "y"),
                AxisData(grid.axes[2], periodic[2], "z")},
          layout_(grid.axes[0].cells(), grid.axes[1].cells(), grid.axes[2].cells()),
          smallest_(grid.smallest()) {}

    /// Valid as long as this object lives.
    [[nodiscard]] CellGridView view() const {
        return {{axes_[0].view(), axes_[1].view(), axes_[2].view()}, layout_};
    }
    /// Smallest width on any axis, um.
    [[nodiscard]] double smallest() const { return smallest_; }

  private:
    std::array<AxisData, 3> axes_;
    exchange::Layout layout_;
    double smallest_;
};

}  // namespace hemoflux::coupling

/// Interpolation of a cell field of a rectilinear grid to any point: cubic Lagrange polynomials over the four nearest
/// nodes of each axis, exact for cubics on any spacing. Nodes are the cell centres and, where the field is known on a
/// side of the box, the points of that side.
#pragma once

#include <array>
#include <vector>

#include "exchange/vec3.hpp"
#include "fluid/grid.hpp"

namespace hemoflux::fluid {

/// What a field's ghost cells say about one side of the box.
enum class Border {
    open,     ///< nothing: interpolation extrapolates from inside
    face,     ///< the mean of border and ghost cell is the value on the side
    periodic  ///< ghost cells are nodes like all others
};

/// A field between the cell centres of a rectilinear grid.
class GridInterpolant {
  public:
    /// padded: values in the grid's layout with ghost cells filled as `borders` (x-, x+, y-, y+, z-, z+) say.
    GridInterpolant(const Grid& grid, const std::vector<double>& padded,
                    const std::array<Border, 6>& borders);

    /// Value at a point; outside the box the polynomial of the border.
    [[nodiscard]] double operator()(const Vec3d& at) const;

  private:
    std::array<std::vector<double>, 3> nodes_;  // coordinates
    std::vector<double> values_;                // x fastest
};

/// Lays interior values (x fastest) into the grid's padded layout; ghost cells become sign * the mirror cell of every
/// side: sign = -1 says the field is zero there (Border::face).
std::vector<double> padded_field(const Grid& grid, const std::vector<double>& interior, double sign);

}  // namespace hemoflux::fluid

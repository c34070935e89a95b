/// Geometry of a rectilinear grid as kernels see it: reciprocal spacings, 1-D gradient coefficients and
/// streaming distances.
///
/// Gradients reduce to 1-D differences on each axis (A.4 on a rectilinear grid):
///   dphi/dx_i = plus_i (phi_{i+1} - phi_i) + minus_i (phi_i - phi_{i-1}),  s_+- the distances of the cell centres.
///   weighted least squares (A.33-A.35):  plus_i = s_- / (s_+ (s_+ + s_-)),  minus_i = s_+ / (s_- (s_+ + s_-)),
///                                        exact for quadratics
///   Green-Gauss, linear face values:     plus_i = 1 / (2 s_+),  minus_i = 1 / (2 s_-),  exact for linear fields
/// Streaming distance of a face: the smallest distance from its centre to the two cells' other faces, so that
/// every lattice node lies inside the two cells; a direction one cell thick does not limit it. At most 3 nu /
/// (gamma tau_floor), which keeps tau - 1/2 >= tau_floor.
#pragma once

#include <array>
#include <vector>

#include "exchange/buffer.hpp"
#include "exchange/layout.hpp"
#include "fluid/gradient_method.hpp"
#include "meshing/rectilinear.hpp"

namespace hemoflux::fluid {

/// One axis in device memory. Index i is the cell, -ghosts .. n+ghosts-1 (and a pack beyond); face i lies
/// between the cells i and i + 1.
struct AxisView {
    const double* plus = nullptr;         ///< gradient coefficients, 1/length
    const double* minus = nullptr;        ///< gradient coefficients, 1/length
    const double* half = nullptr;         ///< half the cell width
    const double* inverse = nullptr;      ///< 1 / cell width
    const double* weight_left = nullptr;  ///< distance weight of the cell left of a face
    const double* normal = nullptr;  ///< limit of delta across the face: the smaller width of the two cells
    const double* inv_normal = nullptr;   ///< its reciprocal
    const double* lateral = nullptr;      ///< limit of delta along a face of cell i: half its width
    const double* inv_lateral = nullptr;  ///< its reciprocal
};

/// Layout and the three axes; trivially copyable.
struct GridView {
    exchange::Layout layout;
    AxisView axis[3];
    double delta =
        0;  ///< streaming distance on every face, half the width, where all cells are cubes; else 0
};

/// Owns the arrays behind a GridView.
class Grid {
  public:
    /// periodic: axes whose ghost cells repeat the other end (else they mirror the border cells).
    /// delta_max: largest streaming distance allowed, in the grid's length unit.
    /// Throws InputError for the hybrid gradient, whose weights are no product of axes.
    Grid(const meshing::RectilinearGrid& grid, std::array<bool, 3> periodic, double delta_max = 1e300,
         GradientMethod gradient = GradientMethod::least_squares);

    /// Valid as long as this object lives.
    [[nodiscard]] const GridView& view() const { return view_; }
    /// The grid it was made of.
    [[nodiscard]] const meshing::RectilinearGrid& rectilinear() const { return rectilinear_; }
    /// The axes that are periodic.
    [[nodiscard]] std::array<bool, 3> periodic() const { return periodic_; }
    /// True if every axis has equal widths.
    [[nodiscard]] bool uniform() const { return uniform_; }
    /// Widths of one axis with its two ghost cells on both sides.
    [[nodiscard]] const std::vector<double>& ghosted_widths(int axis) const {
        return widths_[static_cast<std::size_t>(axis)];
    }

    /// Smallest streaming distance of all faces across one axis.
    [[nodiscard]] double smallest_delta(int axis) const {
        return smallest_delta_[static_cast<std::size_t>(axis)];
    }

  private:
    meshing::RectilinearGrid rectilinear_;
    std::array<bool, 3> periodic_;
    bool uniform_;
    std::array<double, 3> smallest_delta_{};
    std::array<std::vector<double>, 3> widths_;
    std::vector<exchange::Buffer<double>> buffers_;
    GridView view_;
};

/// Cell centres of one axis; entry i + exchange::ghosts is cell i, two ghost cells on either side.
std::vector<double> ghosted_centres(const Grid& grid, std::size_t axis);

}  // namespace hemoflux::fluid

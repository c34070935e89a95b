/// Rectilinear grids: each axis is its own list of cell faces.
///
///   uniform    dx_i = L / N
///   plateau    dx_i = L f_i / sum f,  f_i = (e^{b(x_i - a)} + 1)(e^{b(-x_i - a)} + 1),
///              x_i = i - N/2 - 1/2                                                   (5.31)
///   Chebyshev  x_i = L/2 [1 - cos(pi (i - 1) / (N_p - 1))],  i = 1 .. N_p,
///              N_p = N + 1 points                                                    (3.28)
///
/// In (5.31) x_i is the index of cell i = 1 .. N counted from the centre, so that a and 1/b are numbers of
/// cells.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace hemoflux::meshing {

/// One direction of a rectilinear grid: N + 1 ascending face coordinates bound N cells.
struct Axis {
    /// Coordinates of the cell faces, ascending, um.
    std::vector<double> faces;

    /// Number of cells N.
    [[nodiscard]] std::size_t cells() const { return faces.empty() ? 0 : faces.size() - 1; }
    /// Coordinate of the first face, um.
    [[nodiscard]] double lower() const { return faces.front(); }
    /// Coordinate of the last face, um.
    [[nodiscard]] double upper() const { return faces.back(); }
    /// Extent of the axis, um.
    [[nodiscard]] double length() const { return upper() - lower(); }
    /// Widths of the N cells, um.
    [[nodiscard]] std::vector<double> widths() const;
    /// Midpoints of the N cells, um.
    [[nodiscard]] std::vector<double> centres() const;
    /// Whether all widths are equal to 1e-12 relative, or to the rounding of the coordinates where that is
    /// larger.
    [[nodiscard]] bool uniform() const;
    /// Smallest cell width, um.
    [[nodiscard]] double smallest() const;
    /// Largest cell width, um.
    [[nodiscard]] double largest() const;
    /// Greatest ratio of two neighbouring widths, larger over smaller; 1 on a uniform axis.
    [[nodiscard]] double growth() const;
};

/// N equal cells between lower and upper (um). InputError unless cells >= 1 and lower < upper.
Axis uniform_axis(double lower, double upper, int cells);

/// Cells that are small and nearly equal in the middle and grow towards both ends, (5.31): the plateau
/// reaches about a cells to each side, b >= 0 is the steepness of its edge per cell (0: uniform). InputError
/// on bad parameters, and when the widths differ by more than floating point holds.
Axis plateau_axis(double lower, double upper, int cells, double a, double b);

/// N cells between Chebyshev points, clustered at both ends, (3.28). InputError as uniform_axis.
Axis chebyshev_axis(double lower, double upper, int cells);

/// The given face coordinates (um). InputError unless there are two or more, finite and strictly ascending.
Axis explicit_axis(std::vector<double> faces);

/// A box of cells, the product of three axes x, y, z.
struct RectilinearGrid {
    std::array<Axis, 3> axes;

    /// Number of cells.
    [[nodiscard]] std::size_t cells() const;
    /// Smallest width over all axes, um.
    [[nodiscard]] double smallest() const;
    /// Volume of the box, um^3.
    [[nodiscard]] double volume() const;
};

/// What the accuracy of a rectilinear grid hangs on; growth and aspect are 1 on a grid of equal cubes.
struct GridQuality {
    /// Smallest and largest width over all axes, um.
    double smallest = 0, largest = 0;
    /// Greatest ratio of the widths of two neighbouring cells.
    double growth = 1;
    /// Greatest ratio of the longest to the shortest edge of one cell.
    double aspect = 1;
};

/// The quality numbers of a grid.
GridQuality quality(const RectilinearGrid& grid);

}  // namespace hemoflux::meshing

/// A plane through a flow: fields on a uniform lattice of points, their contour lines, and streamlines.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace hemoflux::output {

/// Line through points of a plane.
using Polyline = std::vector<std::array<double, 2>>;

/// Points x[i], y[j], equally spaced each way (two or more).
struct Lattice {
    std::vector<double> x, y;

    /// Place of point (i, j) in a field; number of points.
    [[nodiscard]] std::size_t at(std::size_t i, std::size_t j) const { return j * x.size() + i; }
    [[nodiscard]] std::size_t size() const { return x.size() * y.size(); }
};

/// Equally spaced points over a rectangle, `across` of them along its longer side.
Lattice make_lattice(double x0, double x1, double y0, double y1, std::size_t across);

/// Pieces of the line on which a field of the lattice has the value `level`, linear within each triangle of a lattice
/// cell; cells with a NaN have none.
std::vector<Polyline> contour(const Lattice& lattice, const std::vector<double>& field, double level);

/// Streamlines of (u, v), about `spacing` apart (in units of the lattice's coordinates) everywhere in the plane,
/// however slow the flow there. A line ends at the border, at a NaN, beside another line, or where it closes.
std::vector<Polyline> streamlines(const Lattice& lattice, const std::vector<double>& u,
                                  const std::vector<double>& v, double spacing);

}  // namespace hemoflux::output

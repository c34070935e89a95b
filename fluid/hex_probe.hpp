/// Interpolation of cell fields of an unstructured grid to any point by moving least squares: the quadratic that fits
/// best around the point, weighted by 1 / (d^2 + eps), d the distance in the lengths of the nearest cell. Exact for
/// quadratics, third order. The cells are the nearest one with two rings of face neighbours, so that the stencil follows
/// flat cells; with them the faces on which a field is given.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "fluid/nearest.hpp"
#include "meshing/hex_grid.hpp"

namespace hemoflux::fluid {

/// Values of one or more fields at points of a grid's border.
struct BorderValues {
    std::vector<std::uint32_t> face;  ///< border faces of the grid
    std::vector<double> value;        ///< fields side by side: value[face number here * fields + field]
};

/// Fields between the cell centres of an unstructured grid.
class HexInterpolant {
  public:
    /// cell: values of `fields` fields, cell[c * fields + f]. The grid must outlive the interpolant.
    HexInterpolant(const meshing::HexGrid& grid, std::size_t fields, std::vector<double> cell,
                   BorderValues border);

    /// Writes the values of all fields at a point; outside the grid those of the nearest cell's quadratic.
    void operator()(const Vec3d& at, double* values) const;

  private:
    /// Cells within two rings of a cell, itself first.
    [[nodiscard]] std::vector<std::uint32_t> stencil(std::uint32_t cell) const;

    const meshing::HexGrid& grid_;
    std::size_t fields_;
    std::vector<double> cell_;
    BorderValues border_;
    std::vector<std::uint32_t> known_;  // of every border face its number in border_, or none
    NearestPoint nearest_;
};

}  // namespace hemoflux::fluid

/// Signed distance of the fluid cells to the membranes, in a band around them, in units of the local cell:
///
///   d/h = +- min_t d_t / h_t,  positive inside,  limited to [-1, 1]
///
/// d_t is the true distance of the cell's centre to triangle t and h_t its half-width: a multiple of the
/// largest width of the fluid cells at the membrane ("the edge length of the cells at the membrane
/// interface", section 6.6), linear between cell centres, the largest of the three corners; or a fixed
/// length. The sign is the winding number of the surface along the row of the cell, so it needs no normals
/// and no flood fill.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "coupling/band_triangle.hpp"
#include "coupling/cell_grid.hpp"
#include "coupling/tiles.hpp"
#include "exchange/buffer.hpp"

namespace hemoflux::coupling {

/// Triangles that are consecutive in the mesh are refused together by tiles that are far from all of them.
inline constexpr std::size_t triangle_group = 16;

/// The prepared surfaces as the tiles of the grid see them; trivially copyable.
struct SurfacesView {
    CellGridView grid;
    Tiles tiles;
    /// Membrane cells, triangles and groups of each.
    std::size_t cells, triangles, groups;
    /// cells * triangles and cells * groups entries.
    const BandTriangle* triangle;
    const CellBox *box, *group_box;
    /// Lattice units per um of the inside test.
    double lattice;
    /// Padded work fields on the grid: (d/h)^2 and changes of the winding number.
    double* ratio2;
    int* winding;
};

/// Prepares closed surfaces that share one connectivity, and measures cells against them.
class SignedDistance {
  public:
    /// `cells` surfaces of `vertices` vertices each, joined by `triangles` (counter-clockwise seen from
    /// outside). `grid` must outlive this object.
    SignedDistance(const CellGrid& grid, const std::vector<std::array<int, 3>>& triangles,
                   std::size_t vertices, std::size_t cells, HalfWidth half_width);

    /// Takes the surfaces as they are now: x, y, z of cells * vertices values each (device, um, cell-major).
    /// On periodic axes a surface may lie anywhere, but its vertices must be neighbours in space (not wrapped
    /// one by one).
    void prepare(const double* x, const double* y, const double* z);
    /// Writes d/h of surface `cell` to the interior cells of a padded scalar field (device); +-1 outside the
    /// band.
    void evaluate(std::size_t cell, double* field);

    /// The prepared surfaces, for kernels.
    [[nodiscard]] SurfacesView view();
    /// Half-width at every vertex at the last prepare(), um; device, cells * vertices.
    [[nodiscard]] const double* half_widths() const { return vertex_half_width_.data(); }
    /// The prepared triangles of all surfaces; device.
    [[nodiscard]] const BandTriangle* triangles() const { return triangle_.data(); }
    /// Vertices of one surface, and number of surfaces.
    [[nodiscard]] std::size_t vertices() const { return vertices_; }
    [[nodiscard]] std::size_t cells() const { return cells_; }

  private:
    const CellGrid& grid_;
    std::size_t vertices_, cells_, triangles_;
    HalfWidth half_width_;
    double lattice_;
    exchange::Buffer<int> corners_;
    exchange::Buffer<double> vertex_half_width_;
    exchange::Buffer<BandTriangle> triangle_;
    exchange::Buffer<CellBox> box_, group_box_;
    exchange::Buffer<double> ratio2_;
    exchange::Buffer<int> winding_;
};

}  // namespace hemoflux::coupling

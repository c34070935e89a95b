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
#include "exchange/buffer.hpp"
#include "exchange/pack.hpp"

namespace hemoflux::coupling {

/// Triangles that are consecutive in the mesh are refused together by tiles that are far from all of them.
inline constexpr std::size_t triangle_group = 16;

/// The prepared surfaces as kernels see them; trivially copyable. Each has a box of unwrapped cells around it and its
/// band, and values for what is measured there, in rows along x.
struct SurfacesView {
    CellGridView grid;
    /// Membrane cells, triangles and groups of each.
    std::size_t cells, triangles, groups;
    /// cells * triangles and cells * groups entries.
    const BandTriangle* triangle;
    const CellBox *box, *group_box;
    /// Lattice units per um of the inside test.
    double lattice;
    /// Box around each surface, and the centres of its cells along x, um: surface c has them from c * row_capacity on.
    const CellBox* surface_box;
    const double* centre_x;
    std::size_t row_capacity;
    /// Where the values of each surface begin.
    const std::size_t* begin;
    /// Work, (d/h)^2 and changes of the winding number; `ratio` becomes d/h.
    double* ratio;
    int* winding;

    /// Where the values of row (j, k), unwrapped, of the box around surface c begin.
    HEMOFLUX_INLINE std::size_t row(std::size_t c, int j, int k) const {
        const CellBox& b = surface_box[c];
        const auto number =
            static_cast<std::size_t>((k - b.first[2]) * (b.last[1] - b.first[1]) + (j - b.first[1]));
        return begin[c] + number * row_length(b);
    }
    /// Values that a row of box b takes: a pack may start at its last cell.
    HEMOFLUX_INLINE static std::size_t row_length(const CellBox& b) {
        return static_cast<std::size_t>(b.last[0] - b.first[0]) + exchange::pack_lanes;
    }
};

/// Prepares closed surfaces that share one connectivity, and measures the cells around them.
class SignedDistance {
  public:
    /// `cells` surfaces of `vertices` vertices each, joined by `triangles` (counter-clockwise seen from
    /// outside). `grid` must outlive this object.
    SignedDistance(const CellGrid& grid, const std::vector<std::array<int, 3>>& triangles,
                   std::size_t vertices, std::size_t cells, HalfWidth half_width);

    /// Takes the surfaces as they are now and measures the cells around them: x, y, z of cells * vertices values each
    /// (device, um, cell-major). On periodic axes a surface may lie anywhere, but its vertices must be neighbours in
    /// space (not wrapped one by one). `moved` (one value a surface; empty: all): surfaces of zero are as before and
    /// are left alone.
    void prepare(const double* x, const double* y, const double* z, const std::vector<int>& moved = {});
    /// Writes d/h of surface `cell` to the interior cells of a padded scalar field (device); +-1 outside the
    /// band.
    void evaluate(std::size_t cell, double* field);

    /// The prepared surfaces, for kernels.
    [[nodiscard]] SurfacesView view();
    /// Half-width at every vertex at the last prepare(), um; device, cells * vertices.
    [[nodiscard]] const double* half_widths() const { return vertex_half_width_.data(); }
    /// The prepared triangles of all surfaces; device.
    [[nodiscard]] const BandTriangle* triangles() const { return triangle_.data(); }

  private:
    /// Makes room for the boxes as they are and says whether the values of surfaces that did not move were kept.
    bool make_room(const std::vector<CellBox>& boxes);
    /// Prepares the triangles of the surfaces marked in moved_ and the boxes around them.
    void prepare_triangles(const double* x, const double* y, const double* z);
    /// Measures the cells around the surfaces marked in moved_.
    void scan(const std::vector<CellBox>& boxes);

    const CellGrid& grid_;
    std::size_t vertices_, cells_, triangles_;
    HalfWidth half_width_;
    double lattice_;
    exchange::Buffer<int> corners_, moved_;
    exchange::Buffer<double> vertex_half_width_;
    exchange::Buffer<BandTriangle> triangle_;
    exchange::Buffer<CellBox> vertex_box_, box_, group_box_, surface_box_;
    std::size_t row_capacity_ = 0;
    /// Values there is room for, surface by surface: one that is torn apart has a box as large as the grid, or larger.
    std::vector<std::size_t> capacity_;
    exchange::Buffer<std::size_t> begin_;
    exchange::Buffer<double> centre_x_, ratio_;
    exchange::Buffer<int> winding_;
};

}  // namespace hemoflux::coupling

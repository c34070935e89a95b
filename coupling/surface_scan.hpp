/// Measures the cells around one surface, and hands what was measured to the rows of the grid: the work behind
/// SignedDistance and InteriorViscosity.
#pragma once

#include <cmath>
#include <cstdint>

#include "coupling/signed_distance.hpp"
#include "coupling/tiles.hpp"
#include "exchange/pack.hpp"

namespace hemoflux::coupling {

/// The larger and the smaller of two; std::max is not for kernels.
HEMOFLUX_INLINE int larger(int a, int b) { return a > b ? a : b; }
HEMOFLUX_INLINE int smaller(int a, int b) { return a < b ? a : b; }

/// Signed distance of the cells of one tile of rows in the box around one surface. Counted in unwrapped cells, so
/// periods do not show.
class SurfaceScan {
  public:
    /// Tile number `tile` of the box around surface c. Smaller boxes than the largest have fewer tiles, and nothing to do
    /// for the numbers beyond theirs.
    HEMOFLUX_INLINE SurfaceScan(const SurfacesView& surfaces, std::size_t c, int tile)
        : s_(surfaces), c_(c), box_(surfaces.surface_box[c]) {
        const int tiles_y = (box_.last[1] - box_.first[1] + tile_rows - 1) / tile_rows;
        if (tiles_y <= 0) return;
        j0_ = box_.first[1] + (tile % tiles_y) * tile_rows;
        k0_ = box_.first[2] + (tile / tiles_y) * tile_rows;
        j1_ = smaller(j0_ + tile_rows, box_.last[1]);
        k1_ = smaller(k0_ + tile_rows, box_.last[2]);
        for (int j = j0_; j < j1_; ++j) y_[j - j0_] = place(s_.grid.axis[1], j);
        for (int k = k0_; k < k1_; ++k) z_[k - k0_] = place(s_.grid.axis[2], k);
    }

    /// Writes d/h of every cell of the tile's rows to the surface's box.
    HEMOFLUX_INLINE void operator()() {
        for (std::size_t g = 0; g < s_.groups; ++g)
            if (overlaps(s_.group_box[c_ * s_.groups + g])) {
                const std::size_t end =
                    (g + 1) * triangle_group < s_.triangles ? (g + 1) * triangle_group : s_.triangles;
                for (std::size_t t = g * triangle_group; t < end; ++t) triangle(c_ * s_.triangles + t);
            }
        for (int k = k0_; k < k1_; ++k)
            for (int j = j0_; j < j1_; ++j) finish_row(j, k);
    }

  private:
    /// Place of a row on one axis: um, and rounded to the lattice of the inside test.
    struct Place {
        double at, lattice;
    };
    HEMOFLUX_INLINE Place place(const AxisView& axis, int cell) const {
        const double at = axis.centre[axis.cell(cell)] + axis.turns(cell) * axis.length;
        return {at, std::floor(at * s_.lattice + 0.5)};
    }

    static_assert(tile_rows * tile_rows <= 64, "one bit per row of a tile");
    HEMOFLUX_INLINE int bit(int j, int k) const { return (k - k0_) * tile_rows + (j - j0_); }
    HEMOFLUX_INLINE bool touched(int j, int k) const { return touched_ >> bit(j, k) & 1; }

    HEMOFLUX_INLINE bool overlaps(const CellBox& b) const {
        return b.first[1] < j1_ && b.last[1] > j0_ && b.first[2] < k1_ && b.last[2] > k0_;
    }

    HEMOFLUX_INLINE void triangle(std::size_t t) {
        const CellBox& b = s_.box[t];
        const int k0 = larger(k0_, b.first[2]), k1 = smaller(k1_, b.last[2]);
        const int j0 = larger(j0_, b.first[1]), j1 = smaller(j1_, b.last[1]);
        for (int k = k0; k < k1; ++k)
            for (int j = j0; j < j1; ++j) row(s_.triangle[t], b, j, k);
    }

    /// One triangle, one row.
    HEMOFLUX_INLINE void row(const BandTriangle& t, const CellBox& b, int j, int k) {
        const Place &y = y_[j - j0_], &z = z_[k - k0_];
        const double off2 = rectangle_distance2(t, y.lattice, z.lattice);
        if (off2 > t.reach * t.reach) return;
        const std::size_t at = s_.row(c_, j, k);
        if (!touched(j, k)) start_row(at, bit(j, k));
        if (off2 == 0) cross(t, at, y.lattice, z.lattice);
        const RowTerms terms(t, y.at, z.at);
        const double* x = s_.centre_x + c_ * s_.row_capacity;
        const int i0 = larger(b.first[0], box_.first[0]) - box_.first[0],
                  i1 = smaller(b.last[0], box_.last[0]) - box_.first[0];
        if (i1 <= i0 || terms.far(t, x[i0], x[i1 - 1])) return;
        // lanes beyond i1 meet cells outside the band, which keep their value, or the padding of the row
        for (int i = i0; i < i1; i += static_cast<int>(exchange::pack_lanes)) {
            double* ratio2 = s_.ratio + at + i;
            const exchange::Pack d2 =
                squared_distance(t, terms, exchange::load<exchange::Pack>(x + i)) * t.inverse_half2;
            exchange::store(ratio2, exchange::minimum(exchange::load<exchange::Pack>(ratio2), d2));
        }
    }

    HEMOFLUX_INLINE void start_row(std::size_t at, int row_bit) {
        touched_ |= std::uint64_t{1} << row_bit;
        for (int i = 0; i < box_.last[0] - box_.first[0]; ++i) {
            s_.ratio[at + static_cast<std::size_t>(i)] = 1;
            s_.winding[at + static_cast<std::size_t>(i)] = 0;
        }
    }

    /// Notes where the row at (y, z), in lattice units, crosses the triangle.
    HEMOFLUX_INLINE void cross(const BandTriangle& t, std::size_t at, double y, double z) const {
        double x;
        const int sign = row_crossing(t, y, z, &x);
        if (sign == 0) return;
        const int first = larger(0, 1 + s_.grid.axis[0].below_unwrapped(x) - box_.first[0]);
        if (first < box_.last[0] - box_.first[0]) s_.winding[at + static_cast<std::size_t>(first)] += sign;
    }

    /// (d/h)^2 and changes of the winding number become d/h; rows that no triangle came near lie outside.
    HEMOFLUX_INLINE void finish_row(int j, int k) const {
        const std::size_t at = s_.row(c_, j, k);
        const bool near = touched(j, k);
        int winding = 0;
        for (int i = 0; i < box_.last[0] - box_.first[0]; ++i) {
            double& ratio = s_.ratio[at + static_cast<std::size_t>(i)];
            if (near) winding += s_.winding[at + static_cast<std::size_t>(i)];
            const double distance = near && ratio < 1 ? std::sqrt(ratio) : 1.0;
            ratio = winding > 0 ? distance : -distance;
        }
    }

    SurfacesView s_;
    std::size_t c_;
    CellBox box_;
    int j0_ = 0, j1_ = 0, k0_ = 0, k1_ = 0;
    Place y_[tile_rows], z_[tile_rows];
    std::uint64_t touched_ = 0;
};

/// Periodic images m of a range of cells [r0, r1) that overlap unwrapped cells [first, last): from <= m < to,
/// image m being [r0 + m n, r1 + m n). Between walls there is image 0 only.
struct Images {
    int from, to;
    /// r0, r1: the range; first, last: the unwrapped cells.
    HEMOFLUX_INLINE Images(const AxisView& axis, int r0, int r1, int first, int last) : from(0), to(0) {
        if (last <= first) return;
        if (!axis.periodic) {
            to = first < r1 && last > r0 ? 1 : 0;
            return;
        }
        from = floor_division(first - r1, axis.n) + 1;
        to = -floor_division(r0 - last, axis.n);
    }

  private:
    HEMOFLUX_INLINE static int floor_division(int a, int n) { return a >= 0 ? a / n : -((n - 1 - a) / n); }
};

/// Calls sink(position in memory, d/h) for every cell of the rows r that lies in surface c or in its band; where the
/// surface comes round through a periodic side to its own band, once for each image.
template <class Sink>
HEMOFLUX_INLINE void band_cells(const SurfacesView& s, const TileRange& r, std::size_t c, const Sink& sink) {
    const CellBox& b = s.surface_box[c];
    const AxisView &ax = s.grid.axis[0], &ay = s.grid.axis[1], &az = s.grid.axis[2];
    const Images xs(ax, 0, ax.n, b.first[0], b.last[0]), ys(ay, r.j0, r.j1, b.first[1], b.last[1]),
        zs(az, r.k0, r.k1, b.first[2], b.last[2]);
    for (int mz = zs.from; mz < zs.to; ++mz)
        for (int my = ys.from; my < ys.to; ++my)
            for (int k = larger(r.k0, b.first[2] - mz * az.n); k < smaller(r.k1, b.last[2] - mz * az.n); ++k)
                for (int j = larger(r.j0, b.first[1] - my * ay.n); j < smaller(r.j1, b.last[1] - my * ay.n);
                     ++j) {
                    const double* row = s.ratio + s.row(c, j + my * ay.n, k + mz * az.n);
                    const std::size_t at = s.grid.layout.at(0, j, k);
                    for (int mx = xs.from; mx < xs.to; ++mx) {
                        const int offset = mx * ax.n - b.first[0], end = smaller(ax.n, b.last[0] - mx * ax.n);
                        for (int i = larger(0, -offset); i < end; ++i)
                            if (row[i + offset] > -1) sink(at + static_cast<std::size_t>(i), row[i + offset]);
                    }
                }
}

}  // namespace hemoflux::coupling

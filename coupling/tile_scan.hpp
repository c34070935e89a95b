/// One tile of rows measured against one surface: the work behind SignedDistance and InteriorViscosity.
#pragma once

#include <cmath>
#include <cstdint>

#include "coupling/signed_distance.hpp"
#include "exchange/pack.hpp"

namespace hemoflux::coupling {

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

/// Scans the rows of one tile for one surface, then hands d/h of all cells of the rows that were touched to a
/// sink.
class TileScan {
  public:
    /// Tile number `tile` against the surfaces, which must outlive it.
    HEMOFLUX_INLINE TileScan(const SurfacesView& surfaces, std::size_t tile)
        : s_(surfaces), r_(surfaces.tiles.range(tile)) {}

    /// Calls sink(position in memory, d/h) for every cell of every row of the tile that surface c comes near.
    /// Rows it does not come near lie wholly outside it.
    template <class Sink>
    HEMOFLUX_INLINE void operator()(std::size_t c, const Sink& sink) {
        touched_ = 0;
        for (std::size_t g = 0; g < s_.groups; ++g)
            if (overlaps(s_.group_box[c * s_.groups + g])) {
                const std::size_t end =
                    (g + 1) * triangle_group < s_.triangles ? (g + 1) * triangle_group : s_.triangles;
                for (std::size_t t = g * triangle_group; t < end; ++t) triangle(c * s_.triangles + t);
            }
        if (touched_ == 0) return;
        for (int k = r_.k0; k < r_.k1; ++k)
            for (int j = r_.j0; j < r_.j1; ++j)
                if (touched_ >> bit(j, k) & 1) finish_row(s_.grid.layout.at(0, j, k), sink);
    }

  private:
    static_assert(tile_rows * tile_rows <= 64, "one bit per row of a tile");
    HEMOFLUX_INLINE int bit(int j, int k) const { return (k - r_.k0) * tile_rows + (j - r_.j0); }

    HEMOFLUX_INLINE bool overlaps(const CellBox& b) const {
        const Images ys(s_.grid.axis[1], r_.j0, r_.j1, b.first[1], b.last[1]);
        const Images zs(s_.grid.axis[2], r_.k0, r_.k1, b.first[2], b.last[2]);
        return ys.from < ys.to && zs.from < zs.to;
    }

    HEMOFLUX_INLINE void triangle(std::size_t t) {
        const CellBox& b = s_.box[t];
        const AxisView &ay = s_.grid.axis[1], &az = s_.grid.axis[2];
        const Images ys(ay, r_.j0, r_.j1, b.first[1], b.last[1]), zs(az, r_.k0, r_.k1, b.first[2], b.last[2]);
        for (int mz = zs.from; mz < zs.to; ++mz) {
            const int k0 = larger(r_.k0, b.first[2] - mz * az.n), k1 = smaller(r_.k1, b.last[2] - mz * az.n);
            for (int my = ys.from; my < ys.to; ++my) {
                const int j0 = larger(r_.j0, b.first[1] - my * ay.n),
                          j1 = smaller(r_.j1, b.last[1] - my * ay.n);
                for (int k = k0; k < k1; ++k)
                    for (int j = j0; j < j1; ++j)
                        row(s_.triangle[t], b, j, k, ay.centre[j] + my * ay.length,
                            az.centre[k] + mz * az.length);
            }
        }
    }

    /// One triangle, one row.
    HEMOFLUX_INLINE void row(const BandTriangle& t, const CellBox& b, int j, int k, double y, double z) {
        const double lattice_y = std::floor(y * s_.lattice + 0.5),
                     lattice_z = std::floor(z * s_.lattice + 0.5);
        const double off2 = rectangle_distance2(t, lattice_y, lattice_z);
        if (off2 > t.reach * t.reach) return;
        const std::size_t at = s_.grid.layout.at(0, j, k);
        if (!(touched_ >> bit(j, k) & 1)) start_row(at, bit(j, k));
        if (off2 == 0) cross(t, at, lattice_y, lattice_z);
        const RowTerms terms(t, y, z);
        const AxisView& ax = s_.grid.axis[0];
        const Images xs(ax, 0, ax.n, b.first[0], b.last[0]);
        for (int m = xs.from; m < xs.to; ++m) {
            const int i0 = larger(0, b.first[0] - m * ax.n), i1 = smaller(ax.n, b.last[0] - m * ax.n);
            const double shift = m * ax.length;
            if (terms.far(t, ax.centre[i0] + shift, ax.centre[i1 - 1] + shift)) continue;
            // lanes beyond i1 meet cells outside the band, which keep their value, or the padding of the row
            for (int i = i0; i < i1; i += static_cast<int>(exchange::pack_lanes)) {
                double* ratio2 = s_.ratio2 + at + i;
                const auto x = exchange::load<exchange::Pack>(ax.centre + i) + shift;
                const exchange::Pack d2 = squared_distance(t, terms, x) * t.inverse_half2;
                exchange::store(ratio2, exchange::minimum(exchange::load<exchange::Pack>(ratio2), d2));
            }
        }
    }

    HEMOFLUX_INLINE void start_row(std::size_t at, int row_bit) {
        touched_ |= std::uint64_t{1} << row_bit;
        for (int i = 0; i < s_.grid.axis[0].n; ++i) {
            s_.ratio2[at + static_cast<std::size_t>(i)] = 1;
            s_.winding[at + static_cast<std::size_t>(i)] = 0;
        }
    }

    /// Notes where the row at (y, z), in lattice units, crosses the triangle. A crossing q lengths beyond
    /// cell r counts for the cells from r on and, the total over a row being zero, -(q + 1) times for all.
    HEMOFLUX_INLINE void cross(const BandTriangle& t, std::size_t at, double y, double z) const {
        double x;
        const int sign = row_crossing(t, y, z, &x);
        if (sign == 0) return;
        const AxisView& ax = s_.grid.axis[0];
        const int first = 1 + ax.below_unwrapped(x);
        if (ax.periodic) {
            s_.winding[at + static_cast<std::size_t>(ax.cell(first))] += sign;
            s_.winding[at] -= sign * (ax.turns(first) + 1);
        } else if (first < ax.n) {
            s_.winding[at + static_cast<std::size_t>(first)] += sign;
        }
    }

    template <class Sink>
    HEMOFLUX_INLINE void finish_row(std::size_t at, const Sink& sink) const {
        int winding = 0;
        for (int i = 0; i < s_.grid.axis[0].n; ++i) {
            const std::size_t cell = at + static_cast<std::size_t>(i);
            winding += s_.winding[cell];
            const double distance = s_.ratio2[cell] < 1 ? std::sqrt(s_.ratio2[cell]) : 1.0;
            sink(cell, winding > 0 ? distance : -distance);
        }
    }

    HEMOFLUX_INLINE static int larger(int a, int b) { return a > b ? a : b; }
    HEMOFLUX_INLINE static int smaller(int a, int b) { return a < b ? a : b; }

    SurfacesView s_;
    TileRange r_;
    std::uint64_t touched_ = 0;
};

}  // namespace hemoflux::coupling

#include "coupling/spread.hpp"

#include <algorithm>

#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

/// Tile that holds the lowest row of a stencil.
HEMOFLUX_INLINE std::size_t home_tile(const Tiles& tiles, const Stencil& s) {
    return tiles.number(s.first[1] / tile_rows, s.first[2] / tile_rows);
}

/// Markers first .. last - 1 of one chunk of the counting sort; entry (tile, chunk) lies at tile * chunks +
/// chunk.
struct SortView {
    Tiles tiles;
    const Stencil* stencils;
    std::size_t markers, chunk, chunks;
    int *order, *start, *cursor;

    HEMOFLUX_INLINE std::size_t first(std::size_t c) const { return c * chunk; }
    HEMOFLUX_INLINE std::size_t last(std::size_t c) const {
        return (c + 1) * chunk < markers ? (c + 1) * chunk : markers;
    }
};

/// Counts the markers of one chunk by tile.
struct CountMarkers {
    SortView v;
    HEMOFLUX_FN void operator()(std::size_t c) const {
        for (std::size_t t = 0; t < v.tiles.count(); ++t) v.cursor[t * v.chunks + c] = 0;
        for (std::size_t m = v.first(c); m < v.last(c); ++m)
            ++v.cursor[home_tile(v.tiles, v.stencils[m]) * v.chunks + c];
    }
};

/// Puts the markers of one chunk behind those of the chunks before it.
struct PlaceMarkers {
    SortView v;
    HEMOFLUX_FN void operator()(std::size_t c) const {
        for (std::size_t t = 0; t < v.tiles.count(); ++t)
            v.cursor[t * v.chunks + c] = v.start[t * v.chunks + c];
        for (std::size_t m = v.first(c); m < v.last(c); ++m)
            v.order[v.cursor[home_tile(v.tiles, v.stencils[m]) * v.chunks + c]++] = static_cast<int>(m);
    }
};

/// Tiles along one axis, from `first` on cyclically, whose markers may reach rows r0 .. r1-1.
struct Sources {
    int first, count;
    HEMOFLUX_INLINE Sources(const AxisView& axis, int tiles, int r0, int r1) {
        const int own = r0 / tile_rows, lowest = r0 - (stencil_width - 1);
        if (!axis.periodic) {
            first = (lowest > 0 ? lowest : 0) / tile_rows;
            count = own - first + 1;
        } else if (r1 - lowest >= axis.n) {
            first = (own + 1) % tiles;
            count = tiles;
        } else {
            first = axis.cell(lowest) / tile_rows;
            count = (own - first + tiles) % tiles + 1;
        }
    }
};

/// Gathers the force density of one tile.
struct GatherForces {
    CellGridView grid;
    SortView sorted;
    const double* force[3];
    double factor;
    double* HEMOFLUX_RESTRICT density[3];
    int* touched;
    bool add_only;

    HEMOFLUX_FN void operator()(std::size_t t) const {
        const TileRange r = sorted.tiles.range(t);
        const Sources ys(grid.axis[1], sorted.tiles.count_y, r.j0, r.j1);
        const Sources zs(grid.axis[2], sorted.tiles.count_z, r.k0, r.k1);
        if (!add_only) {
            if (touched[t]) clear(r);
            touched[t] = 0;
        }
        for (int c = 0; c < zs.count; ++c)
            for (int b = 0; b < ys.count; ++b) {
                const std::size_t source = sorted.tiles.number((ys.first + b) % sorted.tiles.count_y,
                                                               (zs.first + c) % sorted.tiles.count_z);
                const int end = sorted.start[(source + 1) * sorted.chunks];
                for (int i = sorted.start[source * sorted.chunks]; i < end; ++i) {
                    touched[t] = 1;
                    add(static_cast<std::size_t>(sorted.order[i]), r);
                }
            }
    }

  private:
    HEMOFLUX_INLINE void clear(const TileRange& r) const {
        for (int q = 0; q < 3; ++q)
            for (int k = r.k0; k < r.k1; ++k)
                for (int j = r.j0; j < r.j1; ++j) {
                    double* row = density[q] + grid.layout.at(0, j, k);
                    for (int i = 0; i < grid.axis[0].n; ++i) row[i] = 0;
                }
    }

    /// Adds weight * f to four neighbouring cells: one register, so all are read before any is written.
    HEMOFLUX_INLINE static void add_row(double* cells, double weight, const double* f) {
        double sum[stencil_width];
        for (int a = 0; a < stencil_width; ++a) sum[a] = cells[a] + weight * f[a];
        for (int a = 0; a < stencil_width; ++a) cells[a] = sum[a];
    }

    /// Adds those rows of marker m that lie in the tile.
    HEMOFLUX_INLINE void add(std::size_t m, const TileRange& r) const {
        const Stencil& s = sorted.stencils[m];
        double wy[stencil_width];
        std::size_t row[stencil_width];
        int rows = 0;
        for (int b = 0; b < stencil_width; ++b) {
            const int j = grid.axis[1].cell(s.first[1] + b);
            if (j < r.j0 || j >= r.j1) continue;
            wy[rows] = s.weight[1][b] * grid.axis[1].inverse_width[j];
            row[rows++] = static_cast<std::size_t>(j) * grid.layout.row;
        }
        if (rows == 0) return;
        double fx[stencil_width], fy[stencil_width], fz[stencil_width];
        int x[stencil_width];
        for (int a = 0; a < stencil_width; ++a) {
            x[a] = grid.axis[0].cell(s.first[0] + a);
            const double wx = factor * s.weight[0][a] * grid.axis[0].inverse_width[x[a]];
            fx[a] = force[0][m] * wx;
            fy[a] = force[1][m] * wx;
            fz[a] = force[2][m] * wx;
        }
        for (int c = 0; c < stencil_width; ++c) {
            const int k = grid.axis[2].cell(s.first[2] + c);
            if (k < r.k0 || k >= r.k1) continue;
            const double wz = s.weight[2][c] * grid.axis[2].inverse_width[k];
            const std::size_t plane = grid.layout.origin + static_cast<std::size_t>(k) * grid.layout.plane;
            for (int b = 0; b < rows; ++b) {
                const double weight = wz * wy[b];
                const std::size_t at = plane + row[b];
                if (s.wraps_x) {
                    for (int a = 0; a < stencil_width; ++a) {
                        const std::size_t cell = at + static_cast<std::size_t>(x[a]);
                        density[0][cell] += weight * fx[a];
                        density[1][cell] += weight * fy[a];
                        density[2][cell] += weight * fz[a];
                    }
                } else {
                    add_row(density[0] + at + x[0], weight, fx);
                    add_row(density[1] + at + x[0], weight, fy);
                    add_row(density[2] + at + x[0], weight, fz);
                }
            }
        }
    }
};

/// Adds dt f / rho to the velocity in the rows of one tile.
struct AccelerateTile {
    CellGridView grid;
    Tiles tiles;
    const int* touched;
    double dt;
    const double* force[3];
    const double* rho;
    double* velocity[3];
    HEMOFLUX_FN void operator()(std::size_t t) const {
        if (!touched[t]) return;
        const TileRange r = tiles.range(t);
        for (int k = r.k0; k < r.k1; ++k)
            for (int j = r.j0; j < r.j1; ++j) {
                const std::size_t row = grid.layout.at(0, j, k), n = grid.layout.n[0];
                for (int q = 0; q < 3; ++q)
                    for (std::size_t i = row; i < row + n; ++i) velocity[q][i] += dt * force[q][i] / rho[i];
            }
    }
};

/// Markers of one chunk of the sort, a function of their number alone.
std::size_t chunk_size(std::size_t markers) {
    return exchange::on_gpu ? std::max<std::size_t>(64, markers / 256) : 4096;
}

}  // namespace

Spreader::Spreader(const StencilSet& stencils, Spreader* first)
    : stencils_(stencils),
      first_(first),
      tiles_(stencils.grid().layout),
      chunk_(chunk_size(stencils.size())),
      chunks_(std::max<std::size_t>(1, (stencils.size() + chunk_ - 1) / chunk_)),
      order_(stencils.size()),
      start_(tiles_.count() * chunks_ + 1),
      cursor_(tiles_.count() * chunks_ + 1),
      touched_(first ? 0 : tiles_.count()) {
    forget();
}

void Spreader::forget() { touched_.fill(1); }

void Spreader::accelerate(double dt, const exchange::FieldView& density, const FluidFields& fluid) const {
    const auto& u = fluid.velocity.component;
    exchange::for_each_index(
        tiles_.count(), AccelerateTile{stencils_.grid(),
                                       tiles_,
                                       first_ ? first_->touched_.data() : touched_.data(),
                                       dt,
                                       {density.component[0], density.component[1], density.component[2]},
                                       fluid.density.component[0],
                                       {u[0], u[1], u[2]}});
}

void Spreader::spread(const double* fx, const double* fy, const double* fz, double factor,
                      const exchange::FieldView& density) {
    const SortView sorted{tiles_,  stencils_.data(), stencils_.size(), chunk_,
                          chunks_, order_.data(),    start_.data(),    cursor_.data()};
    exchange::for_each_index(chunks_, CountMarkers{sorted});
    exchange::exclusive_scan(cursor_.size(), cursor_.data(), start_.data());
    exchange::for_each_index(chunks_, PlaceMarkers{sorted});
    exchange::for_each_index(tiles_.count(),
                             GatherForces{stencils_.grid(),
                                          sorted,
                                          {fx, fy, fz},
                                          factor,
                                          {density.component[0], density.component[1], density.component[2]},
                                          first_ ? first_->touched_.data() : touched_.data(),
                                          first_ != nullptr});
}

}  // namespace hemoflux::coupling

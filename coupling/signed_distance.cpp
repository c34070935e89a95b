#include "coupling/signed_distance.hpp"

#include <algorithm>

#include "coupling/tile_scan.hpp"
#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

/// Half-width of the band at vertex v.
struct VertexHalfWidth {
    CellGridView grid;
    HalfWidth half_width;
    const double* position[3];
    double* out;
    HEMOFLUX_FN void operator()(std::size_t v) const {
        double width = 0;
        for (int q = 0; q < 3; ++q) {
            const double w = grid.axis[q].width_at(position[q][v]);
            width = w > width ? w : width;
        }
        out[v] = half_width.fixed > 0 ? half_width.fixed : half_width.local_cells * width;
    }
};

/// Prepares the triangles of one group of one cell.
struct PrepareGroup {
    CellGridView grid;
    std::size_t triangles, vertices, groups;
    double lattice;
    const int* corners;
    const double* position[3];
    const double* half_width;
    BandTriangle* triangle;
    CellBox *box, *group_box;

    HEMOFLUX_INLINE Vec3d vertex(std::size_t v) const {
        return {position[0][v], position[1][v], position[2][v]};
    }

    HEMOFLUX_FN void operator()(std::size_t i) const {
        const std::size_t c = i / groups, first = (i % groups) * triangle_group;
        const std::size_t last = first + triangle_group < triangles ? first + triangle_group : triangles;
        CellBox all;
        for (std::size_t t = first; t < last; ++t) {
            std::size_t v[3];
            for (std::size_t p = 0; p < 3; ++p)
                v[p] = c * vertices + static_cast<std::size_t>(corners[3 * t + p]);
            using exchange::maximum;
            const double h = maximum(half_width[v[0]], maximum(half_width[v[1]], half_width[v[2]]));
            const std::size_t to = c * triangles + t;
            triangle[to] = band_triangle(vertex(v[0]), vertex(v[1]), vertex(v[2]), h, lattice);
            const CellBox b = band_box(grid, vertex(v[0]), vertex(v[1]), vertex(v[2]), h);
            box[to] = b;
            for (int q = 0; q < 3; ++q) {
                all.first[q] = t == first || b.first[q] < all.first[q] ? b.first[q] : all.first[q];
                all.last[q] = t == first || b.last[q] > all.last[q] ? b.last[q] : all.last[q];
            }
        }
        group_box[i] = all;
    }
};

/// Writes d/h to a field.
struct WriteDistance {
    double* field;
    HEMOFLUX_INLINE void operator()(std::size_t at, double distance) const { field[at] = distance; }
};

/// d/h of one surface in one tile.
struct DistanceTile {
    SurfacesView surfaces;
    std::size_t cell;
    double* field;
    HEMOFLUX_FN void operator()(std::size_t tile) const {
        const TileRange r = surfaces.tiles.range(tile);
        for (int k = r.k0; k < r.k1; ++k)
            for (int j = r.j0; j < r.j1; ++j)
                for (int i = 0; i < surfaces.grid.axis[0].n; ++i)
                    field[surfaces.grid.layout.at(i, j, k)] = -1;
        TileScan scan(surfaces, tile);
        scan(cell, WriteDistance{field});
    }
};

std::vector<int> flat(const std::vector<std::array<int, 3>>& triangles) {
    std::vector<int> corners;
    for (const auto& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
    return corners;
}

std::size_t groups_of(std::size_t triangles) { return (triangles + triangle_group - 1) / triangle_group; }

}  // namespace

SignedDistance::SignedDistance(const CellGrid& grid, const std::vector<std::array<int, 3>>& triangles,
                               std::size_t vertices, std::size_t cells, HalfWidth half_width)
    : grid_(grid),
      vertices_(vertices),
      cells_(cells),
      triangles_(triangles.size()),
      half_width_(half_width),
      lattice_(inside_test_lattice(grid.smallest())),
      corners_(flat(triangles)),
      vertex_half_width_(cells * vertices),
      triangle_(cells * triangles.size()),
      box_(cells * triangles.size()),
      group_box_(cells * groups_of(triangles.size())),
      ratio2_(grid.view().layout.size),
      winding_(grid.view().layout.size) {}

SurfacesView SignedDistance::view() {
    const CellGridView grid = grid_.view();
    return {
        grid,        Tiles(grid.layout), cells_,   triangles_,     groups_of(triangles_), triangle_.data(),
        box_.data(), group_box_.data(),  lattice_, ratio2_.data(), winding_.data()};
}

void SignedDistance::prepare(const double* x, const double* y, const double* z) {
    const CellGridView grid = grid_.view();
    exchange::for_each_index(cells_ * vertices_,
                             VertexHalfWidth{grid, half_width_, {x, y, z}, vertex_half_width_.data()});
    const std::size_t groups = groups_of(triangles_);
    exchange::for_each_index(cells_ * groups, PrepareGroup{grid,
                                                           triangles_,
                                                           vertices_,
                                                           groups,
                                                           lattice_,
                                                           corners_.data(),
                                                           {x, y, z},
                                                           vertex_half_width_.data(),
                                                           triangle_.data(),
                                                           box_.data(),
                                                           group_box_.data()});
}

void SignedDistance::evaluate(std::size_t cell, double* field) {
    const SurfacesView surfaces = view();
    exchange::for_each_index(surfaces.tiles.count(), DistanceTile{surfaces, cell, field});
}

}  // namespace hemoflux::coupling

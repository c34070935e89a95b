#include "coupling/signed_distance.hpp"

#include <algorithm>
#include <numeric>

#include "coupling/surface_scan.hpp"
#include "exchange/parallel.hpp"

namespace hemoflux::coupling {
namespace {

/// A triangle whose half-width is the largest of its corners takes the boxes of corners that have it but for rounding.
constexpr double rounding_of_widths = 1e-9;

/// Half-width of the band at vertex v, and the box around a sphere of that radius.
struct VertexBand {
    CellGridView grid;
    HalfWidth half_width;
    std::size_t vertices;
    const int* moved;
    const double* position[3];
    double* out;
    CellBox* box;
    HEMOFLUX_FN void operator()(std::size_t v) const {
        if (!moved[v / vertices]) return;
        double width = 0;
        for (int q = 0; q < 3; ++q) {
            const double w = grid.axis[q].width_at(position[q][v]);
            width = w > width ? w : width;
        }
        out[v] = half_width.fixed > 0 ? half_width.fixed : half_width.local_cells * width;
        const Vec3d at{position[0][v], position[1][v], position[2][v]};
        box[v] = band_box(grid, at, at, at, out[v] * (1 + rounding_of_widths));
    }
};

/// The least box that holds both.
HEMOFLUX_INLINE CellBox joined(CellBox a, const CellBox& b) {
    for (int q = 0; q < 3; ++q) {
        a.first[q] = smaller(a.first[q], b.first[q]);
        a.last[q] = larger(a.last[q], b.last[q]);
    }
    return a;
}

/// Prepares the triangles of one group of one cell.
struct PrepareGroup {
    CellGridView grid;
    std::size_t triangles, vertices, groups;
    double lattice;
    const int *corners, *moved;
    const double* position[3];
    const double* half_width;
    const CellBox* vertex_box;
    BandTriangle* triangle;
    CellBox *box, *group_box;

    HEMOFLUX_INLINE Vec3d vertex(std::size_t v) const {
        return {position[0][v], position[1][v], position[2][v]};
    }

    /// Box around the band, of half-width h, of the triangle with corners v; a look-up a vertex is cheaper than one a
    /// triangle where the grid is uniform.
    HEMOFLUX_INLINE CellBox band(const std::size_t* v, double h) const {
        for (int p = 0; p < 3; ++p)
            if (!(h <= half_width[v[p]] * (1 + rounding_of_widths)))
                return band_box(grid, vertex(v[0]), vertex(v[1]), vertex(v[2]), h);
        return joined(vertex_box[v[0]], joined(vertex_box[v[1]], vertex_box[v[2]]));
    }

    HEMOFLUX_FN void operator()(std::size_t i) const {
        const std::size_t c = i / groups, first = (i % groups) * triangle_group;
        if (!moved[c]) return;
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
            box[to] = band(v, h);
            all = t == first ? box[to] : joined(all, box[to]);
        }
        group_box[i] = all;
    }
};

/// The box around surface c, cut off at walls. A surface that reaches over more than two periods has come apart, and
/// shall not ask for the memory.
struct SurfaceBox {
    CellGridView grid;
    std::size_t groups;
    const int* moved;
    const CellBox* group_box;
    CellBox* surface_box;
    HEMOFLUX_FN void operator()(std::size_t c) const {
        if (!moved[c]) return;
        CellBox all = group_box[c * groups];
        for (std::size_t g = 1; g < groups; ++g) all = joined(all, group_box[c * groups + g]);
        for (int q = 0; q < 3; ++q) {
            const AxisView& axis = grid.axis[q];
            if (!axis.periodic) all.first[q] = larger(all.first[q], 0);
            const int end = axis.periodic ? all.first[q] + 2 * axis.n : axis.n;
            all.last[q] = larger(all.first[q], smaller(all.last[q], end));
        }
        surface_box[c] = all;
    }
};

/// Centres of the cells of a row of the box around surface c; the padding repeats the last.
struct RowCentres {
    CellGridView grid;
    const int* moved;
    const CellBox* surface_box;
    std::size_t row_capacity;
    double* centre_x;
    HEMOFLUX_FN void operator()(std::size_t c) const {
        if (!moved[c]) return;
        const CellBox& b = surface_box[c];
        const AxisView& axis = grid.axis[0];
        for (std::size_t i = 0; i < row_capacity; ++i) {
            const int k = larger(smaller(b.first[0] + static_cast<int>(i), b.last[0] - 1), b.first[0]);
            centre_x[c * row_capacity + i] = axis.centre[axis.cell(k)] + axis.turns(k) * axis.length;
        }
    }
};

/// Tile number i % tiles of the box around surface i / tiles.
struct ScanTile {
    SurfacesView surfaces;
    const int* moved;
    std::size_t tiles;
    HEMOFLUX_FN void operator()(std::size_t i) const {
        if (!moved[i / tiles]) return;
        SurfaceScan scan(surfaces, i / tiles, static_cast<int>(i % tiles));
        scan();
    }
};

/// Writes d/h to a field.
struct WriteDistance {
    double* field;
    HEMOFLUX_INLINE void operator()(std::size_t at, double distance) const {
        if (distance > field[at]) field[at] = distance;
    }
};

/// d/h of one surface in one tile of the grid.
struct DistanceTile {
    SurfacesView surfaces;
    Tiles tiles;
    std::size_t cell;
    double* field;
    HEMOFLUX_FN void operator()(std::size_t tile) const {
        const TileRange r = tiles.range(tile);
        for (int k = r.k0; k < r.k1; ++k)
            for (int j = r.j0; j < r.j1; ++j)
                for (int i = 0; i < surfaces.grid.axis[0].n; ++i)
                    field[surfaces.grid.layout.at(i, j, k)] = -1;
        band_cells(surfaces, r, cell, WriteDistance{field});
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
      moved_(cells),
      vertex_half_width_(cells * vertices),
      triangle_(cells * triangles.size()),
      vertex_box_(cells * vertices),
      box_(cells * triangles.size()),
      group_box_(cells * groups_of(triangles.size())),
      surface_box_(cells),
      capacity_(cells, 0) {}

SurfacesView SignedDistance::view() {
    return {grid_.view(),        cells_,           triangles_,        groups_of(triangles_),
            triangle_.data(),    box_.data(),      group_box_.data(), lattice_,
            surface_box_.data(), centre_x_.data(), row_capacity_,     begin_.data(),
            ratio_.data(),       winding_.data()};
}

void SignedDistance::prepare_triangles(const double* x, const double* y, const double* z) {
    const CellGridView grid = grid_.view();
    exchange::for_each_index(cells_ * vertices_, VertexBand{grid,
                                                            half_width_,
                                                            vertices_,
                                                            moved_.data(),
                                                            {x, y, z},
                                                            vertex_half_width_.data(),
                                                            vertex_box_.data()});
    const std::size_t groups = groups_of(triangles_);
    exchange::for_each_index(cells_ * groups, PrepareGroup{grid,
                                                           triangles_,
                                                           vertices_,
                                                           groups,
                                                           lattice_,
                                                           corners_.data(),
                                                           moved_.data(),
                                                           {x, y, z},
                                                           vertex_half_width_.data(),
                                                           vertex_box_.data(),
                                                           triangle_.data(),
                                                           box_.data(),
                                                           group_box_.data()});
    exchange::for_each_index(cells_,
                             SurfaceBox{grid, groups, moved_.data(), group_box_.data(), surface_box_.data()});
}

bool SignedDistance::make_room(const std::vector<CellBox>& boxes) {
    const auto values = [](const CellBox& b) {
        return static_cast<std::size_t>((b.last[1] - b.first[1]) * (b.last[2] - b.first[2])) *
               SurfacesView::row_length(b);
    };
    std::size_t row = 0;
    bool fits = true;
    for (std::size_t c = 0; c < cells_; ++c) {
        row = std::max(row, SurfacesView::row_length(boxes[c]));
        fits = fits && values(boxes[c]) <= capacity_[c];
    }
    if (fits && row <= row_capacity_) return true;
    // cells that turn or stretch need more before long
    row_capacity_ = std::max(row_capacity_, row + row / 4);
    for (std::size_t c = 0; c < cells_; ++c)
        capacity_[c] = std::max(capacity_[c], values(boxes[c]) + values(boxes[c]) / 2);
    std::vector<std::size_t> begin(cells_);
    std::exclusive_scan(capacity_.begin(), capacity_.end(), begin.begin(), std::size_t{0});
    const std::size_t all = begin.back() + capacity_.back();
    begin_ = exchange::Buffer<std::size_t>(begin);
    centre_x_ = exchange::Buffer<double>(cells_ * row_capacity_);
    ratio_ = exchange::Buffer<double>(all);
    winding_ = exchange::Buffer<int>(all);
    return false;
}

void SignedDistance::scan(const std::vector<CellBox>& boxes) {
    std::size_t tiles = 0;
    for (const CellBox& b : boxes) {
        const auto across = [&](int q) {
            return static_cast<std::size_t>((b.last[q] - b.first[q] + tile_rows - 1) / tile_rows);
        };
        tiles = std::max(tiles, across(1) * across(2));
    }
    exchange::for_each_index(cells_, RowCentres{grid_.view(), moved_.data(), surface_box_.data(),
                                                row_capacity_, centre_x_.data()});
    exchange::for_each_index(cells_ * tiles, ScanTile{view(), moved_.data(), tiles});
}

void SignedDistance::prepare(const double* x, const double* y, const double* z,
                             const std::vector<int>& moved) {
    moved_.assign(moved.empty() ? std::vector<int>(cells_, 1) : moved);
    prepare_triangles(x, y, z);
    const std::vector<CellBox> boxes = surface_box_.to_host();
    if (!make_room(boxes)) moved_.fill(1);
    scan(boxes);
}

void SignedDistance::evaluate(std::size_t cell, double* field) {
    const CellGridView grid = grid_.view();
    const Tiles tiles(grid.layout);
    exchange::for_each_index(tiles.count(), DistanceTile{view(), tiles, cell, field});
}

}  // namespace hemoflux::coupling

/// Division of the grid into tiles of rows along x: the units of work of everything that writes to cells.
/// Their size is fixed, so that results do not depend on the number of threads.
#pragma once

#include <cstddef>

#include "exchange/layout.hpp"
#include "exchange/macros.hpp"

namespace hemoflux::coupling {

/// Rows of a tile in y and in z; a GPU thread takes a single row.
inline constexpr int tile_rows = exchange::on_gpu ? 1 : 8;

/// Rows j0 <= j < j1, k0 <= k < k1 of one tile.
struct TileRange {
    int j0, j1, k0, k1;
};

/// The tiles of a grid, numbered along y first.
struct Tiles {
    /// Cells in y and z, tiles in y and z.
    int ny = 0, nz = 0, count_y = 0, count_z = 0;

    Tiles() = default;
    /// The tiles of a grid of this layout.
    explicit Tiles(const exchange::Layout& layout)
        : ny(static_cast<int>(layout.n[1])),
          nz(static_cast<int>(layout.n[2])),
          count_y((ny + tile_rows - 1) / tile_rows),
          count_z((nz + tile_rows - 1) / tile_rows) {}

    /// Number of tiles.
    HEMOFLUX_INLINE std::size_t count() const {
        return static_cast<std::size_t>(count_y) * static_cast<std::size_t>(count_z);
    }
    /// Number of the tile that is at (ty, tz).
    HEMOFLUX_INLINE std::size_t number(int ty, int tz) const {
        return static_cast<std::size_t>(tz) * static_cast<std::size_t>(count_y) +
               static_cast<std::size_t>(ty);
    }
    /// Rows of tile t.
    HEMOFLUX_INLINE TileRange range(std::size_t t) const {
        const int ty = static_cast<int>(t % static_cast<std::size_t>(count_y));
        const int tz = static_cast<int>(t / static_cast<std::size_t>(count_y));
        const int j1 = (ty + 1) * tile_rows, k1 = (tz + 1) * tile_rows;
        return {ty * tile_rows, j1 < ny ? j1 : ny, tz * tile_rows, k1 < nz ? k1 : nz};
    }
};

}  // namespace hemoflux::coupling

/// Where the cells of a rectilinear grid lie in memory: padded rows with ghost layers, the same for every
/// field.
#pragma once

#include <cstddef>

#include "exchange/macros.hpp"
#include "exchange/pack.hpp"

namespace hemoflux::exchange {

/// Ghost layers on every side: two, because gradients are computed from loads.
inline constexpr std::size_t ghosts = 2;

/// Structure-of-arrays layout of nx x ny x nz cells. Cell (i, j, k) lies at origin + i + j row + k plane; i,
/// j, k run from -ghosts to n + ghosts - 1. Interior rows start on a multiple of row_alignment, and a row may
/// be read one pack past its end.
struct Layout {
    std::size_t n[3] = {0, 0, 0};  ///< cells along x, y and z
    /// Values from row to row, from plane to plane, before cell (0, 0, 0), and of the whole field.
    std::size_t row = 0, plane = 0, origin = 0, size = 0;

    Layout() = default;
    /// Rows, planes and padding of a grid of nx x ny x nz cells.
    Layout(std::size_t nx, std::size_t ny, std::size_t nz) : n{nx, ny, nz} {
        row = round_up(row_alignment + nx + ghosts, row_alignment) + row_alignment;
        plane = row * (ny + 2 * ghosts);
        origin = row_alignment + ghosts * row + ghosts * plane;
        size = plane * (nz + 2 * ghosts);
    }

    /// Position of cell (i, j, k); negative indices are ghosts.
    HEMOFLUX_INLINE std::size_t at(std::ptrdiff_t i, std::ptrdiff_t j, std::ptrdiff_t k) const {
        return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(origin) + i +
                                        j * static_cast<std::ptrdiff_t>(row) +
                                        k * static_cast<std::ptrdiff_t>(plane));
    }
    /// Number of interior cells.
    HEMOFLUX_INLINE std::size_t cells() const { return n[0] * n[1] * n[2]; }
};

}  // namespace hemoflux::exchange

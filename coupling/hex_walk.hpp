/// Which hexahedron holds a point: a walk from the last one.
///
/// A cell is the 24 tetrahedra (c, g, p_i, p_i+1), c its centre, g the mean of the four corners p of a face: what
/// meshing/hex_grid.hpp measures its volume by. Two neighbours cut their common face into the same triangles, warped or
/// not, so the cells leave no gap and do not overlap, and every point of the domain lies in one of them (to 1e-12 of a
/// cell). The point, seen from the centre, lies behind one triangle; either it is on the near side, or the walk goes on
/// through that face.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "exchange/macros.hpp"
#include "exchange/vec3.hpp"

namespace hemoflux::coupling {

/// Faces of a hexahedron; pairs of periodic patches with different translations that a grid may have.
inline constexpr int hex_faces_count = 6, hex_periods = 3;
/// In place of a cell's number: none.
inline constexpr std::uint32_t no_cell = ~std::uint32_t{0};

/// A cell, and how many times each period it lies away from where the grid has it.
struct HexPlace {
    std::uint32_t cell = 0;
    int turns[hex_periods] = {0, 0, 0};
};

/// What lies across a face: a cell, or no_cell on the border. turn: 0, or +-(p + 1) across a pair of period p.
struct HexStep {
    std::uint32_t cell = no_cell;
    int turn = 0;
};

/// Cells, corners and neighbours of a grid, trivially copyable.
struct HexWalkView {
    std::size_t cells = 0;
    const Vec3d* centre = nullptr;          ///< [cell], um
    const Vec3d* node = nullptr;            ///< um
    const std::uint32_t* corner = nullptr;  ///< [cell][8] in the order of VTK_HEXAHEDRON
    const HexStep* step = nullptr;          ///< [cell][6] in the order of meshing::hex_faces
    Vec3d period[hex_periods] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};  ///< zero where there are fewer

    /// How far a place is from where the grid has its cell, um.
    HEMOFLUX_INLINE Vec3d offset(const HexPlace& p) const {
        return double(p.turns[0]) * period[0] + double(p.turns[1]) * period[1] +
               double(p.turns[2]) * period[2];
    }

    /// The face through which one leaves a cell towards x, or -1 when x lies in the cell. smallest: the least of the
    /// cell's 24 volumes, where it is asked for.
    HEMOFLUX_INLINE int exit(std::uint32_t cell, const Vec3d& x, double* smallest = nullptr) const {
        constexpr int face[hex_faces_count][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                                  {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
        const Vec3d c = centre[cell], d = x - c;
        Vec3d p[8];
        for (int v = 0; v < 8; ++v)
            p[v] = node[corner[8 * std::size_t{cell} + static_cast<std::size_t>(v)]] - c;
        double best = -1e300;
        int side = -1;
        for (int f = 0; f < hex_faces_count; ++f) {
            const Vec3d g = 0.25 * ((p[face[f][0]] + p[face[f][1]]) + (p[face[f][2]] + p[face[f][3]]));
            for (int i = 0; i < 4; ++i) {
                const Vec3d &a = p[face[f][i]], &b = p[face[f][(i + 1) % 4]];
                const Vec3d ab = cross(a, b), bg = cross(b, g), ga = cross(g, a);
                const double volume = dot(g, ab);
                if (smallest && !(volume >= *smallest)) *smallest = volume;
                const double u = dot(d, ab), v = dot(d, bg), w = dot(d, ga);
                const double least = (u < v ? (u < w ? u : w) : (v < w ? v : w)) / volume;
                if (!(least > best)) continue;
                best = least;
                side = u + v + w <= volume * (1 + 1e-12) ? -1 : f;
            }
        }
        return side;
    }

    /// Walks from `place` to the cell that holds x (um, anywhere along the periods). False when it meets the border, when
    /// x is not a number, or after `most` steps; `place` is then where it stopped.
    HEMOFLUX_INLINE bool walk(const Vec3d& x, HexPlace& place, int most) const {
        if (!(dot(x, x) < 1e200)) return false;
        for (int i = 0; i < most; ++i) {
            const int side = exit(place.cell, x - offset(place));
            if (side < 0) return true;
            const HexStep s =
                step[hex_faces_count * std::size_t{place.cell} + static_cast<std::size_t>(side)];
            if (s.cell == no_cell) return false;
            place.cell = s.cell;
            if (s.turn != 0) place.turns[(s.turn > 0 ? s.turn : -s.turn) - 1] += s.turn > 0 ? 1 : -1;
        }
        return false;
    }
};

}  // namespace hemoflux::coupling

/// An unstructured mesh of hexahedra as files and generators give it: nodes, cells and named patches.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "exchange/vec3.hpp"

namespace hemoflux::meshing {

/// Nodes, hexahedra and the patches of their border. Lengths are in whatever unit the file was written in
/// until scaled (scaled()); the rest of the program works in um.
struct HexMesh {
    /// Part of the border with its name; each face has the four node numbers of a cell's face, in either
    /// turning sense.
    struct Patch {
        std::string name;
        std::vector<std::array<std::uint32_t, 4>> faces;
    };

    std::vector<Vec3d> nodes;
    /// Eight nodes per cell in the order of VTK_HEXAHEDRON: the bottom quadrilateral seen from inside
    /// counter-clockwise, then the top one above it.
    std::vector<std::array<std::uint32_t, 8>> cells;
    std::vector<Patch> patches;
};

/// Two patches glued face to face by a translation: what leaves through one enters through the other.
struct PeriodicPair {
    std::string low, high;
};

/// Local nodes of the six faces of a VTK_HEXAHEDRON, turned so that their area points out of the cell: the
/// faces towards -x, +x, -y, +y, -z, +z of a cell aligned with the axes.
inline constexpr std::array<std::array<int, 4>, 6> hex_faces{
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

/// The mesh with all lengths multiplied by `factor`. InputError unless factor is finite and positive.
HexMesh scaled(HexMesh mesh, double factor);

}  // namespace hemoflux::meshing

/// Quadrilaterals in a plane, drawn out into hexahedra: what the shipped geometries are made of.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "meshing/hex_mesh.hpp"

namespace hemoflux::meshing {

/// Quadrilaterals, each turning counter-clockwise, and the named parts of their border.
struct PlaneMesh {
    /// A named part of the border: its edges, as pairs of nodes.
    struct Side {
        std::string name;
        std::vector<std::array<std::uint32_t, 2>> edges;
    };

    std::vector<std::array<double, 2>> nodes;
    std::vector<std::array<std::uint32_t, 4>> quads;
    std::vector<Side> sides;
};

/// Draws the plane out along z over ascending levels. Sides become patches of their name; the first and last level
/// become `low` and `high`. InputError unless there are two levels or more.
HexMesh extrude(const PlaneMesh& plane, const std::vector<double>& levels, const std::string& low,
                const std::string& high);

/// Renames the axes of a mesh in a circle: what was z becomes x, x becomes y, y becomes z. Cells stay right-handed.
HexMesh z_to_x(HexMesh mesh);

}  // namespace hemoflux::meshing

/// Which cells of a mesh of hexahedra touch: the first half of make_hex_grid.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "meshing/hex_mesh.hpp"

namespace hemoflux::meshing {

/// A face of a cell: side = 6 cell + number in hex_faces. The opposite side of the cell is side ^ 1.
struct HexTopology {
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    /// Two sides that are one face. Neighbours across a periodic pair: a lies on its low, b on its high patch,
    /// and pair is its number; otherwise pair is none.
    struct Link {
        std::uint32_t a, b;
        std::uint32_t pair = none;
    };
    /// The sides of a patch that is not glued, ascending.
    struct Patch {
        std::string name;
        std::vector<std::uint32_t> sides;
    };

    std::vector<Link> links;
    std::vector<Patch> patches;
    std::vector<Vec3d> translation;      ///< of every periodic pair, from low to high
    std::vector<std::uint32_t> partner;  ///< per side: the side it touches, none on the border

    /// Whether the cell of this side is the only one across the domain in the direction from the opposite side to
    /// this one: both are on the border, or the cell is its own periodic neighbour.
    [[nodiscard]] bool one_cell_thick(std::uint32_t side) const {
        const std::uint32_t opposite = side ^ 1U;
        return partner[side] == opposite || (partner[side] == none && partner[opposite] == none);
    }
};

/// Finds the faces. Errors as make_hex_grid, save those of volume.
HexTopology connect(const HexMesh& mesh, const std::vector<PeriodicPair>& periodic);

/// The four nodes of a side, its area pointing out of the cell.
std::array<std::uint32_t, 4> side_nodes(const HexMesh& mesh, std::uint32_t side);

/// "cell 17 at (0.5, 1, 2)", for messages.
std::string describe_cell(const HexMesh& mesh, std::size_t cell);

}  // namespace hemoflux::meshing

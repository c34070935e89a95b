#include "meshing/hex_topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "exchange/error.hpp"
#include "meshing/hex_periodic.hpp"

namespace hemoflux::meshing {
namespace {

using Key = std::array<std::uint32_t, 4>;
constexpr std::uint32_t none = HexTopology::none;

Key sorted(Key key) {
    std::sort(key.begin(), key.end());
    return key;
}

void check_nodes(const HexMesh& mesh) {
    if (mesh.cells.empty())
        throw InputError("mesh without hexahedra", "the flow needs cells", "Give a mesh of hexahedral cells");
    if (mesh.cells.size() > (std::size_t{1} << 29))
        throw InputError(fmt::format("mesh with {} cells", mesh.cells.size()),
                         "faces are numbered in 32 bits", "Give a mesh of at most 536,870,912 cells");
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
        const Vec3d& x = mesh.nodes[i];
        if (!std::isfinite(x.x) || !std::isfinite(x.y) || !std::isfinite(x.z))
            throw InputError(fmt::format("node {} at ({}, {}, {})", i, x.x, x.y, x.z),
                             "coordinates must be finite", "Correct this node of the mesh");
    }
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        auto nodes = mesh.cells[c];
        std::sort(nodes.begin(), nodes.end());
        if (nodes.back() >= mesh.nodes.size())
            throw InputError(fmt::format("cell {} refers to node {}", c, nodes.back()),
                             fmt::format("the mesh has {} nodes, numbered from 0", mesh.nodes.size()),
                             "Write the mesh again with all its nodes");
        if (std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end())
            throw InputError(describe_cell(mesh, c) + " has a node twice",
                             "it is a wedge or another degenerate hexahedron, of which a face has no area",
                             "Mesh this region with hexahedra of eight different nodes");
    }
}

/// Sides by their smallest node, so that the sides of one set of nodes are found in a short list.
class SideTable {
  public:
    explicit SideTable(const HexMesh& mesh) : mesh_(mesh), first_(mesh.nodes.size() + 1, 0) {
        const auto sides = static_cast<std::uint32_t>(6 * mesh.cells.size());
        for (std::uint32_t s = 0; s < sides; ++s) ++first_[key(s)[0] + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        sides_.resize(sides);
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t s = 0; s < sides; ++s) sides_[next[key(s)[0]]++] = s;
    }

    [[nodiscard]] Key key(std::uint32_t side) const { return sorted(side_nodes(mesh_, side)); }

    /// The sides of these sorted nodes, ascending; how many there are. The first three are in `found`.
    int find(const Key& wanted, std::array<std::uint32_t, 3>& found) const {
        if (wanted[0] + std::size_t{1} >= first_.size()) return 0;
        int count = 0;
        for (std::uint32_t i = first_[wanted[0]]; i < first_[wanted[0] + 1]; ++i) {
            if (key(sides_[i]) != wanted) continue;
            if (count < 3) found[static_cast<std::size_t>(count)] = sides_[i];
            ++count;
        }
        return count;
    }

  private:
    const HexMesh& mesh_;
    std::vector<std::uint32_t> first_, sides_;
};

/// Joins the sides that have the same nodes.
void link_sides(const HexMesh& mesh, const SideTable& table, HexTopology& out) {
    const auto sides = static_cast<std::uint32_t>(6 * mesh.cells.size());
    out.partner.assign(sides, none);
    std::array<std::uint32_t, 3> found{};
    for (std::uint32_t s = 0; s < sides; ++s) {
        const int count = table.find(table.key(s), found);
        if (count > 2)
            throw InputError(fmt::format("{} cells share one face, the first three being {}, {} and {}",
                                         count, found[0] / 6, found[1] / 6, found[2] / 6),
                             "a face has one cell on either side",
                             "Remove the cells that lie on one another");
        if (count == 2 && found[0] == s) {
            out.partner[s] = found[1];
            out.partner[found[1]] = s;
            out.links.push_back({s, found[1]});
        }
    }
}

/// The border sides of every patch; every border side must be in one.
std::vector<HexTopology::Patch> name_border(const HexMesh& mesh, const SideTable& table,
                                            const HexTopology& topology) {
    std::vector<HexTopology::Patch> patches;
    std::vector<std::uint32_t> owner(topology.partner.size(), none);
    std::array<std::uint32_t, 3> found{};
    for (const HexMesh::Patch& patch : mesh.patches) {
        const auto number = static_cast<std::uint32_t>(patches.size());
        for (const HexTopology::Patch& other : patches)
            if (other.name == patch.name)
                throw InputError(fmt::format("two patches named \"{}\"", patch.name),
                                 "conditions are given by the name of the patch",
                                 "Give each patch its own name, or join the two");
        patches.push_back({patch.name, {}});
        for (std::size_t f = 0; f < patch.faces.size(); ++f) {
            const int count = table.find(sorted(patch.faces[f]), found);
            if (count != 1)
                throw InputError(
                    fmt::format("face {} of patch \"{}\" is {}", f, patch.name,
                                count == 0
                                    ? "no face of a cell"
                                    : fmt::format("between cells {} and {}", found[0] / 6, found[1] / 6)),
                    "patches are made of faces of the border", "Take this surface out of the named groups");
            if (owner[found[0]] != none)
                throw InputError(
                    fmt::format(
                        "a face of {} is in patch \"{}\" and {}", describe_cell(mesh, found[0] / 6),
                        patches[owner[found[0]]].name,
                        owner[found[0]] == number ? "there again" : fmt::format("in \"{}\"", patch.name)),
                    "every border face takes one boundary condition", "Name each surface once");
            owner[found[0]] = number;
            patches.back().sides.push_back(found[0]);
        }
        std::sort(patches.back().sides.begin(), patches.back().sides.end());
    }
    std::size_t unnamed = 0;
    std::uint32_t example = 0;
    for (std::uint32_t s = 0; s < owner.size(); ++s) {
        if (topology.partner[s] != none || owner[s] != none) continue;
        if (unnamed++ == 0) example = s;
    }
    if (unnamed > 0)
        throw InputError(
            fmt::format("{} border {} in no patch, the first on {}", unnamed,
                        unnamed == 1 ? "face is" : "faces are", describe_cell(mesh, example / 6)),
            "every border face needs a boundary condition, and these are given by the name of a patch",
            "Name all surfaces of the border (in gmsh: physical groups of dimension 2), and merge nodes that "
            "coincide");
    return patches;
}

}  // namespace

std::array<std::uint32_t, 4> side_nodes(const HexMesh& mesh, std::uint32_t side) {
    const auto& cell = mesh.cells[side / 6];
    std::array<std::uint32_t, 4> nodes{};
    for (std::size_t k = 0; k < 4; ++k) nodes[k] = cell[static_cast<std::size_t>(hex_faces[side % 6][k])];
    return nodes;
}

std::string describe_cell(const HexMesh& mesh, std::size_t cell) {
    Vec3d mean{0, 0, 0};
    for (const std::uint32_t n : mesh.cells[cell]) mean += 0.125 * mesh.nodes[n];
    return fmt::format("cell {} at ({:.5g}, {:.5g}, {:.5g})", cell, mean.x, mean.y, mean.z);
}

HexTopology connect(const HexMesh& mesh, const std::vector<PeriodicPair>& periodic) {
    check_nodes(mesh);
    HexTopology out;
    const SideTable table(mesh);
    link_sides(mesh, table, out);
    out.patches = name_border(mesh, table, out);
    for (const PeriodicPair& pair : periodic) glue(mesh, pair, out);
    return out;
}

}  // namespace hemoflux::meshing

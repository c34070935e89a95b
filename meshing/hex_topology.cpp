#include "meshing/hex_topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

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

/// Sides by their nodes: those of one smallest node in a short sorted list.
class SideTable {
  public:
    struct Entry {
        Key key;
        std::uint32_t side;
    };

    explicit SideTable(const HexMesh& mesh) : first_(mesh.nodes.size() + 1, 0) {
        const auto sides = static_cast<std::uint32_t>(6 * mesh.cells.size());
        std::vector<Key> keys(sides);
        for (std::uint32_t s = 0; s < sides; ++s) keys[s] = sorted(side_nodes(mesh, s));
        for (const Key& key : keys) ++first_[key[0] + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        entries_.resize(sides);
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t s = 0; s < sides; ++s) entries_[next[keys[s][0]]++] = {keys[s], s};
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
            std::sort(entries_.begin() + first_[n], entries_.begin() + first_[n + 1],
                      [](const Entry& a, const Entry& b) {
                          return std::tie(a.key, a.side) < std::tie(b.key, b.side);
                      });
    }

    /// All sides, those of the same nodes next to each other in ascending order.
    [[nodiscard]] std::span<const Entry> all() const { return entries_; }

    /// The sides of these sorted nodes.
    [[nodiscard]] std::span<const Entry> find(const Key& wanted) const {
        if (wanted[0] + std::size_t{1} >= first_.size()) return {};
        const std::span<const Entry> bucket(entries_.data() + first_[wanted[0]],
                                            entries_.data() + first_[wanted[0] + 1]);
        const auto low =
            std::find_if(bucket.begin(), bucket.end(), [&](const Entry& e) { return e.key == wanted; });
        const auto high = std::find_if(low, bucket.end(), [&](const Entry& e) { return e.key != wanted; });
        return {low, high};
    }

  private:
    std::vector<std::uint32_t> first_;
    std::vector<Entry> entries_;
};

/// Joins the sides that have the same nodes.
void link_sides(const SideTable& table, HexTopology& out) {
    const std::span<const SideTable::Entry> all = table.all();
    out.partner.assign(all.size(), none);
    for (std::size_t i = 0; i < all.size();) {
        std::size_t end = i + 1;
        while (end < all.size() && all[end].key == all[i].key) ++end;
        if (end - i > 2)
            throw InputError(fmt::format("{} cells share one face, the first three being {}, {} and {}",
                                         end - i, all[i].side / 6, all[i + 1].side / 6, all[i + 2].side / 6),
                             "a face has one cell on either side",
                             "Remove the cells that lie on one another");
        if (end - i == 2) {
            const std::uint32_t a = all[i].side, b = all[i + 1].side;
            out.partner[a] = b;
            out.partner[b] = a;
            out.links.push_back({a, b});
        }
        i = end;
    }
}

/// The border sides of every patch; every border side must be in one.
std::vector<HexTopology::Patch> name_border(const HexMesh& mesh, const SideTable& table,
                                            const HexTopology& topology) {
    std::vector<HexTopology::Patch> patches;
    std::vector<std::uint32_t> owner(topology.partner.size(), none);
    for (const HexMesh::Patch& patch : mesh.patches) {
        const auto number = static_cast<std::uint32_t>(patches.size());
        for (const HexTopology::Patch& other : patches)
            if (other.name == patch.name)
                throw InputError(fmt::format("two patches named \"{}\"", patch.name),
                                 "conditions are given by the name of the patch",
                                 "Give each patch its own name, or join the two");
        patches.push_back({patch.name, {}});
        for (std::size_t f = 0; f < patch.faces.size(); ++f) {
            const std::span<const SideTable::Entry> found = table.find(sorted(patch.faces[f]));
            if (found.size() != 1)
                throw InputError(
                    fmt::format("face {} of patch \"{}\" is {}", f, patch.name,
                                found.empty() ? "no face of a cell"
                                              : fmt::format("between cells {} and {}", found[0].side / 6,
                                                            found[1].side / 6)),
                    "patches are made of faces of the border", "Take this surface out of the named groups");
            const std::uint32_t side = found[0].side;
            if (owner[side] != none)
                throw InputError(
                    fmt::format("a face of {} is in patch \"{}\" and {}", describe_cell(mesh, side / 6),
                                patches[owner[side]].name,
                                owner[side] == number ? "there again" : fmt::format("in \"{}\"", patch.name)),
                    "every border face takes one boundary condition", "Name each surface once");
            owner[side] = number;
            patches.back().sides.push_back(side);
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
    link_sides(table, out);
    out.patches = name_border(mesh, table, out);
    for (const PeriodicPair& pair : periodic) glue(mesh, pair, out);
    return out;
}

}  // namespace hemoflux::meshing

// MSH: gmsh's own format, through the gmsh library.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <unordered_map>

#include "meshing/gmsh_session.hpp"
#include "meshing/hex_formats.hpp"
#include "meshing/msh_check.hpp"

namespace hemoflux::meshing {
namespace {

// numbers of the MSH format
constexpr int quadrangle = 3, hexahedron = 5;

using Numbers = std::unordered_map<std::size_t, std::uint32_t>;

Numbers read_nodes(HexMesh& mesh) {
    std::vector<std::size_t> tags;
    std::vector<double> x, parameters;
    gmsh::model::mesh::getNodes(tags, x, parameters, -1, -1, false, false);
    std::vector<std::size_t> order(tags.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&tags](std::size_t a, std::size_t b) { return tags[a] < tags[b]; });
    Numbers numbers;
    numbers.reserve(tags.size());
    for (const std::size_t i : order) {
        numbers.emplace(tags[i], static_cast<std::uint32_t>(mesh.nodes.size()));
        mesh.nodes.push_back({x[3 * i], x[3 * i + 1], x[3 * i + 2]});
    }
    return numbers;
}

/// Appends the elements of one type on an entity (-1: on all), as arrays of node numbers.
template <std::size_t corners>
void read_elements(int type, int entity, const Numbers& numbers,
                   std::vector<std::array<std::uint32_t, corners>>& out) {
    std::vector<std::size_t> tags, nodes;
    gmsh::model::mesh::getElementsByType(type, tags, nodes, entity);
    for (std::size_t e = 0; e < tags.size(); ++e) {
        out.emplace_back();
        for (std::size_t k = 0; k < corners; ++k) {
            const auto found = numbers.find(nodes[corners * e + k]);
            if (found == numbers.end())
                throw FormatError(fmt::format("element {} names node {}, which is missing", tags[e],
                                              nodes[corners * e + k]));
            out.back()[k] = found->second;
        }
    }
}

/// Not asked of gmsh (getElementProperties): that computes with its own Eigen, which crashes where a program holds
/// another Eigen compiled for wider registers.
std::string name_of_type(int type) {
    switch (type) {
        case 2:
            return "Triangle 3";
        case quadrangle:
            return "Quadrilateral 4";
        case 4:
            return "Tetrahedron 4";
        case hexahedron:
            return "Hexahedron 8";
        case 6:
            return "Prism 6";
        case 7:
            return "Pyramid 5";
        default:
            return fmt::format("number {} of the format", type);
    }
}

/// Refuses elements other than `wanted` among those of this dimension on an entity (-1: on all).
void allow_only(int wanted, int dimension, int entity, const std::string& where) {
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types, dimension, entity);
    for (const int type : types) {
        if (type == wanted) continue;
        std::vector<std::size_t> tags, unused;
        gmsh::model::mesh::getElementsByType(type, tags, unused, entity);
        if (!tags.empty())
            throw FormatError(
                fmt::format("{} {} elements of type {}", where, tags.size(), name_of_type(type)));
    }
}

void read_patches(const Numbers& numbers, HexMesh& mesh) {
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups, 2);
    for (const auto& [dimension, tag] : groups) {
        HexMesh::Patch patch;
        gmsh::model::getPhysicalName(dimension, tag, patch.name);
        if (patch.name.empty()) patch.name = fmt::format("{}", tag);
        std::vector<int> entities;
        gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
        for (const int entity : entities) {
            allow_only(quadrangle, 2, entity, fmt::format("patch \"{}\" holds", patch.name));
            read_elements<4>(quadrangle, entity, numbers, patch.faces);
        }
        mesh.patches.push_back(std::move(patch));
    }
}

/// Node numbers as gmsh counts them, from 1.
template <std::size_t corners>
std::vector<std::size_t> tags_of(const std::vector<std::array<std::uint32_t, corners>>& elements) {
    std::vector<std::size_t> tags;
    tags.reserve(corners * elements.size());
    for (const auto& element : elements)
        for (const std::uint32_t n : element) tags.push_back(n + std::size_t{1});
    return tags;
}

void add_mesh(const HexMesh& mesh) {
    gmsh::model::add("hemoflux");
    constexpr int volume = 1;
    std::vector<int> surfaces;
    for (std::size_t p = 0; p < mesh.patches.size(); ++p)
        surfaces.push_back(gmsh::model::addDiscreteEntity(2, static_cast<int>(p) + 1));
    gmsh::model::addDiscreteEntity(3, volume, surfaces);
    std::vector<std::size_t> tags(mesh.nodes.size());
    std::vector<double> x;
    for (std::size_t i = 0; i < tags.size(); ++i) tags[i] = i + 1;
    for (const Vec3d& p : mesh.nodes) x.insert(x.end(), {p.x, p.y, p.z});
    gmsh::model::mesh::addNodes(3, volume, tags, x);
    gmsh::model::mesh::addElementsByType(volume, hexahedron, {}, tags_of(mesh.cells));
    gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {volume}), "fluid");
    for (std::size_t p = 0; p < mesh.patches.size(); ++p) {
        gmsh::model::mesh::addElementsByType(surfaces[p], quadrangle, {}, tags_of(mesh.patches[p].faces));
        const int group = gmsh::model::addPhysicalGroup(2, {surfaces[p]}, surfaces[p]);
        gmsh::model::setPhysicalName(2, group, mesh.patches[p].name);
    }
}

}  // namespace

HexMesh read_msh(const std::string& file) {
    check_msh(file_text(file));
    return with_gmsh([&file] {
        HexMesh mesh;
        gmsh::open(file);
        allow_only(hexahedron, 3, -1, "it holds");
        const Numbers numbers = read_nodes(mesh);
        read_elements<8>(hexahedron, -1, numbers, mesh.cells);
        read_patches(numbers, mesh);
        return mesh;
    });
}

void write_msh(const std::string& file, const HexMesh& mesh) {
    with_gmsh([&] {
        gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
        gmsh::option::setNumber("Mesh.Binary", 1);
        add_mesh(mesh);
        gmsh::write(file);
        check_msh(file_text(file));  // gmsh does not say when the disk is full
    });
}

}  // namespace hemoflux::meshing

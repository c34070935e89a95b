#include "meshing/plane_mesh.hpp"

#include <fmt/format.h>

#include "exchange/error.hpp"

namespace hemoflux::meshing {

HexMesh extrude(const PlaneMesh& plane, const std::vector<double>& levels, const std::string& low,
                const std::string& high) {
    if (levels.size() < 2)
        throw InputError(fmt::format("mesh drawn out over {} levels", levels.size()),
                         "a layer of cells lies between two levels", "Give at least one layer");
    const auto layer = static_cast<std::uint32_t>(plane.nodes.size());
    const auto layers = static_cast<std::uint32_t>(levels.size() - 1);
    HexMesh mesh;
    for (const double z : levels)
        for (const auto& [x, y] : plane.nodes) mesh.nodes.push_back({x, y, z});
    HexMesh::Patch bottom{low, {}}, top{high, {}};
    for (const auto& [a, b, c, d] : plane.quads) {
        for (std::uint32_t k = 0; k < layers; ++k) {
            const std::uint32_t at = k * layer, up = at + layer;
            mesh.cells.push_back({a + at, b + at, c + at, d + at, a + up, b + up, c + up, d + up});
        }
        const std::uint32_t up = layers * layer;
        bottom.faces.push_back({a, d, c, b});
        top.faces.push_back({a + up, b + up, c + up, d + up});
    }
    for (const PlaneMesh::Side& side : plane.sides) {
        HexMesh::Patch patch{side.name, {}};
        for (const auto& [a, b] : side.edges) {
            for (std::uint32_t k = 0; k < layers; ++k) {
                const std::uint32_t at = k * layer, up = at + layer;
                patch.faces.push_back({a + at, b + at, b + up, a + up});
            }
        }
        mesh.patches.push_back(std::move(patch));
    }
    mesh.patches.push_back(std::move(bottom));
    mesh.patches.push_back(std::move(top));
    return mesh;
}

HexMesh z_to_x(HexMesh mesh) {
    for (Vec3d& p : mesh.nodes) p = {p.z, p.x, p.y};
    return mesh;
}

}  // namespace hemoflux::meshing

#include "meshing/hex_mesh.hpp"

#include <fmt/format.h>

#include <cmath>

#include "exchange/error.hpp"

namespace hemoflux::meshing {

HexMesh scaled(HexMesh mesh, double factor) {
    if (!std::isfinite(factor) || !(factor > 0))
        throw InputError(fmt::format("mesh scaled by {}", factor), "lengths must stay finite and positive",
                         "Give a scale above 0");
    for (Vec3d& x : mesh.nodes) x = factor * x;
    return mesh;
}

}  // namespace hemoflux::meshing

/// Vorticity, (3.12): (dw/dy - dv/dz, du/dz - dw/dx, dv/dx - du/dy).
#pragma once

#include <array>
#include <vector>

#include "exchange/vec3.hpp"

namespace hemoflux::fluid {

/// From the gradients of density, u, v and w of one cell (velocity per length).
inline Vec3d vorticity(const std::array<Vec3d, 4>& gradient) {
    const auto& [rho, u, v, w] = gradient;
    return {w.y - v.z, u.z - w.x, v.x - u.y};
}

/// Of every cell.
inline std::vector<Vec3d> vorticity(const std::vector<std::array<Vec3d, 4>>& gradients) {
    std::vector<Vec3d> result;
    result.reserve(gradients.size());
    for (const auto& gradient : gradients) result.push_back(vorticity(gradient));
    return result;
}

}  // namespace hemoflux::fluid

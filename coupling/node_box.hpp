/// The box that holds the nodes, as everything sees it that measures distances between them.
#pragma once

#include <cmath>

#include "exchange/macros.hpp"
#include "exchange/vec3.hpp"

namespace hemoflux::coupling {

/// The box that holds the nodes: lower corner, lengths (um) and which axes are periodic.
struct NodeBox {
    double lower[3] = {0, 0, 0}, length[3] = {1, 1, 1};
    bool periodic[3] = {false, false, false};

    /// Vector from a to the nearest image of b; exactly opposite for b to a. image: whether that is b itself.
    HEMOFLUX_INLINE Vec3d nearest(const Vec3d& a, const Vec3d& b, bool* itself) const {
        double d[3] = {b.x - a.x, b.y - a.y, b.z - a.z};
        *itself = true;
        for (int q = 0; q < 3; ++q) {
            if (!periodic[q] || !(std::fabs(d[q]) > 0.5 * length[q])) continue;
            d[q] -= std::nearbyint(d[q] / length[q]) * length[q];
            *itself = false;
        }
        return {d[0], d[1], d[2]};
    }
};

}  // namespace hemoflux::coupling

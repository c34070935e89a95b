/// The frame (n, t1, t2) in which the flux through a face is computed; the D3Q15 lattice is aligned with it.
#pragma once

#include <cmath>

#include "exchange/macros.hpp"
#include "exchange/vec3.hpp"

namespace hemoflux::meshing {

/// Right-handed orthonormal vectors; tangent1 x tangent2 = normal.
struct FaceFrame {
    Vec3d normal, tangent1, tangent2;
};

/// Frame of the unit vector n. t2 is the axis to which n is most nearly perpendicular (z before y before x
/// when two are alike) less its part along n, and t1 = t2 x n. So a normal along an axis gives axes, and on a
/// mesh that is one sheet of cells in z the second tangent is z on every lateral face.
HEMOFLUX_INLINE FaceFrame face_frame(const Vec3d& n) {
    const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
    Vec3d axis{1, 0, 0};
    if (z <= x && z <= y) {
        axis = {0, 0, 1};
    } else if (y <= x) {
        axis = {0, 1, 0};
    }
    const Vec3d t = axis - dot(axis, n) * n;
    const Vec3d t2 = (1 / norm(t)) * t;
    return {n, cross(t2, n), t2};
}

}  // namespace hemoflux::meshing

#include "meshing/hex_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemoflux::meshing {

double largest_delta(const Vec3d& face_centre, const FaceFrame& frame, int inward, const Vec3d& cell_centre,
                     std::span<const Limit> limits) {
    double delta = std::numeric_limits<double>::infinity();
    for (const Limit& limit : limits) {
        const double distance = dot(limit.centre - face_centre, limit.normal);
        const double n = inward * dot(frame.normal, limit.normal);
        const double t1 = std::fabs(dot(frame.tangent1, limit.normal));
        const double t2 = std::fabs(dot(frame.tangent2, limit.normal));
        // the fastest of the directions (0, +-1, 0), (0, 0, +-1), (1, 0, 0), (1, +-1, +-1) towards the limit
        const double speed = std::max({n + t1 + t2, n, t1, t2});
        if (speed > 1e-12) delta = std::min(delta, distance / speed);
    }
    const double least = std::fabs(dot(cell_centre - face_centre, frame.normal)) / 20;
    return std::max(delta, least);
}

}  // namespace hemoflux::meshing

#include "fluid/hex_time_step.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hemoflux::fluid {

double stable_step(const meshing::HexGrid& grid, double delta_max, const std::vector<char>& idle,
                   Scheme scheme, double nu, double speed, double gamma) {
    if (scheme == Scheme::factored)
        throw std::invalid_argument("stable_step: the factored scheme needs a rectilinear grid");
    const double sound = std::sqrt(speed * speed * (1 - gamma) + gamma * gamma / 3);
    double step = 1e300;
    for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
        Vec3d projection{0, 0, 0};
        double sum = 0, largest = 0;
        for (std::size_t s = grid.first_face[cell]; s < grid.first_face[cell + 1]; ++s) {
            const std::size_t f = grid.face[s];
            if (idle[f]) continue;
            const Vec3d& a = grid.area[f];
            projection += 0.5 * Vec3d{std::abs(a.x), std::abs(a.y), std::abs(a.z)};
            const double stiffness = norm(a) / std::min(grid.delta[f], delta_max);
            sum += stiffness;
            largest = std::max(largest, stiffness);
        }
        const double scale = 1 / (gamma * grid.volume[cell]);
        const double viscous = 2 * nu * scale * (sum / 2 + largest);
        const double acoustic =
            scale * (speed * (projection.x + projection.y + projection.z) + sound * norm(projection));
        // Forward Euler is unstable for undamped waves; viscosity damps them while dt < 2 lambda_v / lambda_c^2.
        step = std::min(
            step, scheme == Scheme::rk4
                      ? 1 / (viscous / real_limit_rk4 + acoustic / imaginary_limit_rk4)
                      : std::min(real_limit_euler / viscous, 1 / (viscous / real_limit_euler + acoustic)));
    }
    return step;
}

}  // namespace hemoflux::fluid

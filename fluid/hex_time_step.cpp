#include "fluid/hex_time_step.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hemoflux::fluid {

double stable_step(const meshing::HexGrid& grid, double delta_max, const std::vector<char>& idle,
                   Scheme scheme, double nu, double speed, double gamma) {
    if (scheme == Scheme::factored)
        throw std::invalid_argument("stable_step: the factored scheme needs a rectilinear grid");
    const double sound = preconditioned_sound(speed, gamma);
    double step = 1e300;
    for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
        Vec3d projection{0, 0, 0};
        double sum = 0, largest = 0, area = 0, largest_area = 0, delta = 1e300;
        for (std::size_t s = grid.first_face[cell]; s < grid.first_face[cell + 1]; ++s) {
            const std::size_t f = grid.face[s];
            if (idle[f]) continue;
            const Vec3d& a = grid.area[f];
            projection += 0.5 * Vec3d{std::abs(a.x), std::abs(a.y), std::abs(a.z)};
            const double own_delta = std::min(grid.delta[f], delta_max), stiffness = norm(a) / own_delta;
            delta = std::min(delta, own_delta);
            sum += stiffness;
            largest = std::max(largest, stiffness);
            area += norm(a);
            largest_area = std::max(largest_area, norm(a));
        }
        const double volume = grid.volume[cell], scale = 1 / (gamma * volume);
        StepRates r;
        r.viscous = 2 * nu * scale * (sum / 2 + largest);
        r.acoustic =
            scale * (speed * (projection.x + projection.y + projection.z) + sound * norm(projection));
        r.streaming_sum = streaming_rate * area / (2 * volume);
        r.streaming_largest = (streaming_rate + 2 * speed / gamma) * largest_area / volume;
        r.viscosity = nu / gamma;
        r.diffusivity = r.viscosity + delta / 3;
        r.convection = speed / gamma;
        r.fastest = (speed + sound) / gamma;
        step = std::min(step, explicit_step(scheme, r));
    }
    return step;
}

}  // namespace hemoflux::fluid

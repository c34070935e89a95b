#include "meshing/evans_fung.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "exchange/error.hpp"
#include "meshing/icosphere.hpp"

namespace hemoflux::meshing {
namespace {

// z / (D n_z) at s = n_x^2 + n_y^2 = 4 rho^2 / D^2
double profile(double s) {
    constexpr double a0 = 0.0518, a1 = 2.0026, a2 = -4.491;
    return a0 + s / 4 * (a1 + s / 4 * a2);
}

}  // namespace

double evans_fung_thickness(double rho, double diameter) {
    const double s = 4 * rho * rho / (diameter * diameter);
    return s < 1 ? 2 * diameter * std::sqrt(1 - s) * profile(s) : 0;
}

SurfaceMesh evans_fung(const SurfaceMesh& sphere, double diameter) {
    if (!std::isfinite(diameter) || !(diameter > 0))
        throw InputError(fmt::format("Evans-Fung disc of diameter {} um", diameter),
                         "a diameter must be positive", "Use 7.82 um for a human red blood cell");
    const std::vector<Vec3d> unit = directions(sphere);
    SurfaceMesh disc = sphere;
    for (std::size_t v = 0; v < unit.size(); ++v) {
        const Vec3d n = unit[v];
        disc.vertices[v] = {0.5 * diameter * n.x, 0.5 * diameter * n.y,
                            diameter * n.z * profile(n.x * n.x + n.y * n.y)};
    }
    return disc;
}

}  // namespace hemoflux::meshing

#include "meshing/spheroid.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <numbers>

#include "exchange/error.hpp"
#include "meshing/icosphere.hpp"

namespace hemoflux::meshing {
namespace {

constexpr double pi = std::numbers::pi;

// artanh(e)/e and arcsin(e)/e lose no digits near the sphere, but are 0/0 on it
double over(double numerator, double e) { return e > 0 ? numerator / e : 1; }

}  // namespace

double area(const SpheroidAxes& axes) {
    const double a = axes.equatorial, c = axes.polar;
    if (c <= a) {
        const double e = std::sqrt((a - c) * (a + c)) / a;
        return 2 * pi * a * a * (1 + c * c / (a * a) * over(std::atanh(e), e));
    }
    const double e = std::sqrt((c - a) * (c + a)) / c;
    return 2 * pi * a * a * (1 + c / a * over(std::asin(e), e));
}

double volume(const SpheroidAxes& axes) {
    return 4 * pi / 3 * axes.equatorial * axes.equatorial * axes.polar;
}

double reduced_volume(const SpheroidAxes& axes) {
    return 6 * std::sqrt(pi) * volume(axes) / std::pow(area(axes), 1.5);
}

SpheroidAxes oblate_axes(double area_wanted, double reduced_volume_wanted) {
    if (!std::isfinite(area_wanted) || !(area_wanted > 0))
        throw InputError(fmt::format("spheroid of area {} um^2", area_wanted), "an area must be positive",
                         "Give a positive area");
    // thinner ones need no further digits: the area becomes that of two flat discs
    if (!(reduced_volume_wanted >= 0.05 && reduced_volume_wanted <= 1))
        throw InputError(fmt::format("spheroid of reduced volume {}", reduced_volume_wanted),
                         "a reduced volume lies between 0.05 and 1, the sphere",
                         "Choose 0.95 for the usual reference of a red blood cell");
    // the reduced volume rises with the aspect ratio polar / equatorial: bisection to the last digit
    double low = 0, high = 1;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (reduced_volume({1, middle}) < reduced_volume_wanted ? low : high) = middle;
    }
    const double scale = std::sqrt(area_wanted / area(SpheroidAxes{1, high}));
    return {scale, scale * high};
}

SurfaceMesh spheroid(const SurfaceMesh& sphere, double a, double b, double c) {
    for (const double axis : {a, b, c})
        if (!std::isfinite(axis) || !(axis > 0))
            throw InputError(fmt::format("ellipsoid of semi-axes {}, {}, {} um", a, b, c),
                             "semi-axes must be positive", "Give three positive semi-axes");
    const std::vector<Vec3d> unit = directions(sphere);
    SurfaceMesh mesh = sphere;
    for (std::size_t v = 0; v < unit.size(); ++v)
        mesh.vertices[v] = {a * unit[v].x, b * unit[v].y, c * unit[v].z};
    return mesh;
}

SurfaceMesh spheroid(const SurfaceMesh& sphere, const SpheroidAxes& axes) {
    return spheroid(sphere, axes.equatorial, axes.equatorial, axes.polar);
}

}  // namespace hemoflux::meshing

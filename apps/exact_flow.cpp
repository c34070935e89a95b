#include "apps/exact_flow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

void require(bool fits, const char* what, const char* why, const char* remedy) {
    if (!fits) throw InputError(what, why, remedy);
}

void check_walls(const Case& c, const char* solution) {
    require(!c.periodic(1) && c.periodic(0), solution, "it is a flow along x between walls at both ends of y",
            "Write x = \"periodic\" and conditions for y");
}

fluid::TaylorGreen taylor_green(const Case& c, const meshing::RectilinearGrid& grid, const Scales& s) {
    require(c.periodic(0) && c.periodic(1), "analytical.solution = \"taylor-green\"",
            "the vortices fill a plane that is periodic in x and y",
            "Write x = \"periodic\" and y = \"periodic\"");
    constexpr double turn = 2 * std::numbers::pi;
    return {c.analytical->speed / s.velocity_um_per_s, turn / grid.axes[0].length(),
            turn / grid.axes[1].length(), c.fluid.viscosity / s.viscosity_pa_s, c.numerics.gamma.value_or(1)};
}

fluid::Womersley womersley(const Case& c, const meshing::RectilinearGrid& grid, const Scales& s) {
    check_walls(c, "analytical.solution = \"womersley\"");
    require(c.body_force.period > 0 && c.body_force.amplitude[0] != 0, "analytical.solution = \"womersley\"",
            "an oscillating force along x drives it", "Give [body_force] an amplitude along x and a period");
    const fluid::SolverOptions o = [&] {
        fluid::SolverOptions options;
        set_body_force(c, s, options);
        return options;
    }();
    const meshing::Axis& y = grid.axes[1];
    return {o.oscillating_force.amplitude.x,      o.oscillating_force.omega,   o.oscillating_force.phase,
            c.fluid.viscosity / s.viscosity_pa_s, (y.lower() + y.upper()) / 2, y.length() / 2};
}

/// Scales in which a lattice unit of velocity is 1 um/s.
Scales plain_scales(const Case& c) { return fluid_scales(c, 1); }

}  // namespace

ExactCase exact_case(const Case& c, const meshing::RectilinearGrid& grid, const Scales& scales) {
    const meshing::Axis& y = grid.axes[1];
    const double speed = c.analytical->speed / scales.velocity_um_per_s;
    switch (c.analytical->solution) {
        case ExactSolution::couette:
            check_walls(c, "analytical.solution = \"couette\"");
            return {fluid::Couette{speed, y.lower(), y.length()}};
        case ExactSolution::poiseuille:
            return {fluid::Poiseuille{speed, y.lower(), y.length()}};
        case ExactSolution::taylor_green: {
            const fluid::TaylorGreen exact = taylor_green(c, grid, scales);
            return {exact, exact.decay_time() * scales.time_s()};
        }
        case ExactSolution::womersley:
            break;
    }
    const fluid::Womersley exact = womersley(c, grid, scales);
    return {exact, exact.period() * scales.time_s(), true};
}

double exact_clock(const Case& c, const meshing::RectilinearGrid& grid) {
    return exact_case(c, grid, plain_scales(c)).clock_s;
}

double largest_exact_speed(const Case& c, const meshing::RectilinearGrid& grid) {
    if (c.analytical->solution == ExactSolution::taylor_green) {
        const double ratio = grid.axes[0].length() / grid.axes[1].length();
        return c.analytical->speed * std::sqrt(std::max(ratio, 1 / ratio));
    }
    if (c.analytical->solution != ExactSolution::womersley) return c.analytical->speed;
    const fluid::Womersley exact = womersley(c, grid, plain_scales(c));
    constexpr int samples = 100;
    double fastest = 0;
    for (int j = 0; j <= samples; ++j)
        for (int k = 0; k < samples; ++k) {
            const double y = exact.middle + exact.half_height * j / samples;
            fastest = std::max(fastest, norm(exact({0, y, 0}, exact.period() * k / samples).velocity));
        }
    return fastest;
}

}  // namespace hemoflux::apps

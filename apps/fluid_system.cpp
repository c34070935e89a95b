#include "apps/fluid_system.hpp"

#include <algorithm>
#include <cmath>

#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

/// Mach number of the fastest wall (or estimated stream) where the case gives none.
constexpr double default_mach = 0.1;
/// Share of the largest stable step that is used where the case gives none.
constexpr double step_share = 0.9;

/// Largest speed that the boundary conditions, the shear or the driving force suggest, um/s. A driven stream
/// is taken as plane Poiseuille flow between the closest sides that are not periodic: u = f w^2/(8 mu).
double fastest(const Case& c, const meshing::RectilinearGrid& grid) {
    double speed = std::max(fastest_side(c), c.shear_rate ? *c.shear_rate * shear_reach(grid) : 0);
    double width = 1e300, low = 1e300, high = -1e300;
    for (std::size_t a = 0; a < 3; ++a) {
        for (const PatchInput& p : c.boundary[a]) {
            if (p.density == DensityCondition::pressure)
                low = std::min(low, p.value), high = std::max(high, p.value);
        }
        if (!c.periodic(a)) width = std::min(width, grid.axes[a].length());
    }
    const double acceleration = std::hypot(c.acceleration[0], c.acceleration[1], c.acceleration[2]);
    if (width < 1e300) {
        constexpr double per_um = 1e-6;                          // m
        double drive = c.fluid.density * acceleration * per_um;  // Pa/um
        if (high > low) drive += (high - low) / grid.axes[0].length();
        speed = std::max(speed, drive * width * width / (8 * c.fluid.viscosity));
    }
    if (!(speed > 0))
        throw InputError("the flow",
                         "no side moves, no pressure differs and no force acts, so nothing will flow",
                         "Give a velocity, a pressure difference, [shear] or [body_force]");
    return speed;
}

Scales make_scales(const Case& c, double speed, double mach) {
    Scales s;
    s.velocity_um_per_s = std::sqrt(3.0) * speed / mach;
    const double metres_per_s = s.velocity_um_per_s * 1e-6;
    s.density = c.fluid.density;
    s.pressure_pa = s.density * metres_per_s * metres_per_s;
    s.viscosity_pa_s = s.density * metres_per_s * 1e-6;
    return s;
}

fluid::Solver make_solver(const Case& c, const meshing::RectilinearGrid& grid, const Scales& scales) {
    const double rate = c.shear_rate.value_or(0) / scales.velocity_um_per_s;
    fluid::SolverOptions o;
    o.nu = c.fluid.viscosity / scales.viscosity_pa_s;
    set_acceleration(c, scales, o);
    o.gamma = c.numerics.gamma;
    o.tau_floor = c.numerics.tau_floor;
    o.single_precision = c.numerics.single_precision;
    o.scheme = scheme_of(c.time.scheme);
    fluid::Solver solver(grid, make_patches(c, scales, rate), o);
    solver.initialise(initial_flow(c, rate));
    return solver;
}

double duration(const Case& c) { return c.time.duration ? *c.time.duration : *c.time.strain / *c.shear_rate; }

double step(const Case& c, const FluidSystem& s) {
    if (c.time.step) return *c.time.step;
    if (c.numerics.step_strain) return *c.numerics.step_strain / *c.shear_rate;
    return step_share * s.scales.time_s() *
           fluid::stable_step(s.solver.grid(), s.solver.options().scheme, s.solver.options().nu,
                              s.mach / std::sqrt(3.0), s.solver.options().gamma);
}

}  // namespace

FluidSystem::FluidSystem(const Case& c)
    : grid(make_grid(c.grid)),
      speed(fastest(c, grid)),
      mach(c.numerics.mach.value_or(default_mach)),
      scales(make_scales(c, speed, mach)),
      solver(make_solver(c, grid, scales)),
      plan(duration(c), step(c, *this)) {}

}  // namespace hemoflux::apps

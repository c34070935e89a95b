#include "apps/flow_setup.hpp"

#include <algorithm>
#include <cmath>

namespace hemoflux::apps {
namespace {

fluid::Patch make_patch(const PatchInput& in, const Scales& scales, double rate, double gamma) {
    fluid::Patch p;
    switch (in.velocity) {
        case VelocityCondition::periodic:
            return fluid::periodic_patch();
        case VelocityCondition::symmetry:
            p.velocity = fluid::VelocityCondition::symmetry;
            break;
        case VelocityCondition::zero_gradient:
            p.velocity = fluid::VelocityCondition::zero_gradient;
            break;
        case VelocityCondition::no_slip:
            break;
        case VelocityCondition::shear:
            p.velocity_profile = [rate](const Vec3d& x) { return Vec3d{rate * x.y, 0, 0}; };
            break;
        case VelocityCondition::vector: {
            const double s = 1 / scales.velocity_um_per_s;
            const Vec3d u{s * in.vector[0], s * in.vector[1], s * in.vector[2]};
            p.velocity_profile = [u](const Vec3d&) { return u; };
            break;
        }
    }
    if (in.density != DensityCondition::zero_gradient) {
        p.density = fluid::DensityCondition::given;
        // p = gamma rho / 3 (3.8, corrected), counted from the reference density 1
        const double rho = in.density == DensityCondition::pressure
                               ? 1 + 3 * in.value / (gamma * scales.pressure_pa)
                               : in.value;
        p.density_profile = [rho](const Vec3d&) { return rho; };
    }
    return p;
}

}  // namespace

fluid::Patches make_patches(const Case& c, const Scales& scales, double rate) {
    fluid::Patches patches;
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t side = 0; side < 2; ++side)
            patches[2 * a + side] = make_patch(c.boundary[a][side], scales, rate, c.numerics.gamma);
    return patches;
}

std::function<fluid::FlowPoint(const Vec3d&)> initial_flow(const Case& c, double rate) {
    const double r = c.fluid.initial == InitialFlow::shear ? rate : 0;
    return [r](const Vec3d& x) { return fluid::FlowPoint{1, {r * x.y, 0, 0}}; };
}

void set_acceleration(const Case& c, const Scales& scales, fluid::SolverOptions& options) {
    if (c.acceleration == Triple{}) return;
    options.with_force = true;
    // rho a is N/m^3; a lattice force density is one lattice stress per um
    constexpr double metre_per_um = 1e-6;
    for (std::size_t a = 0; a < 3; ++a)
        options.uniform_force[a] = c.fluid.density * c.acceleration[a] * metre_per_um / scales.pressure_pa;
}

double fastest_side(const Case& c) {
    double speed = 0;
    for (const auto& sides : c.boundary)
        for (const PatchInput& p : sides)
            if (p.velocity == VelocityCondition::vector)
                speed = std::max(speed, std::hypot(p.vector[0], p.vector[1], p.vector[2]));
    return speed;
}

fluid::Scheme scheme_of(TimeScheme scheme) {
    switch (scheme) {
        case TimeScheme::euler:
            return fluid::Scheme::euler;
        case TimeScheme::rk4:
            return fluid::Scheme::rk4;
        case TimeScheme::factored:
            break;
    }
    return fluid::Scheme::factored;
}

double shear_reach(const meshing::RectilinearGrid& grid) {
    return std::max(std::abs(grid.axes[1].lower()), std::abs(grid.axes[1].upper()));
}

}  // namespace hemoflux::apps

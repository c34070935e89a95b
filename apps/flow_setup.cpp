#include "apps/flow_setup.hpp"

#include <numbers>

#include "apps/case_suspension.hpp"

namespace hemoflux::apps {
namespace {

constexpr double metre_per_um = 1e-6;

/// The velocity of the side x- everywhere, and the pressure that falls along x as its mean friction demands.
std::function<fluid::FlowPoint(const Vec3d&)> inflow_everywhere(const Case& c, double rate,
                                                                const Scales& scales) {
    const meshing::RectilinearGrid grid = make_grid(c.grid);
    const auto& [x_axis, y_axis, z_axis] = grid.axes;
    const double side = x_axis.lower(), end = x_axis.upper();
    const auto u = [side, patch = make_patches(c, scales, rate)[0]](double y, double z) {
        return patch.velocity_at({side, y, z}, 0);
    };
    constexpr int samples = 32;
    const double dy = y_axis.length() / samples, dz = z_axis.length() / samples;
    double laplacian = 0;
    for (int j = 0; j < samples; ++j)
        for (int k = 0; k < samples; ++k) {
            const double y = y_axis.lower() + (j + 0.5) * dy, z = z_axis.lower() + (k + 0.5) * dz;
            const double twice = 2 * u(y, z).x, hy = dy / 2, hz = dz / 2;
            laplacian += ((u(y + hy, z).x + u(y - hy, z).x - twice) / (hy * hy) +
                          (u(y, z + hz).x + u(y, z - hz).x - twice) / (hz * hz)) /
                         (samples * samples);
        }
    const double gradient = 3 * c.fluid.viscosity / scales.viscosity_pa_s * laplacian;
    return [u, end, gradient](const Vec3d& x) {
        return fluid::FlowPoint{1 + gradient * (x.x - end), u(x.y, x.z)};
    };
}

}  // namespace

Scales fluid_scales(const Case& c, double velocity_um_per_s) {
    Scales s;
    s.velocity_um_per_s = velocity_um_per_s;
    const double metres_per_s = velocity_um_per_s * metre_per_um;
    s.density = c.fluid.density;
    s.pressure_pa = s.density * metres_per_s * metres_per_s;
    s.viscosity_pa_s = s.density * metres_per_s * metre_per_um;
    return s;
}

std::function<fluid::FlowPoint(const Vec3d&)> initial_flow(const Case& c, double rate, const Scales& scales) {
    if (c.fluid.initial == InitialFlow::channel)
        return [flow = *undisturbed_flow(c), scale = 1 / scales.velocity_um_per_s](const Vec3d& x) {
            const double u = scale * flow.speed(x);
            return fluid::FlowPoint{
                1, {flow.axis() == 0 ? u : 0, flow.axis() == 1 ? u : 0, flow.axis() == 2 ? u : 0}};
        };
    if (c.fluid.initial == InitialFlow::inflow) return inflow_everywhere(c, rate, scales);
    if (c.fluid.initial == InitialFlow::uniform) {
        const Triple& u = c.fluid.initial_velocity;
        const Vec3d velocity = (1 / scales.velocity_um_per_s) * Vec3d{u[0], u[1], u[2]};
        return [velocity](const Vec3d&) { return fluid::FlowPoint{1, velocity}; };
    }
    const double r = c.fluid.initial == InitialFlow::shear ? rate : 0;
    return [r](const Vec3d& x) { return fluid::FlowPoint{1, {r * x.y, 0, 0}}; };
}

void set_body_force(const Case& c, const Scales& scales, fluid::SolverOptions& options) {
    const BodyForceInput& in = c.body_force;
    if (in.acceleration == Triple{} && in.amplitude == Triple{}) return;
    options.with_force = true;
    // rho a is N/m^3; a lattice force density is one lattice stress per um
    const double per_newton = metre_per_um / scales.pressure_pa;
    for (std::size_t a = 0; a < 3; ++a)
        options.uniform_force[a] = per_newton * c.fluid.density * in.acceleration[a];
    if (!(in.period > 0)) return;
    constexpr double turn = 2 * std::numbers::pi, degree = turn / 360;
    options.oscillating_force = {per_newton * Vec3d{in.amplitude[0], in.amplitude[1], in.amplitude[2]},
                                 turn / in.period * scales.time_s(), degree * in.phase};
}

coupling::Kernel kernel_of(Kernel kernel) {
    switch (kernel) {
        case Kernel::phi2:
            return coupling::Kernel::phi2;
        case Kernel::phi3:
            return coupling::Kernel::phi3;
        case Kernel::phi4:
            return coupling::Kernel::phi4;
        case Kernel::lagrange:
            break;
    }
    return coupling::Kernel::lagrange;
}

fluid::GradientMethod gradient_of(Gradient gradient) {
    switch (gradient) {
        case Gradient::least_squares:
            return fluid::GradientMethod::least_squares;
        case Gradient::green_gauss:
            return fluid::GradientMethod::green_gauss;
        case Gradient::hybrid:
            break;
    }
    return fluid::GradientMethod::hybrid;
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

}  // namespace hemoflux::apps

#include "coupling/scaling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "exchange/error.hpp"

namespace hemoflux::coupling {
namespace {

/// 1e-11 N over 1 um^2, in Pa.
constexpr double pascal_per_unit_force = 10;

void require_positive(const char* name, double value) {
    if (!(value > 0))
        throw InputError(fmt::format("{} {}", name, value), "a coupled run needs a positive value",
                         "give one");
}

/// Estimated relative errors: measured trends of this method (volume leak 0.4 % per 0.1 nu/h with balanced
/// forces, inertia 0.45 % per unit of Re_G, compressibility Ma^2, hydrodynamic radius of the kernel in
/// cells).
std::map<std::string, double> estimate(const Numerics& n, const PhysicalCase& p, Kernel kernel) {
    const double thickening = kernel == Kernel::lagrange ? 0.05
                              : kernel == Kernel::phi2   ? 0.22
                              : kernel == Kernel::phi3   ? 0.30
                                                         : 0.47;
    return {{"volume_leak", 0.04 * n.lattice_viscosity},
            {"inertia", 0.0045 * n.reynolds},
            {"compressibility", n.mach * n.mach},
            {"kernel_thickness", thickening * p.smallest_cell / p.radius}};
}

}  // namespace

Numerics choose_numerics(const PhysicalCase& p, const NumericsChoice& choice) {
    require_positive("density", p.density);
    require_positive("viscosity", p.viscosity);
    require_positive("shear rate", p.shear_rate);
    require_positive("shear modulus", p.shear_modulus);
    require_positive("cell radius", p.radius);
    require_positive("lattice viscosity", choice.lattice_viscosity);

    Numerics n;
    const double diameter = 2 * p.radius, contrast = std::max(1.0, p.largest_cytosol / p.viscosity);
    n.lattice_viscosity = choice.lattice_viscosity;
    n.largest_nu = choice.lattice_viscosity * p.smallest_cell;
    n.nu = n.largest_nu / contrast;
    n.rate = choice.mach > 0 ? choice.mach / std::sqrt(3.0) / p.wall_distance
                             : choice.reynolds * n.nu / (diameter * diameter);
    n.reynolds = n.rate * diameter * diameter / n.nu;
    n.mach = std::sqrt(3.0) * n.rate * p.wall_distance;
    if (!(n.mach < 0.3))
        throw InputError(
            fmt::format("Mach number {:.3g}", n.mach),
            "the equilibrium is an expansion for small Mach numbers, useful up to 0.3",
            "use more grid cells or a smaller box, or lower numerics.reynolds or numerics.lattice_viscosity");
    const double ratio = p.shear_rate / n.rate;  // lattice times per second
    n.velocity_um_per_s = ratio;
    n.force_factor = pascal_per_unit_force * n.nu * n.rate / (p.viscosity * p.shear_rate);
    n.capillary = p.shear_rate * p.viscosity * p.radius * 1e-6 / p.shear_modulus;
    n.physical_reynolds = p.shear_rate * diameter * diameter * 1e-12 * p.density / p.viscosity;

    const bool factored = choice.scheme == fluid::Scheme::factored,
               damped = factored && choice.kernel == Kernel::lagrange &&
                        std::min(p.area_modulus, p.local_area_modulus) >= stiff_area * p.shear_modulus;
    const double gain =
        choice.kernel == Kernel::phi3 || choice.kernel == Kernel::phi4 ? smooth_kernel_gain : 1;
    const double undamped = membrane_fraction * gain * n.capillary;  // G dt for dt = fraction mu R0/K_S
    if (choice.step_strain > 0) {
        n.step_limit = "given";
        n.step_strain = choice.step_strain;
    } else {
        const double membrane = undamped * (damped ? damped_gain : 1);
        const double share = factored ? fluid::implicit_density_limit : fluid::factored_limit;
        double fluid = share * p.smallest_cell / (1 + n.mach / std::sqrt(3.0)) * n.rate;
        n.step_limit = "acoustic";
        if (!factored) {
            const double limit =
                choice.scheme == fluid::Scheme::rk4 ? fluid::real_limit_rk4 : fluid::real_limit_euler;
            const double viscous = 0.9 * limit * p.smallest_cell * p.smallest_cell / (16 * n.largest_nu);
            if (viscous * n.rate < fluid) {
                fluid = viscous * n.rate;
                n.step_limit = "viscous";
            }
        }
        n.step_strain = std::min(fluid, membrane);
        if (membrane < fluid) n.step_limit = "membrane";
    }
    if (damped) n.constraint_damping = std::max(0.0, n.step_strain / undamped - 1);
    n.step = n.step_strain / n.rate;
    n.step_seconds = n.step_strain / p.shear_rate;
    n.errors = estimate(n, p, choice.kernel);
    return n;
}

}  // namespace hemoflux::coupling

/// From the fluid part of a case to patches and scales of the fluid solver.
#pragma once

#include "apps/case.hpp"
#include "coupling/delta_kernel.hpp"
#include "fluid/hex_boundary.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::apps {

/// What one lattice unit is in physical units (length um, density 1, c = 1).
struct Scales {
    double velocity_um_per_s = 1;  ///< c
    double pressure_pa = 1;        ///< rho_0 c^2 as the scaling sees it: lattice stress 1 in Pa
    double viscosity_pa_s = 1;     ///< of lattice viscosity 1 um c
    double density = 1000;         ///< kg/m^3 of lattice density 1
    /// Seconds per lattice time (um / c).
    [[nodiscard]] double time_s() const { return 1 / velocity_um_per_s; }
};

/// Scales of a case of kind fluid whose lattice speed is this many um/s.
Scales fluid_scales(const Case& c, double velocity_um_per_s);

/// Patches of the case's boundary in lattice units. rate: lattice shear rate, c/um. Throws InputError when an
/// expression cannot be read.
fluid::Patches make_patches(const Case& c, const Scales& scales, double rate, double gamma = 1);
/// The same for the patches of a mesh that are not periodic.
fluid::HexPatches make_hex_patches(const Case& c, const Scales& scales, double rate, double gamma);

/// Start of the flow: at rest, the same velocity everywhere, that of a channel, or u = rate y.
std::function<fluid::FlowPoint(const Vec3d&)> initial_flow(const Case& c, double rate, const Scales& scales);

/// Puts the case's constant and oscillating body force into the solver's options.
void set_body_force(const Case& c, const Scales& scales, fluid::SolverOptions& options);

/// Largest speed that a side of given velocity has, um/s; expressions are taken at t = 0 and at 16 times of the run.
double fastest_side(const Case& c);

/// The immersed boundary kernel, and the solver's scheme and gradient operator.
coupling::Kernel kernel_of(Kernel kernel);
fluid::Scheme scheme_of(TimeScheme scheme);
fluid::GradientMethod gradient_of(Gradient gradient);

}  // namespace hemoflux::apps

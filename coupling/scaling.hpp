/// From a physical case to the numbers the solvers use, by capillary scaling (6.52).
///
/// Strain G t is the common clock. The lattice viscosity nu/h controls the accuracy: continuity carries a
/// spurious term delta laplace(p), which leaks a volume flux of order delta nu/(h R) through a membrane; the
/// shear Reynolds number Re_G = G D^2/nu, D = 2 R0, measures the inertia that creeping flow does not have.
/// Both are chosen here instead of taken from the physical case; every modulus, spring constant and force is
/// multiplied by one factor, so that the capillary number Ca = G mu R0/K_S and the viscosity ratio are those
/// of the physical case:
///   nu = (nu/h) h,  G* = Re_G nu/D^2,  force* = force mu* G*/(mu G) per um^2,  mu* = rho nu, rho = 1, c = 1.
#pragma once

#include <map>
#include <string>

#include "coupling/delta_kernel.hpp"
#include "fluid/time_step.hpp"

namespace hemoflux::coupling {

/// The case in physical units.
struct PhysicalCase {
    double density = 1000;       ///< kg/m^3
    double viscosity = 0;        ///< of the suspending fluid, Pa s
    double largest_cytosol = 0;  ///< largest viscosity inside a cell, Pa s
    double shear_rate = 0;       ///< G, 1/s
    double shear_modulus = 0;    ///< K_S, N/m
    double radius = 0;           ///< R0 = sqrt(A0 / 4 pi), um
    double wall_distance = 0;    ///< greatest distance of a sheared wall from the plane at rest, um
    double smallest_cell = 0;    ///< h, um
    /// Moduli of area and triangle areas, N/m. Where both are at least `stiff_area` K_S the areas are constraints, whose
    /// rates may be damped; a capsule's areas are not.
    double area_modulus = 0, local_area_modulus = 0;
};

/// What the user may choose; zero means: let the program.
struct NumericsChoice {
    double lattice_viscosity = 0.5;  ///< nu/h
    double reynolds = 2;             ///< Re_G
    double mach = 0;                 ///< wall speed / c_s; given, it replaces reynolds
    double step_strain = 0;          ///< G dt
    Kernel kernel = Kernel::lagrange;
    fluid::Scheme scheme = fluid::Scheme::factored;
};

/// The solvers' numbers. Lengths in um, velocities in c, density 1; a lattice time is um / c.
struct Numerics {
    double lattice_viscosity = 0;  ///< nu/h of the more viscous of the two fluids
    double nu = 0;                 ///< suspending fluid, um c
    double largest_nu = 0;         ///< the more viscous of the two, um c
    double rate = 0;               ///< G*, c/um
    double step = 0;               ///< dt*, um/c
    double step_strain = 0;        ///< G dt
    double step_seconds = 0;       ///< dt, s
    double force_factor = 0;       ///< membrane force in 1e-11 N -> lattice force (rho c^2 um^2)
    double velocity_um_per_s = 0;  ///< c in um/s
    double reynolds = 0, mach = 0, capillary = 0;
    double physical_reynolds = 0;  ///< Re_G of the physical case
    /// Relative errors to expect from the numerical choices, by cause.
    std::map<std::string, double> errors;
    /// What limits the step: "acoustic", "membrane", "viscous" or "given".
    std::string step_limit;
    double constraint_damping = 0;  ///< strength that the step needs, see coupling/constraint_damping.hpp
};

/// The membrane allows steps of about 0.05 mu R0/K_S with Lagrange weights and twice that with phi4; chosen
/// is a bit less.
inline constexpr double membrane_fraction = 0.0425, smooth_kernel_gain = 2;
/// Moduli of area over K_S from which areas count as constraints; those of Tables 6.1 and 6.2 are 16 and more.
inline constexpr double stiff_area = 10;
/// What damped constraints gain with the factored scheme and Lagrange weights: steps of 0.106 mu R0/K_S are stable with a
/// cell of 2562 nodes on 30^3 cells, 0.085 are chosen.
inline constexpr double damped_gain = 2;

/// Chooses the numbers. Throws InputError when the physical case is impossible or the Mach number would pass
/// 0.3.
Numerics choose_numerics(const PhysicalCase& physical, const NumericsChoice& choice);

}  // namespace hemoflux::coupling

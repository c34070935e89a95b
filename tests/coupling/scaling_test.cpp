#include "coupling/scaling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exchange/error.hpp"

namespace hemoflux::coupling {
namespace {

PhysicalCase tank_treading() {
    PhysicalCase p;
    p.viscosity = 22e-3;
    p.largest_cytosol = 6e-3;
    p.shear_rate = 3;
    p.shear_modulus = 6.1e-6;
    p.radius = 3.2655;
    p.wall_distance = 6;
    p.smallest_cell = 0.2687;
    p.area_modulus = 1e-3;
    p.local_area_modulus = 1e-4;
    return p;
}

}  // namespace

// (6.52): the capillary number is the same in physical and in lattice units.
TEST(Scaling, KeepsTheCapillaryNumber) {
    const PhysicalCase p = tank_treading();
    const Numerics n = choose_numerics(p, {});
    constexpr double newton_per_unit = 1e-11, um = 1e-6;
    const double shear_modulus_lattice = p.shear_modulus * um / newton_per_unit * n.force_factor;
    EXPECT_NEAR(n.rate * n.nu * p.radius / shear_modulus_lattice, n.capillary, 1e-14);
    EXPECT_NEAR(n.capillary, 3 * 22e-3 * 3.2655e-6 / 6.1e-6, 1e-15);
    EXPECT_NEAR(n.nu, 0.5 * p.smallest_cell, 1e-15);
    EXPECT_NEAR(n.rate * 4 * p.radius * p.radius / n.nu, 2, 1e-14);
    // sqrt(3) (nu/h) Re_G h L / (2 D^2)
    EXPECT_NEAR(n.mach, std::sqrt(3.0) * 0.5 * 2 * p.smallest_cell * 12 / (2 * 4 * p.radius * p.radius),
                1e-14);
    EXPECT_NEAR(n.step_seconds * p.shear_rate, n.step_strain, 1e-15);
    EXPECT_NEAR(n.step * n.rate, n.step_strain, 1e-15);
    EXPECT_LE(n.step, fluid::implicit_density_limit * p.smallest_cell);
}

TEST(Scaling, TheMoreViscousFluidKeepsTheLatticeViscosity) {
    PhysicalCase p = tank_treading();
    p.viscosity = 1.2e-3;
    const Numerics n = choose_numerics(p, {});
    EXPECT_NEAR(n.largest_nu / p.smallest_cell, 0.5, 1e-15);
    EXPECT_NEAR(n.largest_nu / n.nu, 5, 1e-12);
}

TEST(Scaling, StepIsBoundByTheMembraneInSlowFlowAndBySoundInFastFlow) {
    PhysicalCase p = tank_treading();
    p.shear_rate = 10;
    EXPECT_EQ(choose_numerics(p, {}).step_limit, "acoustic");
    p.shear_rate = 0.5;
    const Numerics slow = choose_numerics(p, {});
    EXPECT_EQ(slow.step_limit, "membrane");
    NumericsChoice smooth;
    smooth.kernel = Kernel::phi4;
    EXPECT_NEAR(choose_numerics(p, smooth).step_strain,
                smooth_kernel_gain * membrane_fraction * slow.capillary, 1e-15);
    p.shear_rate = 3;
    NumericsChoice euler;
    euler.scheme = fluid::Scheme::euler;
    EXPECT_EQ(choose_numerics(p, euler).step_limit, "viscous");
    NumericsChoice given;
    given.step_strain = 1e-4;
    EXPECT_EQ(choose_numerics(p, given).step_strain, 1e-4);
    given.mach = 0.1;
    EXPECT_NEAR(choose_numerics(p, given).mach, 0.1, 1e-15);
}

// Constraints are damped where the step needs it, and not at all up to the explicit limit.
TEST(Scaling, DampsTheConstraintsBeyondTheExplicitLimit) {
    PhysicalCase p = tank_treading();
    p.shear_rate = 0.5;
    const Numerics slow = choose_numerics(p, {});
    EXPECT_NEAR(slow.step_strain, damped_gain * membrane_fraction * slow.capillary, 1e-15);
    EXPECT_NEAR(slow.constraint_damping, damped_gain - 1, 1e-12);
    NumericsChoice choice;
    choice.step_strain = membrane_fraction * slow.capillary;
    EXPECT_EQ(choose_numerics(p, choice).constraint_damping, 0);
    choice.step_strain *= 1.5;
    EXPECT_NEAR(choose_numerics(p, choice).constraint_damping, 0.5, 1e-12);
    choice.step_strain = 0;
    choice.kernel = Kernel::phi4;
    EXPECT_EQ(choose_numerics(p, choice).constraint_damping, 0);
    choice = {};
    PhysicalCase capsule = p;
    capsule.local_area_modulus = 0;
    EXPECT_EQ(choose_numerics(capsule, choice).constraint_damping, 0);
    EXPECT_NEAR(choose_numerics(capsule, choice).step_strain, membrane_fraction * slow.capillary, 1e-15);
    choice.scheme = fluid::Scheme::euler;
    EXPECT_EQ(choose_numerics(p, choice).constraint_damping, 0);
    EXPECT_LE(choose_numerics(p, choice).step_strain, membrane_fraction * slow.capillary);
}

TEST(Scaling, RefusesImpossibleCases) {
    PhysicalCase p = tank_treading();
    NumericsChoice fast;
    fast.reynolds = 20;
    EXPECT_THROW(choose_numerics(p, fast), InputError);  // Ma = 0.65
    p.shear_rate = 0;
    EXPECT_THROW(choose_numerics(p, {}), InputError);
}

}  // namespace hemoflux::coupling

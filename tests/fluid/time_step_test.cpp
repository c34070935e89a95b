#include "fluid/time_step.hpp"

#include <gtest/gtest.h>

#include <random>

#include "fluid/solver.hpp"

namespace hemoflux::fluid {
namespace {

/// True if noise in a periodic cube stays bounded at this step. nu / h = 4: viscosity rules, sound does not
/// matter.
bool stable(Scheme scheme, double dt_nu_over_h2) {
    constexpr int n = 8;
    constexpr double h = 1.0 / n;
    meshing::RectilinearGrid grid;
    grid.axes.fill(meshing::uniform_axis(0, 1, n));
    Patches p;
    p.fill(periodic_patch());
    SolverOptions o;
    o.nu = 4 * h;
    o.scheme = scheme;
    Solver solver(grid, p, o);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> noise(-1e-6, 1e-6);
    solver.initialise([&](const Vec3d&) {
        return FlowPoint{1, {noise(random), noise(random), noise(random)}};
    });
    const double dt = dt_nu_over_h2 * h * h / o.nu;
    for (int s = 0; s < 400; ++s) solver.step(dt);
    return solver.largest_speed() < 1e-5;
}

}  // namespace

// The largest viscous eigenvalue is 16 nu / h^2: forward Euler is stable up to h^2 / (8 nu), RK4 up to h^2 /
// (5.8 nu).
TEST(TimeStep, ViscousLimits) {
    EXPECT_TRUE(stable(Scheme::euler, 0.97 / 8));
    EXPECT_FALSE(stable(Scheme::euler, 1.04 / 8));
    EXPECT_TRUE(stable(Scheme::rk4, 0.97 * 2.785 / 16));
    EXPECT_FALSE(stable(Scheme::rk4, 1.04 * 2.785 / 16));
}

TEST(TimeStep, EigenvaluesOnAUniformGrid) {
    constexpr double h = 0.1;
    meshing::RectilinearGrid rg;
    rg.axes.fill(meshing::uniform_axis(0, 1, 10));
    const Grid grid(rg, {true, true, true});
    EXPECT_NEAR(viscous_eigenvalue(grid, 0.3), 16 * 0.3 / (h * h), 1e-9);
    EXPECT_NEAR(acoustic_eigenvalue(grid, 0.05), 3 * 0.05 / h + 1 / h, 1e-9);  // c_s sqrt(3) / h = 1 / h
    EXPECT_NEAR(stable_step(grid, Scheme::factored, 0.3, 0.0), 0.9 * h, 1e-12);
}

// The factored scheme stays stable far beyond the explicit viscous limit (here 31 times it), up to dt c = h.
TEST(TimeStep, FactoredIsBoundBySoundOnly) {
    EXPECT_TRUE(stable(Scheme::factored, 0.98 * 4));
    EXPECT_FALSE(stable(Scheme::factored, 1.05 * 4));
}

// Flat cells shorten delta, which stiffens the explicit flux along their long side; the factored operator
// must follow.
TEST(TimeStep, FactoredIsStableOnFlatCells) {
    for (const double aspect : {2.0, 4.0, 8.0})
        for (const double nu_over_h : {0.5, 5.0, 200.0}) {
            constexpr int n = 20;
            constexpr double h = 1.0 / n;
            meshing::RectilinearGrid grid;
            grid.axes = {meshing::uniform_axis(0, 4 * aspect * h, 4), meshing::uniform_axis(0, 1, n),
                         meshing::uniform_axis(0, 4 * h, 4)};
            Patches p;
            p.fill(periodic_patch());
            p[2] = p[3] = wall_patch();
            SolverOptions o;
            o.nu = nu_over_h * h;
            o.scheme = Scheme::factored;
            o.with_force = true;
            o.uniform_force[0] = 8 * o.nu * 0.02;
            Solver solver(grid, p, o);
            std::mt19937 random(1);
            std::uniform_real_distribution<double> noise(-1e-6, 1e-6);
            solver.initialise([&](const Vec3d& x) {
                return FlowPoint{1, {0.08 * x.y * (1 - x.y) + noise(random), noise(random), noise(random)}};
            });
            const double dt = stable_step(solver.grid(), o.scheme, o.nu, 0.02);
            for (int s = 0; s < 3000; ++s) solver.step(dt);
            EXPECT_LT(solver.largest_speed(), 0.021) << aspect << " " << nu_over_h;
            EXPECT_GT(solver.largest_speed(), 0.019) << aspect << " " << nu_over_h;
        }
}

}  // namespace hemoflux::fluid

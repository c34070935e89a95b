#include "fluid/time_step.hpp"

#include <fmt/format.h>
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

/// True if noise in a stream along all axes of a periodic box of 6 cells along each of its axes (a wall in every direction
/// instead, if stretched) stays bounded.
bool bounded(std::size_t axes, bool stretched, const SolverOptions& o, double speed, double share) {
    constexpr int n = 6;
    meshing::RectilinearGrid grid;
    grid.axes.fill(meshing::uniform_axis(0, 1, 1));
    Patches p;
    p.fill(stretched ? wall_patch() : periodic_patch());
    for (std::size_t a = 0; a < 3; ++a)
        if (a < axes)
            grid.axes[a] =
                stretched ? meshing::plateau_axis(0, n, n, n / 4.0, 4.0 / n) : meshing::uniform_axis(0, n, n);
        else
            p[2 * a] = p[2 * a + 1] = periodic_patch();
    Solver solver(grid, p, o);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> noise(-1e-7, 1e-7);
    const auto along = [&](std::size_t a) { return (a < axes ? speed : 0) + noise(random); };
    solver.initialise([&](const Vec3d&) {
        return FlowPoint{1 + noise(random), {along(0), along(1), along(2)}};
    });
    const double dt = share * stable_step(solver.grid(), o.scheme, o.nu,
                                          speed * std::sqrt(static_cast<double>(axes)), o.gamma);
    for (int s = 0; s < 300; ++s) solver.step(dt);
    for (std::size_t c = 0; c < 4; ++c)
        for (const double v : solver.values(static_cast<int>(c)))
            if (!(std::abs(v - (c == 0 ? 1 : c <= axes ? speed : 0)) < 3e-6)) return false;
    return true;
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

// From sound alone to viscosity alone, at rest and in a stream, with and without preconditioning, in one to three
// dimensions: stable at the bound, and the bound is not more than 1.6 times (RK4) too careful without stretching. At
// nu / h = 1e-4 streaming limits the step, where 1/dt = 1/dt_viscous + 1/dt_acoustic is up to twice too large.
TEST(TimeStep, BoundHoldsFromSoundToViscosity) {
    for (const Scheme scheme : {Scheme::rk4, Scheme::euler})
        for (std::size_t axes = 1; axes <= 3; ++axes)
            for (const double nu : {1e-4, 0.05})
                for (const double speed : {0.0, 0.1})
                    for (const double gamma : {1.0, 0.4}) {
                        SolverOptions o;
                        o.nu = nu;
                        o.gamma = gamma;
                        o.scheme = scheme;
                        const std::string where =
                            fmt::format("{} axes, nu {}, speed {}, gamma {}, scheme {}", axes, nu, speed,
                                        gamma, static_cast<int>(scheme));
                        EXPECT_TRUE(bounded(axes, false, o, speed, 1)) << where;
                        if (speed == 0) {
                            EXPECT_TRUE(bounded(axes, true, o, 0, 1)) << where;
                        }
                        if (scheme == Scheme::rk4) {
                            EXPECT_FALSE(bounded(axes, false, o, speed, 1.6)) << where;
                        }
                    }
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

// The factored scheme stays stable far beyond the explicit viscous limit (here 31 and 80 times it), also where the density
// becomes implicit.
TEST(TimeStep, FactoredIsNotBoundByViscosity) {
    EXPECT_TRUE(stable(Scheme::factored, 0.89 * 4));
    EXPECT_TRUE(stable(Scheme::factored, 0.98 * 4));
    EXPECT_TRUE(stable(Scheme::factored, implicit_density_limit * 4));
}

// With implicit density noise stays bounded from one to three dimensions, in streams, between walls and on stretched grids.
TEST(TimeStep, ImplicitDensityIsStableUpToItsLimit) {
    for (std::size_t axes = 1; axes <= 3; ++axes)
        for (const double nu : {0.2, 0.5, 2.0})
            for (const double speed : {0.0, 0.05}) {
                SolverOptions o;
                o.nu = nu;
                o.scheme = Scheme::factored;
                const std::string where = fmt::format("{} axes, nu {}, speed {}", axes, nu, speed);
                EXPECT_TRUE(bounded(axes, false, o, speed, implicit_density_limit / factored_limit)) << where;
                if (speed == 0) {
                    EXPECT_TRUE(bounded(axes, true, o, 0, implicit_density_limit / factored_limit)) << where;
                }
            }
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

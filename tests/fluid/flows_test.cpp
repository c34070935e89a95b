// Flows with analytical solutions: Couette, Poiseuille, Taylor-Green.
#include <gtest/gtest.h>

#include "flows.hpp"

namespace hemoflux::fluid::test {
namespace {

Patches channel(const std::function<Vec3d(const Vec3d&)>& top) {
    Patches p;
    p.fill(periodic_patch());
    p[2] = wall_patch();
    p[3] = velocity_patch(top);
    return p;
}

/// Two cells along x and one along z, as wide as the mean cell along y, so that delta shrinks with the
/// spacing.
meshing::RectilinearGrid column(const meshing::Axis& y) {
    const double h = y.length() / static_cast<double>(y.cells());
    meshing::RectilinearGrid grid;
    grid.axes = {meshing::uniform_axis(0, 2 * h, 2), y, meshing::uniform_axis(0, h, 1)};
    return grid;
}

void march(Solver& solver, double dt, int steps) {
    for (int s = 0; s < steps; ++s) solver.step(dt);
    ASSERT_EQ(solver.first_bad_cell(), solver.grid().view().layout.cells());
}

double largest_error(const Solver& solver, int c, const std::function<double(const Vec3d&)>& exact) {
    const auto value = field(solver, c);
    double worst = 0;
    for (std::size_t i = 0; i < value.size(); ++i)
        worst = std::max(worst, std::abs(value[i] - exact(solver.centre(i))));
    return worst;
}

class CouetteFlow : public ::testing::TestWithParam<Scheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, CouetteFlow,
                         ::testing::Values(Scheme::euler, Scheme::rk4, Scheme::factored));

TEST_P(CouetteFlow, SteadyErrorIsRounding) {
    constexpr double wall = 0.1;
    for (const bool stretched : {false, true}) {
        const auto y = stretched ? meshing::plateau_axis(0, 1, 12, 4, 0.4) : meshing::uniform_axis(0, 1, 12);
        SolverOptions o;
        o.nu = 0.3;
        o.scheme = GetParam();
        Solver solver(column(y), channel([](const Vec3d&) { return Vec3d{wall, 0, 0}; }), o);
        const double dt = 0.5 * stable_step(solver.grid(), o.scheme, o.nu, wall);
        march(solver, dt, static_cast<int>(4.0 / (o.nu * dt)));
        const double error = largest_error(solver, 1, [](const Vec3d& x) { return wall * x.y; }) / wall;
        std::printf("Couette, scheme %d, %s: largest error / U = %.2e\n", static_cast<int>(o.scheme),
                    stretched ? "plateau" : "uniform", error);
        EXPECT_LT(error, 1e-12);
    }
}

class PoiseuilleFlow : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Grids, PoiseuilleFlow, ::testing::Bool());

TEST_P(PoiseuilleFlow, SecondOrder) {
    constexpr double nu = 0.2, peak = 0.05, drive = 8 * nu * peak;  // f = 8 mu u_max / h^2
    ConvergenceTable table(GetParam() ? "Poiseuille, plateau grid" : "Poiseuille, uniform grid");
    double order = 0;
    for (const int n : {16, 32, 64}) {
        // The plateau's shape is kept while cells shrink, so that the grids are refinements of one mapping.
        const auto y =
            GetParam() ? meshing::plateau_axis(0, 1, n, n / 4.0, 4.0 / n) : meshing::uniform_axis(0, 1, n);
        SolverOptions o;
        o.nu = nu;
        o.with_force = true;
        o.uniform_force[0] = drive / 2;  // the other half comes from the field: both act alike
        o.scheme = Scheme::factored;
        Solver solver(column(y), channel([](const Vec3d&) { return Vec3d{0, 0, 0}; }), o);
        solver.state().set_interior(solver.state().view().force[0],
                                    std::vector<double>(solver.grid().view().layout.cells(), drive / 2));
        const double dt = stable_step(solver.grid(), o.scheme, nu, peak);
        march(solver, dt, static_cast<int>(4.0 / (nu * dt)));
        order = table.add(1.0 / n,
                          relative_l2(solver, 1, [](const Vec3d& x) { return 4 * peak * x.y * (1 - x.y); }));
    }
    EXPECT_GE(order, 1.95);
}

// Preconditioning changes the way to the steady state, not the state: the error is that of gamma = 1 (5.35e-3).
TEST(PreconditionedPoiseuille, HasTheSameSteadyState) {
    constexpr double nu = 0.2, peak = 0.01;
    for (const Scheme scheme : {Scheme::euler, Scheme::rk4, Scheme::factored})
        for (const double gamma : {0.5, 0.2}) {
            SolverOptions o;
            o.nu = nu;
            o.gamma = gamma;
            o.with_force = true;
            o.uniform_force[0] = 8 * nu * peak;
            o.scheme = scheme;
            Solver solver(column(meshing::uniform_axis(0, 1, 16)), channel([](const Vec3d&) {
                              return Vec3d{0, 0, 0};
                          }),
                          o);
            const double dt = 0.9 * stable_step(solver.grid(), scheme, nu, peak, gamma);
            march(solver, dt, static_cast<int>(4 * gamma / (nu * dt)) + 1);
            const double error =
                relative_l2(solver, 1, [](const Vec3d& x) { return 4 * peak * x.y * (1 - x.y); });
            EXPECT_NEAR(error, 5.35e-3, 2e-4) << static_cast<int>(scheme) << " " << gamma;
        }
}

/// Runs a Taylor-Green vortex to `end` decay times with a fixed step and returns the solver.
std::unique_ptr<Solver> decay(const TaylorGreen& flow, const meshing::RectilinearGrid& grid, double end,
                              int steps) {
    SolverOptions o;
    o.nu = flow.nu;
    Patches p;
    p.fill(periodic_patch());
    auto solver = std::make_unique<Solver>(grid, p, o);
    solver->initialise([&](const Vec3d& x) { return flow.at(x, 0); });
    for (int s = 0; s < steps; ++s) solver->step(end * flow.decay_time() / steps);
    return solver;
}

TEST(TaylorGreenVortex, SecondOrderInSpace) {
    // Diffusive scaling as in Table 3.10: the Mach number falls with the spacing, so that compressibility
    // errors do too.
    ConvergenceTable table("Taylor-Green, Re 10, error of u at t = t_d");
    double order = 0;
    for (const int n : {16, 32, 64}) {
        const double u0 = 0.01 * 64 / n;
        const TaylorGreen flow{1, u0, u0 / 10};
        const int steps = static_cast<int>(flow.decay_time() * n / 1.0) + 1;
        const auto solver = decay(flow, square(n, 1), 1, steps);
        order = table.add(1.0 / n, relative_l2(*solver, 1, [&](const Vec3d& x) {
                              return flow.at(x, flow.decay_time()).velocity.x;
                          }));
    }
    EXPECT_GE(order, 1.95);
}

TEST(TaylorGreenVortex, FourthOrderInTime) {
    // Against the same grid with a much smaller step, so that only the time error is seen (Table 3.12).
    const TaylorGreen flow{1, 0.1, 0.01};
    const auto grid = square(24, 1);
    const double span = 0.05;
    const auto reference = field(*decay(flow, grid, span, 640), 1);
    ConvergenceTable table("Taylor-Green, RK4, time error");
    double order = 0;
    for (const int steps : {4, 8, 16}) {
        const auto u = field(*decay(flow, grid, span, steps), 1);
        double error = 0, norm = 0;
        for (std::size_t i = 0; i < u.size(); ++i) {
            error += (u[i] - reference[i]) * (u[i] - reference[i]);
            norm += reference[i] * reference[i];
        }
        order = table.add(1.0 / steps, std::sqrt(error / norm));
    }
    EXPECT_GE(order, 3.9);
}

}  // namespace
}  // namespace hemoflux::fluid::test

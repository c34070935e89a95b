#include "fluid/solver.hpp"

#include <gtest/gtest.h>

#include <random>

#include "exchange/error.hpp"
#include "flows.hpp"

namespace hemoflux::fluid {
namespace {

meshing::RectilinearGrid plateau_box() {
    meshing::RectilinearGrid grid;
    grid.axes.fill(meshing::plateau_axis(-6, 6, 10, 3, 0.4));
    return grid;
}

}  // namespace

// Shear box with a given velocity on all six faces and a swirling start: mass is kept to rounding, without a
// correction.
TEST(Solver, ClosedDomainKeepsItsMass) {
    for (const Scheme scheme : {Scheme::euler, Scheme::rk4, Scheme::factored}) {
        Patches p;
        p.fill(velocity_patch([](const Vec3d& x) { return Vec3d{0.005 * x.y, 0, 0}; }));
        SolverOptions o;
        o.nu = 0.2;
        o.scheme = scheme;
        o.with_force = true;
        Solver solver(plateau_box(), p, o);
        solver.initialise([](const Vec3d& x) {
            return FlowPoint{1 + 0.001 * x.x, {0.005 * x.y, 0.01 * std::sin(x.x), 0.01 * std::cos(x.y)}};
        });
        std::vector<double> f(solver.grid().view().layout.cells(), 1e-4);
        f[f.size() / 2] = 0.01;
        solver.state().set_interior(solver.state().view().force[1], f);
        const double before = solver.mean_density();
        const double dt = 0.5 * stable_step(solver.grid(), scheme, o.nu, 0.03);
        for (int s = 0; s < 300; ++s) solver.step(dt);
        EXPECT_EQ(solver.first_bad_cell(), solver.grid().view().layout.cells());
        EXPECT_NEAR(solver.mean_density(), before, 1e-13);
    }
}

TEST(Solver, FactoredAndExplicitReachTheSameSteadyState) {
    Patches p;
    p.fill(wall_patch());
    p[3] = velocity_patch([](const Vec3d& x) { return Vec3d{0.05 * (36 - x.x * x.x) / 36, 0, 0}; });
    std::vector<double> u[2];
    for (const Scheme scheme : {Scheme::rk4, Scheme::factored}) {
        SolverOptions o;
        o.nu = 1;
        o.scheme = scheme;
        Solver solver(plateau_box(), p, o);
        const double dt = 0.8 * stable_step(solver.grid(), scheme, o.nu, 0.1);
        for (double t = 0; t < 400; t += dt) solver.step(dt);
        u[scheme == Scheme::factored] = test::field(solver, 1);
    }
    double worst = 0;
    for (std::size_t i = 0; i < u[0].size(); ++i) worst = std::max(worst, std::abs(u[0][i] - u[1][i]));
    EXPECT_LT(worst, 1e-8);
}

TEST(Solver, BadCellIsFoundByIndex) {
    Patches p;
    p.fill(periodic_patch());
    SolverOptions o;
    o.nu = 0.1;
    Solver solver(plateau_box(), p, o);
    EXPECT_EQ(solver.first_bad_cell(), 1000u);
    auto w = test::field(solver, 3);
    w[678] = std::nan("");
    solver.state().set_interior(solver.state().view().q[3], w);
    EXPECT_EQ(solver.first_bad_cell(), 678u);
    EXPECT_TRUE(std::isnan(solver.largest_speed()));
}

TEST(Solver, RefusesImpossibleOptions) {
    Patches p;
    p.fill(periodic_patch());
    SolverOptions o;
    EXPECT_THROW(Solver(plateau_box(), p, o), InputError);
    o.nu = 0.1;
    o.gamma = 0;
    EXPECT_THROW(Solver(plateau_box(), p, o), InputError);
}

TEST(Solver, OffersItsFields) {
    Patches p;
    p.fill(periodic_patch());
    SolverOptions o;
    o.nu = 0.1;
    o.with_force = o.with_viscosity = true;
    Solver solver(plateau_box(), p, o);
    exchange::FieldTable table;
    solver.offer(table);
    EXPECT_EQ(table.read("fluid.velocity", exchange::Shape::vector, "c").component[0],
              solver.state().view().q[1]);
    EXPECT_EQ(table.list().size(), 4u);
}

}  // namespace hemoflux::fluid

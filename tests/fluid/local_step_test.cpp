#include "fluid/local_step.hpp"

#include <gtest/gtest.h>

#include "flows.hpp"

namespace hemoflux::fluid {
namespace {

/// A cubic cavity on a stretched grid whose lid moves along x.
Solver cavity(double lid, double reynolds, double gamma, std::size_t n) {
    meshing::RectilinearGrid grid;
    for (auto& axis : grid.axes)
        axis = meshing::plateau_axis(0, 1, static_cast<int>(n), static_cast<double>(n) / 4,
                                     4.0 / static_cast<double>(n));
    Patches p;
    p.fill(wall_patch());
    p[3] = velocity_patch([lid](const Vec3d&) { return Vec3d{lid, 0, 0}; });
    SolverOptions o;
    o.nu = lid / reynolds;
    o.gamma = gamma;
    return Solver(grid, p, o);
}

std::vector<double> local_steps_of(const Solver& solver) {
    exchange::Buffer<double> dt(solver.cells());
    solver.read_local_steps(dt.data());
    return dt.to_host();
}

}  // namespace

// (2.55)-(2.58) written out, on a stretched grid with flow in all directions; gamma = 1 has the radii |u| + c_s.
TEST(LocalStep, FollowsTheFormula) {
    constexpr double sigma = 1.5, weight = 4;
    for (const double gamma : {1.0, 0.2}) {
        Solver solver = cavity(0.1, 100, gamma, 6);
        const auto flow = [](const Vec3d& x) { return FlowPoint{1, {0.1 * x.y, -0.2 * x.x, 0.05 * x.z}}; };
        solver.initialise(flow);
        solver.set_local_steps(sigma, weight);
        const auto dt = local_steps_of(solver);
        for (std::size_t i = 0; i < dt.size(); ++i) {
            const std::size_t index[3] = {i % 6, i / 6 % 6, i / 36};
            const Vec3d v = flow(solver.centre(i)).velocity;
            const double u[3] = {v.x, v.y, v.z}, volume = solver.volume(i), nu = solver.options().nu;
            double convective = 0, viscous = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                const double area = volume / solver.grid().rectilinear().axes[a].widths()[index[a]];
                const double root = std::sqrt(u[a] * u[a] * (1 - gamma) + gamma * gamma / 3);
                convective += (std::abs(u[a]) + root) / gamma * area;
                viscous += 2 * nu * area * area / (gamma * volume);
            }
            EXPECT_NEAR(dt[i], sigma * volume / (convective + weight * viscous), 1e-13);
        }
    }
}

// A direction one cell thick adds nothing: the step of a flat cell does not depend on its thickness.
TEST(LocalStep, IgnoresAThinDirection) {
    std::vector<double> dt;
    for (const double thickness : {1.0, 1e-3}) {
        meshing::RectilinearGrid grid;
        grid.axes = {meshing::uniform_axis(0, 1, 4), meshing::uniform_axis(0, 1, 4),
                     meshing::uniform_axis(0, thickness, 1)};
        Patches p;
        p.fill(periodic_patch());
        SolverOptions o;
        o.nu = 0.1;
        Solver solver(grid, p, o);
        solver.set_local_steps(1, 4);
        dt.push_back(local_steps_of(solver)[5]);
    }
    EXPECT_EQ(dt[0], dt[1]);
}

TEST(LocalStep, NeedsSteps) {
    Solver solver = cavity(0.1, 100, 1, 6);
    EXPECT_THROW(solver.local_step(), std::logic_error);
}

// Steps of their own change the way, not the end: the steady cavity is that of one step for all cells.
TEST(LocalStep, SteadyStateOfGlobalSteps) {
    constexpr double lid = 0.1;
    for (const double gamma : {1.0, 0.3}) {
        Solver local = cavity(lid, 20, gamma, 8), global = cavity(lid, 20, gamma, 8);
        const double dt = 0.9 * stable_step(global.grid(), Scheme::rk4, global.options().nu, lid, gamma);
        int steps[2] = {0, 0};
        for (; steps[0] < 20000; ++steps[0]) {
            local.set_local_steps(2, 4);
            local.local_step();
            if (local.residual_norm().momentum[0] < 1e-11) break;
        }
        for (; steps[1] < 20000; ++steps[1]) {
            global.step(dt);
            if (global.residual_norm().momentum[0] < 1e-11) break;
        }
        std::printf("gamma %g: %d iterations with local steps, %d with one step\n", gamma, steps[0],
                    steps[1]);
        EXPECT_GT(local.largest_speed(), 0.4 * lid);
        EXPECT_LT(test::largest_difference(local, global), 1e-8);
    }
}

}  // namespace hemoflux::fluid

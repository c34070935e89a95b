#include "fluid/steady.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exchange/backend.hpp"
#include "exchange/error.hpp"
#include "flows.hpp"
#include "fluid/probe.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::fluid {
namespace {

constexpr double lid = 0.05;

/// A cubic cavity whose lid moves along x.
Solver cavity(double reynolds, double gamma, int n, bool stretched = false) {
    meshing::RectilinearGrid grid;
    grid.axes.fill(stretched ? meshing::plateau_axis(0, 1, n, n / 4.0, 4.0 / n)
                             : meshing::uniform_axis(0, 1, n));
    Patches p;
    p.fill(wall_patch());
    p[3] = velocity_patch([](const Vec3d&) { return Vec3d{lid, 0, 0}; });
    SolverOptions o;
    o.nu = lid / reynolds;
    o.gamma = gamma;
    return Solver(grid, p, o);
}

}  // namespace

// Both ways end at the same flow; the implicit one needs at least five times fewer evaluations.
TEST(Steady, ImplicitAndLocalStepsAgree) {
    for (const double reynolds : {100.0, 400.0})
        for (const bool stretched : {false, true}) {
            Solver a = cavity(reynolds, 0.2, 10, stretched), b = cavity(reynolds, 0.2, 10, stretched);
            SteadyOptions o;
            o.tolerance = 1e-7;
            o.method = SteadyMethod::local_steps;
            const SteadyResult local = find_steady_state(a, o);
            o.method = SteadyMethod::newton;
            const SteadyResult newton = find_steady_state(b, o);
            ASSERT_EQ(local.end, SteadyEnd::converged);
            ASSERT_EQ(newton.end, SteadyEnd::converged);
            std::printf("Re %g, %s: %zu evaluations with local steps, %zu implicit\n", reynolds,
                        stretched ? "plateau" : "uniform", local.last.evaluations, newton.last.evaluations);
            EXPECT_GE(local.last.evaluations, 5 * newton.last.evaluations);
            EXPECT_GT(a.largest_speed(), 0.3 * lid);
            EXPECT_LT(test::largest_difference(a, b), 2e-4 * lid);
        }
}

// Preconditioning changes the way and, through the pressure's share in the flux, the discretisation error: the flows differ
// by less than the error itself, the distance to a grid with twice the cells.
TEST(Steady, PreconditionedFlowIsTheSameWithinTheDiscretisationError) {
    const auto probe = [](const Solver& s,
                          int n) {  // u on the vertical centreline, mean of the four cells around it
        std::vector<double> profile;
        const auto u = s.values(1);
        const auto m = static_cast<std::size_t>(n), h = m / 2;
        for (std::size_t j = 0; j < m; ++j) {
            double mean = 0;
            for (const std::size_t i : {h - 1, h})
                for (const std::size_t k : {h - 1, h}) mean += u[i + m * (j + m * k)] / 4;
            profile.push_back(mean / lid);
        }
        return profile;
    };
    SteadyOptions o;
    o.tolerance = 1e-8;
    std::vector<double> coarse[2], fine;
    for (const bool preconditioned : {false, true}) {
        Solver s = cavity(100, preconditioned ? 0.2 : 1, 12);
        ASSERT_EQ(find_steady_state(s, o).end, SteadyEnd::converged);
        coarse[preconditioned] = probe(s, 12);
    }
    Solver s = cavity(100, 1, 24);
    ASSERT_EQ(find_steady_state(s, o).end, SteadyEnd::converged);
    fine = probe(s, 24);
    double between = 0, error = 0;
    for (std::size_t j = 0; j < 12; ++j) {
        between = std::max(between, std::abs(coarse[0][j] - coarse[1][j]));
        error = std::max(error, std::abs(coarse[0][j] - (fine[2 * j] + fine[2 * j + 1]) / 2));
    }
    std::printf("gamma 0.2 against 1: %.4f of the lid's speed; 12 against 24 cells: %.4f\n", between, error);
    EXPECT_LT(between, error);
}

TEST(Steady, IsTheSameForAnyNumberOfThreads) {
    std::vector<double> u[2];
    for (const int threads : {1, 3}) {
        exchange::set_threads(threads);
        Solver s = cavity(100, 0.2, 18);
        SteadyOptions o;
        o.tolerance = 1e-3;
        ASSERT_EQ(find_steady_state(s, o).end, SteadyEnd::converged);
        u[threads == 3] = s.values(1);
    }
    exchange::set_threads(0);
    EXPECT_EQ(u[0], u[1]);
}

TEST(Steady, CriteriaAndHistory) {
    for (const SteadyCriterion criterion :
         {SteadyCriterion::momentum_x, SteadyCriterion::residual, SteadyCriterion::velocity_change}) {
        Solver s = cavity(50, 0.2, 8);
        SteadyOptions o;
        o.method = SteadyMethod::local_steps;
        o.criterion = criterion;
        o.tolerance = 1e-4;
        std::vector<SteadyRecord> history;
        const SteadyResult result = find_steady_state(s, o, [&](const SteadyRecord& r) {
            history.push_back(r);
            return true;
        });
        EXPECT_EQ(result.end, SteadyEnd::converged);
        ASSERT_EQ(history.size(), result.last.iteration);
        EXPECT_EQ(history.back().evaluations, 4 * history.size());
        EXPECT_LT(history.back().measure, o.tolerance);
        EXPECT_GE(history[history.size() - 2].measure, o.tolerance);
        if (criterion == SteadyCriterion::momentum_x) {
            EXPECT_EQ(history[0].measure, 1);
            EXPECT_DOUBLE_EQ(history.back().measure,
                             history.back().residual.momentum[0] / history[0].residual.momentum[0]);
        }
        if (criterion == SteadyCriterion::residual) {
            EXPECT_EQ(history[0].measure, 1);
        }
    }
}

TEST(Steady, EndsForEveryReason) {
    Solver s = cavity(50, 0.2, 8);
    SteadyOptions o;
    o.method = SteadyMethod::local_steps;
    o.most_iterations = 5;
    EXPECT_EQ(find_steady_state(s, o).end, SteadyEnd::most_iterations);
    EXPECT_EQ(find_steady_state(s, o, [](const SteadyRecord&) { return false; }).end, SteadyEnd::interrupted);
    o.most_iterations = 100000;
    o.patience = 50;
    o.tolerance = 1e-30;  // below rounding: the residual stops falling
    EXPECT_EQ(find_steady_state(s, o).end, SteadyEnd::stalled);
    o.tolerance = 0;
    EXPECT_THROW(find_steady_state(s, o), InputError);
    Solver unstable = cavity(50, 0.2, 8);
    o = SteadyOptions{};
    o.method = SteadyMethod::local_steps;
    o.sigma = 40;
    try {
        find_steady_state(unstable, o);
        FAIL() << "an unstable step must be found out";
    } catch (const NumericalError& e) {
        EXPECT_NE(std::string(e.what()).find("cell "), std::string::npos) << e.what();
    }
}

// Couette flow at Re = 1377 in a channel four cells long: viscosity works over thousands of acoustic times and continuity
// starts without a residual. The implicit steps once stalled here.
TEST(Steady, SlowShearLayerReachesTheExactFlow) {
    meshing::RectilinearGrid grid;
    grid.axes = {meshing::uniform_axis(0, 4.0, 4), meshing::uniform_axis(0, 60, 60),
                 meshing::uniform_axis(0, 1, 1)};
    Patches p;
    p.fill(periodic_patch());
    p[2] = wall_patch();
    p[3] = velocity_patch([](const Vec3d&) { return Vec3d{lid, 0, 0}; });
    SolverOptions o;
    o.nu = 60 * lid / 1377;
    Solver s(grid, p, o);
    SteadyOptions steady;
    steady.criterion = SteadyCriterion::residual;
    steady.tolerance = 1e-9;
    const SteadyResult result = find_steady_state(s, steady);
    ASSERT_EQ(result.end, SteadyEnd::converged);
    EXPECT_LT(result.last.evaluations, 100u);
    const auto u = s.values(1);
    for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(u[i], lid * s.centre(i).y / 60, 1e-7 * lid);
}

// A square cavity at Re = 1000 between Chebyshev points and one of uniform cells, from rest, with and without
// preconditioning.
TEST(Steady, SquareCavitiesFromRest) {
    for (const bool stretched : {false, true})
        for (const double gamma : {1.0, 0.2}) {
            meshing::RectilinearGrid grid;
            grid.axes.fill(stretched ? meshing::chebyshev_axis(0, 1, 40) : meshing::uniform_axis(0, 1, 40));
            grid.axes[2] = meshing::uniform_axis(0, 0.01, 1);
            Patches p;
            p.fill(wall_patch());
            p[3] = velocity_patch([](const Vec3d&) { return Vec3d{lid, 0, 0}; });
            p[4] = p[5] = periodic_patch();
            SolverOptions o;
            o.nu = lid / 1000;
            o.gamma = gamma;
            Solver s(grid, p, o);
            SteadyOptions steady;
            steady.tolerance = 1e-6;
            const SteadyResult result = find_steady_state(s, steady);
            std::printf("%s, gamma %g: %zu evaluations\n", stretched ? "Chebyshev" : "uniform", gamma,
                        result.last.evaluations);
            EXPECT_EQ(result.end, SteadyEnd::converged);
            EXPECT_LT(result.last.evaluations, 1500u);
        }
}

// A solution of a coarser grid saves part of the way to the same residual.
TEST(Steady, StartsFromACoarserGrid) {
    SteadyOptions o;
    o.tolerance = 1e-6;
    Solver coarse = cavity(400, 0.2, 10), fresh = cavity(400, 0.2, 20), carried = cavity(400, 0.2, 20);
    ASSERT_EQ(find_steady_state(coarse, o).end, SteadyEnd::converged);
    const SteadyResult from_rest = find_steady_state(fresh, o);
    const auto probe = make_probe(coarse);
    carried.initialise([&](const Vec3d& x) {
        const auto [density, u, v, w] = (*probe)(x);
        return FlowPoint{density, {u, v, w}};
    });
    carried.evaluate();
    const double start = carried.residual_norm().momentum[0];
    o.tolerance = fresh.residual_norm().momentum[0] / start;
    const SteadyResult from_coarse = find_steady_state(carried, o);
    std::printf("%zu evaluations from rest, %zu from the coarser grid\n", from_rest.last.evaluations,
                from_coarse.last.evaluations);
    EXPECT_LT(from_coarse.last.evaluations, from_rest.last.evaluations);
}

// A channel driven by a force that starts at rest.
TEST(Steady, ForcedChannel) {
    meshing::RectilinearGrid grid;
    grid.axes = {meshing::uniform_axis(0, 0.5, 4), meshing::uniform_axis(0, 1, 32),
                 meshing::uniform_axis(0, 0.1, 1)};
    Patches p;
    p.fill(periodic_patch());
    p[2] = p[3] = wall_patch();
    SolverOptions o;
    o.nu = 0.1;
    o.with_force = true;
    o.uniform_force[0] = 8 * o.nu * 0.01;
    Solver s(grid, p, o);
    SteadyOptions steady;
    steady.tolerance = 1e-9;
    const SteadyResult result = find_steady_state(s, steady);
    ASSERT_EQ(result.end, SteadyEnd::converged);
    EXPECT_LT(result.last.evaluations, 300u);
    const auto u = s.values(1);
    for (std::size_t i = 0; i < u.size(); ++i) {
        const double y = s.centre(i).y;
        EXPECT_NEAR(u[i], 0.04 * y * (1 - y), 3e-3 * 0.01) << y;
    }
}

}  // namespace hemoflux::fluid

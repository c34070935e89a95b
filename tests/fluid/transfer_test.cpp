#include "fluid/transfer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "exchange/error.hpp"
#include "fluid/solver.hpp"
#include "fluid/steady.hpp"

namespace hemoflux::fluid {
namespace {

Solver cavity(int n) {
    meshing::RectilinearGrid grid;
    grid.axes.fill(meshing::uniform_axis(0, 1, n));
    Patches p;
    p.fill(wall_patch());
    p[3] = velocity_patch([](const Vec3d&) { return Vec3d{0.05, 0, 0}; });
    SolverOptions o;
    o.nu = 0.05 / 400;
    o.gamma = 0.2;
    return Solver(grid, p, o);
}

}  // namespace

// The eight nearest points by bins are those found by looking at all of them, on clustered points and far outside too.
TEST(PointFlow, AveragesTheNearestPoints) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<Vec3d> points;
    std::vector<FlowPoint> values;
    for (int i = 0; i < 500; ++i) {
        const double s = uniform(random);
        points.push_back({s * s * s, 10 * uniform(random), 0.1 * uniform(random)});
        values.push_back({1 + 0.1 * uniform(random), {uniform(random), 0, 0}});
    }
    const PointFlow flow(points, values);
    for (int t = 0; t < 200; ++t) {
        const Vec3d x{3 * uniform(random) - 1, 14 * uniform(random) - 2, uniform(random)};
        std::vector<std::pair<double, std::size_t>> all;
        for (std::size_t p = 0; p < points.size(); ++p) all.push_back({dot(points[p] - x, points[p] - x), p});
        std::sort(all.begin(), all.end());
        double u = 0, total = 0;
        for (std::size_t k = 0; k < 8; ++k) {
            u += values[all[k].second].velocity.x / all[k].first;
            total += 1 / all[k].first;
        }
        EXPECT_NEAR(flow(x).velocity.x, u / total, 1e-12);
    }
    EXPECT_EQ(flow(points[17]).density, values[17].density);
    EXPECT_THROW(PointFlow({}, {}), InputError);
    EXPECT_THROW(PointFlow(points, {}), InputError);
}

TEST(PointFlow, OnePlaneOfPoints) {
    const PointFlow flow({{0, 0, 5}, {1, 0, 5}}, {{1, {1, 2, 3}}, {1, {3, 2, 1}}});
    EXPECT_NEAR(flow({0.5, 0, 0}).velocity.x, 2, 1e-15);
    EXPECT_NEAR(flow({0.5, 0, 0}).velocity.z, 2, 1e-15);
}

// A solution of a coarser grid saves part of the way to the same residual.
TEST(PointFlow, StartsASteadyRun) {
    SteadyOptions o;
    o.tolerance = 1e-6;
    Solver coarse = cavity(10), fresh = cavity(20), carried = cavity(20);
    ASSERT_EQ(find_steady_state(coarse, o).end, SteadyEnd::converged);
    const SteadyResult from_rest = find_steady_state(fresh, o);
    carry_over(sample(coarse), carried);
    carried.evaluate();
    const double start = carried.residual_norm().momentum[0];
    o.tolerance = fresh.residual_norm().momentum[0] / start;
    const SteadyResult from_coarse = find_steady_state(carried, o);
    std::printf("%zu evaluations from rest, %zu from the coarser grid\n", from_rest.last.evaluations,
                from_coarse.last.evaluations);
    EXPECT_LT(from_coarse.last.evaluations, from_rest.last.evaluations);
}

}  // namespace hemoflux::fluid

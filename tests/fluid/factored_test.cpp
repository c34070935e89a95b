#include "fluid/factored.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "exchange/backend.hpp"
#include "fluid/factored_lines.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::fluid {
namespace {

/// (I - strength L) x on one line, written out from the definition in factored.hpp; with `sizes`, the sum of the sizes of
/// its terms, of which rounding takes its share.
std::vector<double> apply(const std::vector<double>& widths, double strength, double delta, bool periodic,
                          double ghost, const std::vector<double>& x, bool sizes) {
    const std::size_t n = x.size();
    std::vector<double> y(n);
    const double sign = sizes ? -1 : 1;
    if (sizes) ghost = 1;
    for (std::size_t i = 0; i < n; ++i) {
        const double below = sign * (i > 0 ? x[i - 1] : (periodic ? x[n - 1] : ghost * x[0]));
        const double above = sign * (i + 1 < n ? x[i + 1] : (periodic ? x[0] : ghost * x[n - 1]));
        const double s_minus = (widths[i + 1] + widths[i + 2]) / 2,
                     s_plus = (widths[i + 2] + widths[i + 3]) / 2;
        const auto stiff = [&](double s, double other) {  // s / (2 delta), at least 1
            return std::max(1.0, s / (2 * std::min({delta, widths[i + 2], other})));
        };
        y[i] = x[i] - strength *
                          (stiff(s_plus, widths[i + 3]) * (above - x[i]) / s_plus -
                           stiff(s_minus, widths[i + 1]) * (x[i] - below) / s_minus) /
                          widths[i + 2];
    }
    return y;
}

}  // namespace

// Solving the three factors and applying them again must give back dt R, for every kind of boundary, to the rounding of the
// terms that are summed on the way.
TEST(Factored, SolveInvertsTheProductOfTheFactors) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    for (const int kind : {0, 1, 2}) {
        Patches p;
        p.fill(kind == 0 ? periodic_patch() : kind == 1 ? wall_patch() : open_patch());
        if (kind == 2) p[2] = p[3] = symmetry_patch();
        meshing::RectilinearGrid rg;
        rg.axes = {meshing::uniform_axis(0, 1, 11), meshing::explicit_axis({0, 0.1, 0.3, 0.6, 1, 1.2}),
                   meshing::plateau_axis(0, 2, 9, 3, 0.5)};
        const double nu = 0.3, dt = 0.7;
        const Grid grid(rg, periodic_axes(p));
        const Boundary boundary(p, grid);
        State r(grid.view().layout, false, false, 0);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> noise(-1, 1);
        std::array<std::vector<double>, 4> rhs;
        for (int c = 0; c < 4; ++c) {
            for (std::size_t i = 0; i < grid.view().layout.cells(); ++i)
                rhs[static_cast<std::size_t>(c)].push_back(noise(random));
            r.set_interior(r.view().q[c], rhs[static_cast<std::size_t>(c)]);
        }
        const auto& q = r.view().q;
        Factored(grid, boundary, nu, dt).solve({{q[0], q[1], q[2], q[3]}});
        const auto& n = grid.view().layout.n;
        const std::size_t stride[3] = {1, n[0], n[0] * n[1]};
        for (int c = 1; c < 4; ++c) {
            const auto product = [&](std::vector<double> x, bool sizes) {
                for (std::size_t axis : {2u, 1u, 0u}) {
                    const bool normal = axis == static_cast<std::size_t>(c - 1);
                    const double ghost = kind == 1 || (kind == 2 && axis == 1 && normal) ? -1 : 1;
                    for (std::size_t start = 0; start < x.size(); ++start) {
                        if (start / stride[axis] % n[axis] != 0) continue;
                        std::vector<double> line(n[axis]);
                        for (std::size_t i = 0; i < n[axis]; ++i) line[i] = x[start + i * stride[axis]];
                        line =
                            apply(grid.ghosted_widths(static_cast<int>(axis)), dt * nu * (normal ? 2 : 1),
                                  grid.smallest_delta(static_cast<int>(axis)), kind == 0, ghost, line, sizes);
                        for (std::size_t i = 0; i < n[axis]; ++i) x[start + i * stride[axis]] = line[i];
                    }
                }
                return x;
            };
            auto solution = r.interior(q[c]);
            const auto back = product(solution, false);
            for (double& x : solution) x = std::abs(x);
            const auto size = product(solution, true);
            for (std::size_t i = 0; i < back.size(); ++i) {
                ASSERT_NEAR(back[i], dt * rhs[static_cast<std::size_t>(c)][i], 4 * epsilon * size[i])
                    << kind << " " << c << " " << i;
            }
        }
    }
}

TEST(Factored, ShortPeriodicLines) {
    for (const std::size_t n : {1u, 2u, 3u}) {
        const std::vector<double> widths(n + 4, 0.5);
        const HostLine line = factor_line(line_operator(widths, 2, 0.8, 0.25, true, 1, 1));
        std::vector<double> x(n, 1.0);  // a constant is in the kernel of L
        double previous = 0;
        for (std::size_t i = 0; i < n; ++i)
            previous = x[i] = (x[i] - line.lower[i] * previous) * line.pivot[i];
        for (std::size_t i = n - 1; i-- > 0;) x[i] -= line.upper[i] * x[i + 1];
        const double correction = (x[0] + line.cyclic_last * x[n - 1]) * line.cyclic_scale;
        for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(x[i] - correction * line.cyclic[i], 1.0, 1e-14) << n;
    }
}

// The long step of implicit density keeps the mass of a closed, stretched box to rounding and ends in the same cavity flow.
TEST(Factored, LongStepsKeepMassAndSteadyState) {
    meshing::RectilinearGrid rg;
    exchange::set_threads(1);  // the box is small
    rg.axes = {meshing::plateau_axis(0, 6, 6, 2, 0.3), meshing::uniform_axis(0, 5, 5),
               meshing::uniform_axis(0, 5, 5)};
    Patches p;
    p.fill(wall_patch());
    p[3] = velocity_patch([](const Vec3d&) { return Vec3d{0.05, 0, 0}; });
    SolverOptions o;
    o.nu = 0.5;
    o.scheme = Scheme::factored;
    std::vector<std::vector<double>> ends;
    for (const double cells_per_step : {0.8, 2.0}) {
        Solver solver(rg, p, o);
        const double dt = cells_per_step * rg.smallest();
        for (int s = 0; s < static_cast<int>(300 / dt); ++s) solver.step(dt);
        EXPECT_NEAR(solver.mean_density(), 1, 1e-12);
        ends.push_back(solver.values(1));
        const auto density = solver.values(0);
        ends.back().insert(ends.back().end(), density.begin(), density.end());
    }
    double largest = 0;
    for (std::size_t i = 0; i < ends[0].size(); ++i)
        largest = std::max(largest, std::abs(ends[0][i] - ends[1][i]));
    EXPECT_LT(largest, 1e-9);
    EXPECT_NE(ends[0], ends[1]);
    exchange::set_threads(0);
}

}  // namespace hemoflux::fluid

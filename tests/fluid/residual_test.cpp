#include "fluid/residual.hpp"

#include <gtest/gtest.h>

#include <random>

#include "exchange/backend.hpp"
#include "flows.hpp"

namespace hemoflux::fluid {
namespace {

/// Cells of one width, of one width per axis, or of any widths.
enum class Cells { cubes, boxes, stretched };

struct Case {
    std::array<int, 3> n;
    Cells cells;
    bool force, viscosity;
    double gamma;
};

meshing::RectilinearGrid grid_of(const Case& c) {
    meshing::RectilinearGrid grid;
    for (std::size_t a = 0; a < 3; ++a) {
        if (c.cells == Cells::cubes) grid.axes[a] = meshing::uniform_axis(-1, -1 + 0.2 * c.n[a], c.n[a]);
        if (c.cells == Cells::boxes)
            grid.axes[a] = meshing::uniform_axis(-1, 1 + 0.2 * static_cast<double>(a), c.n[a]);
        if (c.cells == Cells::stretched)
            grid.axes[a] = meshing::plateau_axis(-1, 1, c.n[a], c.n[a] / 3.0, 0.3);
    }
    return grid;
}

/// A random smooth-free state on a grid with mixed boundary conditions, ghosts filled.
struct Trial {
    Patches patches;
    Grid grid;
    Boundary boundary;
    State state, out;
    FlowParameters parameters;

    static Patches mixed() {
        Patches p;
        p.fill(periodic_patch());
        p[0] = velocity_patch([](const Vec3d& x) { return Vec3d{0.01 * x.y, 0.02, 0}; });
        p[1] = density_patch(1.01);
        p[2] = wall_patch();
        p[3] = symmetry_patch();
        return p;
    }
    explicit Trial(const Case& c)
        : patches(mixed()),
          grid(grid_of(c), periodic_axes(patches)),
          boundary(patches, grid),
          state(grid.view().layout, c.force, c.viscosity, 0.1),
          out(grid.view().layout, false, false, 0),
          parameters{0.1, c.gamma, {0.01, -0.02, 0.03}, c.force, c.viscosity} {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> noise(-0.05, 0.05);
        const auto values = [&](double mean, double scale) {
            std::vector<double> v(grid.view().layout.cells());
            for (double& x : v) x = mean + scale * noise(random);
            return v;
        };
        const StateView& s = state.view();
        for (int k = 0; k < 4; ++k) state.set_interior(s.q[k], values(k == 0 ? 1 : 0, 1));
        if (c.force)
            for (double* f : s.force) state.set_interior(f, values(0, 0.1));
        if (c.viscosity) state.set_interior(s.nu, values(0.1, 1));
        boundary.fill(grid.view(), s);
        if (c.force) boundary.fill_force(grid.view(), s);
        if (c.viscosity) boundary.fill_viscosity(grid.view(), s);
    }
    ResidualView view() const {
        const auto& q = out.view().q;
        return {{q[0], q[1], q[2], q[3]}};
    }
    std::vector<std::vector<double>> tiles() {
        evaluate_residual(grid.view(), state.view(), boundary.view(), parameters, view());
        return {out.interior(view().r[0]), out.interior(view().r[1]), out.interior(view().r[2]),
                out.interior(view().r[3])};
    }
    std::vector<std::vector<double>> cells() {
        evaluate_residual_by_cell(grid.view(), state.view(), boundary.view(), parameters, view());
        return {out.interior(view().r[0]), out.interior(view().r[1]), out.interior(view().r[2]),
                out.interior(view().r[3])};
    }
};

void expect_close(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
    for (std::size_t c = 0; c < 4; ++c) {
        double scale = 0;
        for (const double x : b[c]) scale = std::max(scale, std::abs(x));
        for (std::size_t i = 0; i < a[c].size(); ++i)
            ASSERT_NEAR(a[c][i], b[c][i], 1e-12 * scale) << c << " " << i;
    }
}

}  // namespace

class ResidualOf : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Features, ResidualOf,
                         ::testing::Values(Case{{13, 7, 5}, Cells::boxes, false, false, 1},
                                           Case{{8, 9, 1}, Cells::boxes, true, false, 1},
                                           Case{{16, 17, 33}, Cells::stretched, false, true, 1},
                                           Case{{5, 20, 6}, Cells::stretched, true, true, 1},
                                           Case{{140, 3, 4}, Cells::stretched, true, false, 1},
                                           Case{{9, 6, 7}, Cells::boxes, true, true, 0.2},
                                           Case{{9, 6, 7}, Cells::stretched, true, true, 0.2},
                                           Case{{13, 7, 5}, Cells::cubes, false, false, 1},
                                           Case{{8, 9, 1}, Cells::cubes, true, false, 1},
                                           Case{{16, 43, 33}, Cells::cubes, false, true, 1},
                                           Case{{140, 3, 4}, Cells::cubes, true, true, 1},
                                           Case{{1, 22, 9}, Cells::cubes, false, false, 0.5},
                                           Case{{9, 6, 7}, Cells::cubes, true, true, 0.2}));

TEST_P(ResidualOf, TilesAgreeWithCells) {
    Trial s(GetParam());
    EXPECT_EQ(s.grid.view().delta > 0, GetParam().cells == Cells::cubes && GetParam().n[0] > 1);
    const auto cells = s.cells();
    expect_close(s.tiles(), cells);
}

TEST_P(ResidualOf, IsBitwiseTheSameForAnyNumberOfThreads) {
    Trial s(GetParam());
    exchange::set_threads(1);
    const auto one = s.tiles();
    for (const int threads : {2, 3, 7}) {
        exchange::set_threads(threads);
        EXPECT_EQ(s.tiles(), one) << threads;
    }
    exchange::set_threads(0);
}

TEST(Residual, UniformFlowIsPreserved) {
    for (const Cells cells : {Cells::cubes, Cells::boxes, Cells::stretched})
        for (const double gamma : {1.0, 0.1}) {
            Trial s(Case{{12, 10, 9}, cells, false, false, gamma});
            Patches p;
            p.fill(periodic_patch());
            p[2] = p[3] = velocity_patch([](const Vec3d&) { return Vec3d{0.05, -0.02, 0.03}; });
            const Boundary boundary(p, s.grid);
            const double value[4] = {1, 0.05, -0.02, 0.03};
            for (int c = 0; c < 4; ++c)
                s.state.set_interior(s.state.view().q[c],
                                     std::vector<double>(s.grid.view().layout.cells(), value[c]));
            Grid grid(s.grid.rectilinear(), periodic_axes(p));
            boundary.fill(grid.view(), s.state.view());
            evaluate_residual(grid.view(), s.state.view(), boundary.view(), s.parameters, s.view());
            for (int c = 0; c < 4; ++c)
                for (const double r : s.out.interior(s.view().r[c])) EXPECT_NEAR(r, 0, 1e-13);
        }
}

// The flux against the Navier-Stokes flux (2.2) of a quadratic velocity field, for which the truncation error
// of the momentum is of higher order: dQ/dt of momentum x must be nu laplace(u) for u = y^2 + z^2 in a slow
// flow.
TEST(Residual, ViscousTermOfAQuadraticProfile) {
    for (const Cells cells : {Cells::cubes, Cells::boxes, Cells::stretched}) {
        Case c{{8, 12, 10}, cells, false, false, 1};
        Trial s(c);
        const double scale = 1e-5;
        std::vector<double> u(s.grid.view().layout.cells()), zero(u.size(), 0.0), one(u.size(), 1.0);
        const auto& n = s.grid.view().layout.n;
        const auto y = s.grid.rectilinear().axes[1].centres(), z = s.grid.rectilinear().axes[2].centres();
        for (std::size_t i = 0; i < u.size(); ++i)
            u[i] = scale *
                   (y[i / n[0] % n[1]] * y[i / n[0] % n[1]] + z[i / (n[0] * n[1])] * z[i / (n[0] * n[1])]);
        s.state.set_interior(s.state.view().q[0], one);
        s.state.set_interior(s.state.view().q[1], u);
        s.state.set_interior(s.state.view().q[2], zero);
        s.state.set_interior(s.state.view().q[3], zero);
        s.boundary.fill(s.grid.view(), s.state.view());
        const auto r = s.tiles();
        for (std::size_t k = 3; k + 3 < n[2]; ++k)
            for (std::size_t j = 3; j + 3 < n[1]; ++j) {
                const std::size_t i = 4 + n[0] * (j + n[1] * k);
                EXPECT_NEAR(r[1][i], 4 * 0.1 * scale,
                            (cells == Cells::stretched ? 0.05 : 1e-6) * 4 * 0.1 * scale);
            }
    }
}

}  // namespace hemoflux::fluid

#include "coupling/viscosity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "exchange/backend.hpp"
#include "exchange/error.hpp"
#include "grids.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/spheroid.hpp"

using namespace hemoflux;
using namespace hemoflux::coupling;

namespace {

/// Several copies of a mesh, their vertices one after the other.
std::vector<Vec3d> copies(const meshing::SurfaceMesh& mesh, const std::vector<Vec3d>& at) {
    std::vector<Vec3d> points;
    for (const Vec3d& by : at)
        for (const Vec3d& p : mesh.vertices) points.push_back(p + by);
    return points;
}

double cell_volume(const meshing::RectilinearGrid& g, std::size_t i, std::size_t j, std::size_t k) {
    return g.axes[0].widths()[i] * g.axes[1].widths()[j] * g.axes[2].widths()[k];
}

/// Volume in which nu has risen from `outside` towards `inside`.
double inside_volume(const meshing::RectilinearGrid& grid, const exchange::Layout& layout,
                     const std::vector<double>& nu, double inside, double outside) {
    double volume = 0;
    for (std::size_t k = 0; k < layout.n[2]; ++k)
        for (std::size_t j = 0; j < layout.n[1]; ++j)
            for (std::size_t i = 0; i < layout.n[0]; ++i)
                volume +=
                    cell_volume(grid, i, j, k) *
                    (nu[layout.at(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k))] - outside) /
                    (inside - outside);
    return volume;
}

}  // namespace

TEST(Viscosity, HeavisideOfTheThesis) {
    EXPECT_EQ(heaviside(-1), 0);
    EXPECT_EQ(heaviside(1), 1);
    EXPECT_EQ(heaviside(2), 1);
    EXPECT_DOUBLE_EQ(heaviside(0), 0.5);
    EXPECT_DOUBLE_EQ(heaviside(0.5), 0.75 + 0.5 / std::acos(-1.0));
    for (double r = 0; r < 1; r += 0.01) EXPECT_NEAR(heaviside(r) + heaviside(-r), 1, 1e-15);
    EXPECT_NEAR(heaviside(1 - 1e-4), 1, 1e-11);
}

TEST(Viscosity, VolumeInsideIsThatOfTheSurface) {
    const auto grid = test::tank_treading_grid();
    const CellGrid cells(grid, {true, false, true});
    const auto layout = cells.view().layout;
    const auto sphere = meshing::icosphere(4, 1.0);
    for (const auto& mesh : {meshing::icosphere(4, 2.5), meshing::spheroid(sphere, 3.5, 2.5, 1.5),
                             meshing::evans_fung(sphere)}) {
        InteriorViscosity viscosity(cells, mesh.triangles, mesh.vertices.size(), {0.27}, 1.0);
        exchange::Buffer<double> nu(layout.size);
        const test::Points p(mesh.vertices);
        EXPECT_TRUE(viscosity.update(p[0], p[1], p[2], nu.data()));
        EXPECT_NEAR(inside_volume(grid, layout, nu.to_host(), 0.27, 1.0), volume(mesh), 0.01 * volume(mesh));
    }
}

// The proposal of section 7.6: the integral of the added viscosity over the band is surface viscosity times area.
TEST(Viscosity, SurfaceViscosityIsLentToTheCellsThatTheMembraneCrosses) {
    const auto axis =
        meshing::plateau_axis(-6, 6, 30, 10, 0.2);  // the sphere reaches into its stretched part
    const meshing::RectilinearGrid grid{{axis, axis, axis}};
    const CellGrid cells(grid, {true, false, true});
    const auto layout = cells.view().layout;
    const double surface_nu = 0.4;
    for (const double radius : {2.0, 3.2}) {
        const auto mesh = meshing::icosphere(4, radius);
        InteriorViscosity viscosity(cells, mesh.triangles, mesh.vertices.size(), {1.0}, 1.0, {}, {},
                                    surface_nu);
        exchange::Buffer<double> nu(layout.size);
        const test::Points p(mesh.vertices);
        viscosity.update(p[0], p[1], p[2], nu.data());
        const auto host = nu.to_host();
        const double expected = surface_nu * 4 * std::acos(-1.0) * radius * radius;
        EXPECT_NEAR(inside_volume(grid, layout, host, 2.0, 1.0), expected, 0.05 * expected) << radius;
        EXPECT_EQ(host[layout.at(15, 15, 15)], 1.0);
        EXPECT_EQ(host[layout.at(0, 0, 0)], 1.0);
    }
    const auto mesh = meshing::icosphere(2, 2.0);
    EXPECT_THROW(InteriorViscosity(cells, mesh.triangles, mesh.vertices.size(), {1.0}, 1.0, {}, {}, -1),
                 InputError);
}

// Two cells with their own viscosity, one of them across the corner of the periodic box.
TEST(Viscosity, EveryCellHasItsOwn) {
    const auto axis = meshing::uniform_axis(-6, 6, 32);
    const meshing::RectilinearGrid grid{{axis, axis, axis}};
    const CellGrid cells(grid, {true, true, true});
    const auto layout = cells.view().layout;
    const auto mesh = meshing::icosphere(3, 2.0);
    const std::vector<Vec3d> at{{0.1, 0, 0}, {6, -6, 18}};
    InteriorViscosity viscosity(cells, mesh.triangles, mesh.vertices.size(), {5.0, 0.5}, 1.0);
    const test::Points p(copies(mesh, at));
    const double untouched = -7;
    exchange::Buffer<double> nu(std::vector<double>(layout.size, untouched));
    viscosity.update(p[0], p[1], p[2], nu.data());
    const auto host = nu.to_host();
    const auto value = [&](int i, int j, int k) { return host[layout.at(i, j, k)]; };
    EXPECT_DOUBLE_EQ(value(16, 16, 16), 5.0);
    EXPECT_DOUBLE_EQ(value(16 + 4, 16, 16), 5.0);
    EXPECT_DOUBLE_EQ(value(0, 0, 0), 0.5);
    EXPECT_DOUBLE_EQ(value(31, 0, 31), 0.5);
    EXPECT_DOUBLE_EQ(value(28, 31, 0), 0.5);
    EXPECT_DOUBLE_EQ(value(8, 16, 16), 1.0);
    EXPECT_DOUBLE_EQ(value(0, 0, 16), 1.0);
    EXPECT_EQ(host[layout.at(-1, 3, 3)], untouched);  // ghosts belong to the fluid
    double sum = 0;
    for (int k = 0; k < 32; ++k)
        for (int j = 0; j < 32; ++j)
            for (int i = 0; i < 32; ++i) sum += (value(i, j, k) - 1.0) * std::pow(12.0 / 32, 3);
    // smoothing over the curved surface adds 3 sigma^2/R^2, sigma^2 = h^2 (1/3 - 2/pi^2) the variance of H'
    const double h = 12.0 / 32, variance = h * h * (1.0 / 3 - 2 / std::pow(std::acos(-1.0), 2));
    const double expected = (4.0 - 0.5) * volume(mesh) * (1 + 3 * variance / 4);
    EXPECT_NEAR(sum, expected, 0.001 * expected);
}

// The field is recomputed after motion along the normal or far along the surface, and not before.
TEST(Viscosity, RecomputesOnlyAfterMotionThatMatters) {
    const auto axis = meshing::uniform_axis(-3, 3, 20);
    const CellGrid cells({{axis, axis, axis}}, {false, false, false});
    const double h = 0.3;
    const auto mesh = meshing::icosphere(3, 2.0);
    const auto rotated = [&](double angle) {
        std::vector<Vec3d> out;
        for (const Vec3d& p : mesh.vertices)
            out.push_back({std::cos(angle) * p.x - std::sin(angle) * p.y,
                           std::sin(angle) * p.x + std::cos(angle) * p.y, p.z});
        return out;
    };
    InteriorViscosity viscosity(cells, mesh.triangles, mesh.vertices.size(), {2.0}, 1.0);
    exchange::Buffer<double> nu(cells.view().layout.size);
    const auto update = [&](const std::vector<Vec3d>& points) {
        const test::Points p(points);
        return viscosity.update(p[0], p[1], p[2], nu.data());
    };
    const auto base = mesh.vertices;
    EXPECT_TRUE(viscosity.positions()[0].empty());
    EXPECT_TRUE(update(base));
    EXPECT_FALSE(update(base));
    EXPECT_FALSE(update(copies(mesh, {{0.04 * h, 0, 0}})));
    EXPECT_FALSE(update(rotated(0.4 * h / 2)));
    EXPECT_TRUE(update(rotated(0.6 * h / 2)));
    EXPECT_TRUE(update(base));
    EXPECT_TRUE(update(copies(mesh, {{0.06 * h, 0, 0}})));
    EXPECT_EQ(viscosity.recomputations(), 4u);
    EXPECT_NEAR(viscosity.positions()[0][5], base[5].x + 0.06 * h, 1e-15);
    auto broken = base;
    broken[7].y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(update(broken));  // must neither be skipped nor crash
}

// What a skipped update leaves stale stays within the stated bound, (normal + total^2 h kappa / 2) of d/h.
TEST(Viscosity, SkippedUpdatesStayWithinTheStatedBound) {
    const auto axis = meshing::uniform_axis(-3, 3, 20);
    const CellGrid cells({{axis, axis, axis}}, {false, false, false});
    const double h = 0.3, radius = 2.0, angle = 0.45 * h / radius;
    const auto mesh = meshing::icosphere(3, radius);
    std::vector<Vec3d> later;
    for (const Vec3d& p : mesh.vertices)
        later.push_back({std::cos(angle) * p.x - std::sin(angle) * p.y + 0.03 * h,
                         std::sin(angle) * p.x + std::cos(angle) * p.y, p.z});
    const test::Points before(mesh.vertices), after(later);
    InteriorViscosity viscosity(cells, mesh.triangles, mesh.vertices.size(), {2.0}, 1.0);
    exchange::Buffer<double> nu(cells.view().layout.size);
    viscosity.update(before[0], before[1], before[2], nu.data());
    ASSERT_FALSE(viscosity.update(after[0], after[1], after[2], nu.data()));
    const auto stale = nu.to_host();
    viscosity.recompute(after[0], after[1], after[2], nu.data());
    const auto fresh = nu.to_host();
    const MotionLimits limits;
    double largest = 0;
    for (std::size_t c = 0; c < fresh.size(); ++c)
        largest = std::max(largest, std::fabs(fresh[c] - stale[c]));
    EXPECT_LE(largest, limits.normal + limits.total * limits.total * h / radius / 2);
    EXPECT_GT(largest, 0.01);
}

// A run restarted from the positions of the last recomputation takes the same decisions and has the same
// field.
TEST(Viscosity, RestartIsBitwise) {
    const CellGrid cells(test::tank_treading_grid(), {true, false, true});
    const auto mesh = meshing::evans_fung(meshing::icosphere(3, 1.0));
    const std::size_t n = mesh.vertices.size(), size = cells.view().layout.size;
    const auto at = [&](int step) { return test::Points(copies(mesh, {{0.003 * step, 0.001 * step, 0}})); };
    InteriorViscosity whole(cells, mesh.triangles, n, {0.3}, 1.0);
    exchange::Buffer<double> nu(size), nu_restarted(size);
    std::vector<bool> decisions;
    std::array<std::vector<double>, 3> checkpoint;
    for (int step = 0; step < 40; ++step) {
        const auto p = at(step);
        decisions.push_back(whole.update(p[0], p[1], p[2], nu.data()));
        if (step == 17) checkpoint = whole.positions();
    }
    InteriorViscosity restarted(cells, mesh.triangles, n, {0.3}, 1.0);
    const exchange::Buffer<double> x(checkpoint[0]), y(checkpoint[1]), z(checkpoint[2]);
    restarted.recompute(x.data(), y.data(), z.data(), nu_restarted.data());
    std::size_t recomputed = 0;
    for (int step = 18; step < 40; ++step) {
        const auto p = at(step);
        const bool did = restarted.update(p[0], p[1], p[2], nu_restarted.data());
        EXPECT_EQ(did, decisions[static_cast<std::size_t>(step)]) << step;
        recomputed += did ? 1 : 0;
    }
    EXPECT_GT(recomputed, 1u);
    EXPECT_LT(recomputed, 20u);
    EXPECT_EQ(nu.to_host(), nu_restarted.to_host());
}

// Of three cells the slow one is measured seldom, and the field is always that of the positions last measured, also when
// the fast one grows out of the room it had.
TEST(Viscosity, EveryMembraneHasItsOwnTurn) {
    const auto axis = meshing::uniform_axis(-6, 6, 32);
    const CellGrid cells({{axis, axis, axis}}, {true, true, true});
    const auto mesh = meshing::icosphere(2, 1.5);
    const std::size_t n = mesh.vertices.size();
    const std::vector<double> nu_inside{5.0, 0.5, 2.0};
    InteriorViscosity viscosity(cells, mesh.triangles, n, nu_inside, 1.0);
    exchange::Buffer<double> nu(cells.view().layout.size), expected(cells.view().layout.size);
    std::size_t alone = 0;
    for (int step = 0; step < 30; ++step) {
        auto points = copies(mesh, {{-3, 0, 0}, {0.002 * step, 0.1, 4}, {3 + 0.1 * step, 3, -5}});
        for (std::size_t v = 2 * n; v < 3 * n; ++v) points[v].y += 0.03 * step * (points[v].y - 3);
        const test::Points p(points);
        const auto before = viscosity.positions();
        EXPECT_TRUE(viscosity.update(p[0], p[1], p[2], nu.data())) << step;
        const auto measured = viscosity.positions();
        EXPECT_EQ(measured[0][0], mesh.vertices[0].x - 3);
        EXPECT_EQ(measured[1][2 * n], points[2 * n].y) << step;
        if (step > 0 && measured[0][n] == before[0][n]) ++alone;
        InteriorViscosity fresh(cells, mesh.triangles, n, nu_inside, 1.0);
        const exchange::Buffer<double> x(measured[0]), y(measured[1]), z(measured[2]);
        fresh.recompute(x.data(), y.data(), z.data(), expected.data());
        ASSERT_EQ(nu.to_host(), expected.to_host()) << step;
    }
    EXPECT_GT(alone, 20u);
    EXPECT_LT(alone, 29u);
}

TEST(Viscosity, IsBitwiseTheSameForAnyNumberOfThreads) {
    const CellGrid cells(test::tank_treading_grid(), {true, true, true});
    const auto mesh = meshing::evans_fung(meshing::icosphere(2, 1.0));
    const test::Points p(copies(mesh, {{0, 0, 1}, {5, 0.5, -1.5}, {-1, 4, 3}}));
    std::vector<std::vector<double>> results;
    for (const int count : {1, 2, 3, 2}) {
        exchange::set_threads(count);
        InteriorViscosity viscosity(cells, mesh.triangles, mesh.vertices.size(), {0.3, 2.0, 5.0}, 1.0);
        exchange::Buffer<double> nu(cells.view().layout.size);
        viscosity.update(p[0], p[1], p[2], nu.data());
        results.push_back(nu.to_host());
    }
    exchange::set_threads(0);
    for (const auto& r : results) EXPECT_EQ(r, results[0]);
}

TEST(Viscosity, MustBePositive) {
    const CellGrid cells(test::tank_treading_grid(), {true, true, true});
    const auto mesh = meshing::icosphere(1, 1.0);
    EXPECT_THROW(InteriorViscosity(cells, mesh.triangles, mesh.vertices.size(), {0.0}, 1.0), InputError);
    EXPECT_THROW(InteriorViscosity(cells, mesh.triangles, mesh.vertices.size(), {1.0}, -1.0), InputError);
}

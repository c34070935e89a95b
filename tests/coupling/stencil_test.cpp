#include "coupling/stencil.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "coupling/interpolate.hpp"
#include "exchange/backend.hpp"
#include "grids.hpp"

using namespace hemoflux;
using namespace hemoflux::coupling;

namespace {

const Kernel kernels[] = {Kernel::phi2, Kernel::phi3, Kernel::phi4, Kernel::lagrange};

/// Fills a field with f(x, y, z) at the cell centres; ghosts are NaN, so that reading one shows.
template <class Function>
void fill(test::Field& field, const meshing::RectilinearGrid& grid, const exchange::Layout& layout,
          Function f) {
    const auto xs = grid.axes[0].centres(), ys = grid.axes[1].centres(), zs = grid.axes[2].centres();
    for (int q = 0; q < 3; ++q) {
        std::vector<double> values(layout.size, std::numeric_limits<double>::quiet_NaN());
        for (std::size_t k = 0; k < zs.size(); ++k)
            for (std::size_t j = 0; j < ys.size(); ++j)
                for (std::size_t i = 0; i < xs.size(); ++i)
                    values[layout.at(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k))] =
                        f(q, xs[i], ys[j], zs[k]);
        field.component[q].assign(values);
    }
}

}  // namespace

// Every kernel reproduces a linear velocity anywhere between walls, walls and corners included.
TEST(Interpolate, LinearVelocityIsExactUpToTheWalls) {
    const auto grid = test::mixed_grid();
    const CellGrid cells(grid, {false, false, false});
    const auto layout = cells.view().layout;
    test::Field velocity(layout);
    const auto linear = [](int q, double x, double y, double z) {
        return q + 0.3 * x - (1 + q) * y + 0.7 * z;
    };
    fill(velocity, grid, layout, linear);
    std::mt19937 engine(2);
    std::vector<Vec3d> points{{-3, -4, 0}, {5, 4, 6}, {-3, 4, 3}, {-2.999, 0, 5.999}};
    for (int i = 0; i < 500; ++i) {
        const auto on = [&](const meshing::Axis& a) {
            return std::uniform_real_distribution<double>(a.lower(), a.upper())(engine);
        };
        points.push_back({on(grid.axes[0]), on(grid.axes[1]), on(grid.axes[2])});
    }
    const test::Points p(points);
    for (const Kernel kernel : kernels) {
        StencilSet stencils(cells, kernel, points.size());
        stencils.update(p[0], p[1], p[2]);
        EXPECT_EQ(stencils.first_lost(), points.size());
        exchange::Buffer<double> v[3];
        for (auto& b : v) b = exchange::Buffer<double>(points.size());
        interpolate(stencils, velocity.view(), v[0].data(), v[1].data(), v[2].data());
        for (int q = 0; q < 3; ++q) {
            const auto host = v[q].to_host();
            for (std::size_t m = 0; m < points.size(); ++m)
                EXPECT_NEAR(host[m], linear(q, points[m].x, points[m].y, points[m].z), 1e-12)
                    << "kernel " << static_cast<int>(kernel) << " marker " << m;
        }
    }
}

// A smooth periodic velocity converges at the kernel's order: 4 for Lagrange, 2 for the others.
TEST(Interpolate, OrderOfConvergenceAcrossThePeriodicSeam) {
    std::vector<Vec3d> points;
    for (int i = 0; i < 64; ++i) points.push_back({-7.0 + 0.37 * i, 5.9 + 0.001 * i, 30.0 - 0.61 * i});
    const test::Points p(points);
    const double k = 2 * std::acos(-1.0) / 12;
    const auto wave = [k](int q, double x, double y, double z) {
        return std::sin(k * x + q) * std::cos(k * y) * std::sin(k * z + 0.3);
    };
    for (const Kernel kernel : kernels) {
        double error[2];
        for (const int level : {0, 1}) {
            const auto axis = meshing::uniform_axis(-6, 6, 24 << level);
            const meshing::RectilinearGrid grid{{axis, axis, axis}};
            const CellGrid cells(grid, {true, true, true});
            test::Field velocity(cells.view().layout);
            fill(velocity, grid, cells.view().layout, wave);
            StencilSet stencils(cells, kernel, points.size());
            stencils.update(p[0], p[1], p[2]);
            exchange::Buffer<double> v[3];
            for (auto& b : v) b = exchange::Buffer<double>(points.size());
            interpolate(stencils, velocity.view(), v[0].data(), v[1].data(), v[2].data());
            double sum = 0;
            for (int q = 0; q < 3; ++q) {
                const auto host = v[q].to_host();
                for (std::size_t m = 0; m < points.size(); ++m)
                    sum += std::pow(host[m] - wave(q, points[m].x, points[m].y, points[m].z), 2);
            }
            error[level] = std::sqrt(sum);
        }
        EXPECT_GT(std::log2(error[0] / error[1]), kernel == Kernel::lagrange ? 3.7 : 1.85)
            << static_cast<int>(kernel);
    }
}

TEST(StencilSet, NamesTheFirstLostMarker) {
    const CellGrid walls(test::mixed_grid(), {false, false, false});
    const CellGrid periodic(test::mixed_grid(), {true, true, true});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const test::Points outside({{0, 0, 1}, {0, 4.001, 1}, {nan, 0, 1}}),
        invalid({{0, 0, 1}, {9, 9, 9}, {0, nan, 1}});
    StencilSet a(walls, Kernel::lagrange, 3), b(periodic, Kernel::phi4, 3);
    a.update(outside[0], outside[1], outside[2]);
    b.update(outside[0], outside[1], outside[2]);
    EXPECT_EQ(a.first_lost(), 1u);
    EXPECT_EQ(b.first_lost(), 2u);
    b.update(invalid[0], invalid[1], invalid[2]);
    EXPECT_EQ(b.first_lost(), 2u);
}

TEST(Interpolate, IsBitwiseTheSameForAnyNumberOfThreads) {
    const auto grid = test::tank_treading_grid();
    const CellGrid cells(grid, {true, false, true});
    test::Field velocity(cells.view().layout);
    fill(velocity, grid, cells.view().layout,
         [](int q, double x, double y, double z) { return std::sin(x + q * y) * z; });
    std::mt19937 engine(9);
    std::uniform_real_distribution<double> u(-5.9, 5.9);
    std::vector<Vec3d> points(5000);
    for (Vec3d& a : points) a = {u(engine), u(engine), u(engine)};
    const test::Points p(points);
    std::vector<std::vector<double>> results;
    for (const int count : {1, 2, 3, 1}) {
        exchange::set_threads(count);
        StencilSet stencils(cells, Kernel::lagrange, points.size());
        stencils.update(p[0], p[1], p[2]);
        exchange::Buffer<double> x(points.size()), y(points.size()), z(points.size());
        interpolate(stencils, velocity.view(), x.data(), y.data(), z.data());
        auto all = x.to_host();
        for (const auto* b : {&y, &z}) {
            const auto host = b->to_host();
            all.insert(all.end(), host.begin(), host.end());
        }
        results.push_back(all);
    }
    exchange::set_threads(0);
    for (const auto& r : results) EXPECT_EQ(r, results[0]);
}

#include "coupling/spread.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "coupling/interpolate.hpp"
#include "exchange/backend.hpp"
#include "grids.hpp"

using namespace hemoflux;
using namespace hemoflux::coupling;

namespace {

const Kernel kernels[] = {Kernel::phi2, Kernel::phi3, Kernel::phi4, Kernel::lagrange};

struct Setup {
    std::string name;
    meshing::RectilinearGrid grid;
    std::array<bool, 3> periodic;
};
std::vector<Setup> setups() {
    const auto thin =
        meshing::RectilinearGrid{{meshing::uniform_axis(-4, 4, 13), test::random_axis(-4, 4, 21, 4),
                                  meshing::uniform_axis(-0.5, 0.5, 1)}};
    const auto seam = meshing::RectilinearGrid{
        {meshing::uniform_axis(-4, 4, 7), test::random_axis(-4, 4, 7, 4), meshing::uniform_axis(-4, 4, 6)}};
    return {{"walls", test::mixed_grid(), {false, false, false}},
            {"periodic", test::mixed_grid(), {true, true, true}},
            {"closed box", test::tank_treading_grid(), {false, false, false}},
            {"shear box", test::tank_treading_grid(), {true, false, true}},
            {"one cell thick", thin, {true, false, true}},
            {"few tiles", seam, {true, true, true}}};
}

/// Markers of three kinds: anywhere, at walls and corners, many in one place.
std::vector<Vec3d> markers(const meshing::RectilinearGrid& g, std::size_t n) {
    std::mt19937 engine(11);
    const auto on = [&](int q) {
        const auto& a = g.axes[static_cast<std::size_t>(q)];
        return std::uniform_real_distribution<double>(a.lower(), a.upper())(engine);
    };
    std::vector<Vec3d> points;
    for (std::size_t m = 0; m < n; ++m) {
        Vec3d p{on(0), on(1), on(2)};
        if (m % 3 == 1) p = {g.axes[0].lower() + 1e-3 * p.x * p.x, g.axes[1].upper() - 1e-3 * p.y * p.y, p.z};
        if (m % 3 == 2) p = {0.3 + 1e-3 * p.x, 0.4 + 1e-3 * p.y, 0.1 + 1e-3 * p.z};
        points.push_back(p);
    }
    return points;
}
std::vector<Vec3d> forces(std::size_t n) {
    std::mt19937 engine(12);
    std::normal_distribution<double> normal;
    std::vector<Vec3d> f(n);
    for (Vec3d& a : f) a = {normal(engine), normal(engine), normal(engine)};
    return f;
}

/// The same sum by brute force: every marker, every cell of its stencil, straight from the kernel.
std::vector<double> brute_force(const CellGrid& cells, const StencilSet& stencils,
                                const std::vector<Vec3d>& force, const meshing::RectilinearGrid& grid,
                                int q) {
    const auto v = cells.view();
    std::vector<double> density(v.layout.size, 0.0);
    const auto wx = grid.axes[0].widths(), wy = grid.axes[1].widths(), wz = grid.axes[2].widths();
    exchange::Buffer<Stencil> copy(stencils.size());
    exchange::copy_on_device(copy.data(), stencils.data(), stencils.size() * sizeof(Stencil));
    const auto host = copy.to_host();
    for (std::size_t m = 0; m < host.size(); ++m)
        for (int c = 0; c < 4; ++c)
            for (int b = 0; b < 4; ++b)
                for (int a = 0; a < 4; ++a) {
                    const int i = (host[m].first[0] + a) % v.axis[0].n,
                              j = (host[m].first[1] + b) % v.axis[1].n,
                              k = (host[m].first[2] + c) % v.axis[2].n;
                    const double F = q == 0 ? force[m].x : (q == 1 ? force[m].y : force[m].z);
                    density[v.layout.at(i, j, k)] +=
                        F * host[m].weight[0][a] * host[m].weight[1][b] * host[m].weight[2][c] /
                        (wx[static_cast<std::size_t>(i)] * wy[static_cast<std::size_t>(j)] *
                         wz[static_cast<std::size_t>(k)]);
                }
    return density;
}

}  // namespace

TEST(Spread, AgreesWithBruteForceAndLeavesOtherCellsZero) {
    for (const auto& [name, grid, periodic] : setups())
        for (const Kernel kernel : kernels) {
            SCOPED_TRACE(name + " kernel " + std::to_string(static_cast<int>(kernel)));
            const CellGrid cells(grid, periodic);
            const auto points = markers(grid, 200), force = forces(200);
            const test::Points p(points), f(force);
            StencilSet stencils(cells, kernel, points.size());
            stencils.update(p[0], p[1], p[2]);
            Spreader spreader(stencils);
            test::Field density(cells.view().layout);
            // whatever was there before the first spread must go
            const auto layout = cells.view().layout;
            std::vector<double> dirt(layout.size, 0.0);
            dirt[layout.at(1, 2, 0)] = 5;
            for (auto& c : density.component) c.assign(dirt);
            spreader.spread(f[0], f[1], f[2], 1.0, density.view());
            for (int q = 0; q < 3; ++q) {
                const auto expected = brute_force(cells, stencils, force, grid, q);
                const auto host = density.component[q].to_host();
                double largest = 0;
                for (const double e : expected) largest = std::max(largest, std::fabs(e));
                for (std::size_t c = 0; c < host.size(); ++c) {
                    EXPECT_NEAR(host[c], expected[c], 1e-13 * largest);
                    if (expected[c] == 0) {
                        EXPECT_EQ(host[c], 0);
                    }
                }
            }
        }
}

// A second set of markers adds to what the first has spread, also where the first has left its cells, and leaves
// nothing behind.
TEST(Spread, AddsASecondSetOfMarkers) {
    const auto grid = test::mixed_grid();
    const CellGrid cells(grid, {true, true, true});
    auto points = markers(grid, 300);
    const auto force = forces(300);
    const test::Points f1({force.begin(), force.begin() + 100}), f2({force.begin() + 100, force.end()});
    StencilSet s1(cells, Kernel::phi4, 100), s2(cells, Kernel::phi4, 200), all(cells, Kernel::phi4, 300);
    Spreader lead(s1), add(s2, &lead), whole(all);
    test::Field sum(cells.view().layout), expected(cells.view().layout);
    for (const double shift : {0.0, 2.0, 3.5}) {
        for (Vec3d& p : points) p.x += shift;
        const test::Points p(points), p1({points.begin(), points.begin() + 100}),
            p2({points.begin() + 100, points.end()}), f(force);
        s1.update(p1[0], p1[1], p1[2]);
        s2.update(p2[0], p2[1], p2[2]);
        all.update(p[0], p[1], p[2]);
        lead.spread(f1[0], f1[1], f1[2], 1.5, sum.view());
        add.spread(f2[0], f2[1], f2[2], 1.5, sum.view());
        whole.spread(f[0], f[1], f[2], 1.5, expected.view());
        for (int q = 0; q < 3; ++q) {
            const auto a = sum.component[q].to_host(), b = expected.component[q].to_host();
            double largest = 0;
            for (const double v : b) largest = std::max(largest, std::fabs(v));
            for (std::size_t c = 0; c < a.size(); ++c) ASSERT_NEAR(a[c], b[c], 1e-13 * largest);
        }
    }
}

// sum_m F_m . (interpolation of u)_m = sum_c V_c f_c . u_c to 1e-13 of the sum of magnitudes.
TEST(Spread, IsTheAdjointOfInterpolation) {
    for (const auto& [name, grid, periodic] : setups())
        for (const Kernel kernel : kernels) {
            SCOPED_TRACE(name + " kernel " + std::to_string(static_cast<int>(kernel)));
            const CellGrid cells(grid, periodic);
            const auto layout = cells.view().layout;
            const auto points = markers(grid, 400), force = forces(400);
            const test::Points p(points), f(force);
            StencilSet stencils(cells, kernel, points.size());
            stencils.update(p[0], p[1], p[2]);
            Spreader spreader(stencils);
            test::Field density(layout), velocity(layout);
            std::mt19937 engine(3);
            std::normal_distribution<double> normal;
            for (auto& c : velocity.component) {
                std::vector<double> values(layout.size);
                for (double& a : values) a = normal(engine);
                c.assign(values);
            }
            spreader.spread(f[0], f[1], f[2], 1.0, density.view());
            exchange::Buffer<double> v[3];
            for (auto& b : v) b = exchange::Buffer<double>(points.size());
            interpolate(stencils, velocity.view(), v[0].data(), v[1].data(), v[2].data());
            double markers_work = 0, cells_work = 0, magnitude = 0;
            const auto wx = grid.axes[0].widths(), wy = grid.axes[1].widths(), wz = grid.axes[2].widths();
            for (int q = 0; q < 3; ++q) {
                const auto vm = v[q].to_host(), fm = f.component[q].to_host(),
                           fc = density.component[q].to_host(), uc = velocity.component[q].to_host();
                for (std::size_t m = 0; m < vm.size(); ++m) {
                    markers_work += fm[m] * vm[m];
                    magnitude += std::fabs(fm[m] * vm[m]);
                }
                for (std::size_t k = 0; k < wz.size(); ++k)
                    for (std::size_t j = 0; j < wy.size(); ++j)
                        for (std::size_t i = 0; i < wx.size(); ++i) {
                            const std::size_t c =
                                layout.at(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
                            cells_work += wx[i] * wy[j] * wz[k] * fc[c] * uc[c];
                        }
            }
            EXPECT_NEAR(markers_work, cells_work, 1e-13 * magnitude);
        }
}

// Total force and torque (5.10, 5.11) to 1e-12 of the sums of magnitudes; torque needs a box without seam.
TEST(Spread, ConservesForceAndTorque) {
    for (const auto& [name, grid, periodic] : setups())
        for (const Kernel kernel : kernels) {
            SCOPED_TRACE(name + " kernel " + std::to_string(static_cast<int>(kernel)));
            const CellGrid cells(grid, periodic);
            const auto layout = cells.view().layout;
            const auto points = markers(grid, 600), force = forces(600);
            const test::Points p(points), f(force);
            StencilSet stencils(cells, kernel, points.size());
            stencils.update(p[0], p[1], p[2]);
            Spreader spreader(stencils);
            test::Field density(layout);
            const double factor = 2.5;
            spreader.spread(f[0], f[1], f[2], factor, density.view());
            std::vector<double> fc[3];
            for (int q = 0; q < 3; ++q) fc[q] = density.component[q].to_host();
            Vec3d total{0, 0, 0}, torque{0, 0, 0};
            double total_scale = 0, torque_scale = 0;
            for (std::size_t m = 0; m < points.size(); ++m) {
                const Vec3d F = factor * force[m], T = cross(points[m], F);
                total += F, torque += T;
                total_scale += norm(F), torque_scale += norm(T);
            }
            const auto &ax = grid.axes[0], &ay = grid.axes[1], &az = grid.axes[2];
            const auto wx = ax.widths(), wy = ay.widths(), wz = az.widths();
            const auto cx = ax.centres(), cy = ay.centres(), cz = az.centres();
            for (std::size_t k = 0; k < wz.size(); ++k)
                for (std::size_t j = 0; j < wy.size(); ++j)
                    for (std::size_t i = 0; i < wx.size(); ++i) {
                        const std::size_t c =
                            layout.at(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
                        const Vec3d F = wx[i] * wy[j] * wz[k] * Vec3d{fc[0][c], fc[1][c], fc[2][c]};
                        total -= F, torque -= cross(Vec3d{cx[i], cy[j], cz[k]}, F);
                    }
            EXPECT_LT(norm(total), 1e-12 * total_scale);
            if (!periodic[0]) {
                EXPECT_LT(norm(torque), 1e-12 * torque_scale);
            }
        }
}

// Any number of threads, repeated runs, and a spreader that has been used before at other places.
TEST(Spread, IsBitwiseReproducible) {
    const auto grid = test::tank_treading_grid();
    const CellGrid cells(grid, {true, false, true});
    for (const std::size_t n : {1u, 500u, 9000u}) {
        const auto points = markers(grid, n), force = forces(n);
        std::vector<Vec3d> elsewhere = points;
        for (Vec3d& a : elsewhere) a = {a.z, 0.5 * a.x, a.y};
        const test::Points p(points), other(elsewhere), f(force);
        std::vector<std::vector<double>> results;
        for (const int count : {1, 2, 3, 2}) {
            exchange::set_threads(count);
            StencilSet stencils(cells, Kernel::lagrange, n);
            Spreader spreader(stencils);
            test::Field density(cells.view().layout);
            for (const test::Points* at : {&p, &other, &p}) {
                stencils.update((*at)[0], (*at)[1], (*at)[2]);
                spreader.spread(f[0], f[1], f[2], 1.0, density.view());
                if (at == &p)
                    for (auto& c : density.component) results.push_back(c.to_host());
            }
        }
        exchange::set_threads(0);
        for (std::size_t r = 3; r < results.size(); ++r) EXPECT_EQ(results[r], results[r % 3]);
    }
}

TEST(Spread, ForgetClearsWhatOthersWrote) {
    const CellGrid cells(test::mixed_grid(), {false, false, false});
    const auto layout = cells.view().layout;
    const test::Points p({{0, 0, 1}}), f({{1, 1, 1}});
    StencilSet stencils(cells, Kernel::lagrange, 1);
    stencils.update(p[0], p[1], p[2]);
    Spreader spreader(stencils);
    test::Field density(layout);
    spreader.spread(f[0], f[1], f[2], 1.0, density.view());
    const auto expected = density.component[0].to_host();
    auto dirty = expected;
    dirty[layout.at(18, 15, 10)] = 1;
    density.component[0].assign(dirty);
    spreader.forget();
    spreader.spread(f[0], f[1], f[2], 1.0, density.view());
    EXPECT_EQ(density.component[0].to_host(), expected);
}

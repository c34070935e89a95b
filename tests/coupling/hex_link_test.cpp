#include "coupling/hex_link.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "coupling/cell_grid.hpp"
#include "exchange/backend.hpp"
#include "exchange/error.hpp"
#include "hex_grids.hpp"

namespace hemoflux::coupling {
namespace {

using test::Points;
using test::Records;

const Kernel kernels[] = {Kernel::phi3, Kernel::phi4, Kernel::lagrange};

/// A node's cells as they lie around it, with their weights.
struct Weighted {
    Vec3d centre;
    double weight;
};
std::vector<Weighted> weights_of(const HexCells& cells, Kernel kernel, const HexLink& link,
                                 std::size_t node) {
    const HexStencil s = link.stencils()[node];
    const auto all = link.weights();
    const HexNeighbourhood& around = cells.neighbourhood(kernel);
    exchange::Buffer<Vec3d> copy(1);
    std::vector<Weighted> list;
    for (std::uint32_t i = around.first()[s.place.cell]; i < around.first()[s.place.cell + 1]; ++i) {
        const HexCandidate c = around.candidates()[i];
        exchange::copy_on_device(copy.data(), around.view().image + c.image, sizeof(Vec3d));
        list.push_back({cells.grid().centre[c.cell] + copy.to_host()[0] + cells.walk().offset(s.place),
                        all[link.width() * node + (i - around.first()[s.place.cell])]});
    }
    return list;
}

/// Largest errors of the moments of order 0, 1 and 2 over all nodes, in cells.
std::array<double, 3> moment_errors(const HexCells& cells, Kernel kernel, const std::vector<Vec3d>& points) {
    HexLink link(cells, kernel, points.size());
    const Points p(points);
    link.locate(test::view(p, points.size()));
    EXPECT_EQ(link.first_lost(), points.size());
    std::array<double, 3> error{};
    for (std::size_t m = 0; m < points.size(); ++m) {
        double zeroth = -1, first[3] = {}, second[3][3] = {};
        for (const Weighted& c : weights_of(cells, kernel, link, m)) {
            const Vec3d away = c.centre - points[m];
            const double d[3] = {away.x, away.y, away.z};
            zeroth += c.weight;
            for (int i = 0; i < 3; ++i) {
                first[i] += c.weight * d[i];
                for (int j = 0; j < 3; ++j) second[i][j] += c.weight * d[i] * d[j];
            }
        }
        error[0] = std::max(error[0], std::abs(zeroth));
        for (int i = 0; i < 3; ++i) {
            error[1] = std::max(error[1], std::abs(first[i]));
            for (int j = 0; j < 3; ++j) error[2] = std::max(error[2], std::abs(second[i][j]));
        }
    }
    return error;
}

/// Nodes in a round pipe, on its wall and in the middle among them.
std::vector<Vec3d> in_pipe(std::size_t n) {
    std::mt19937 engine(8);
    std::uniform_real_distribution<double> on(0, 1);
    std::vector<Vec3d> points{{0, 0, 0}, {5, 0, 0}, {-30, 1, 2}};
    for (std::size_t i = 0; i < n; ++i) {
        const double r = 4.9 * std::sqrt(on(engine)), angle = 6.3 * on(engine);
        points.push_back({60 * on(engine) - 30, r * std::cos(angle), r * std::sin(angle)});
    }
    return points;
}

class HexLinkTest : public testing::Test {
  protected:
    void SetUp() override { exchange::set_threads(1); }
    void TearDown() override { exchange::set_threads(0); }
};

}  // namespace

TEST_F(HexLinkTest, MomentsAreExactOnSkewedHexahedra) {
    for (const bool periodic : {false, true}) {
        const meshing::HexGrid grid = test::skewed_box(8, 0.25, periodic);
        const HexCells cells(grid);
        std::vector<Vec3d> points = test::anywhere(150, 0, 6);
        for (const double x : {0.0, 6.0, 1e-9, 3.0})
            for (const double y : {0.0, 6.0, 2.0})
                points.insert(points.end(), {{x, y, 0}, {x, y, 6}, {x, y, 2.5}});
        for (const Kernel kernel : kernels) {
            const auto error = moment_errors(cells, kernel, points);
            EXPECT_LT(error[0], 1e-12) << static_cast<int>(kernel);
            EXPECT_LT(error[1], 1e-12) << static_cast<int>(kernel);
            if (kernel == Kernel::lagrange) {
                EXPECT_LT(error[2], 1e-11);
            }
        }
    }
}

TEST_F(HexLinkTest, MomentsAreExactInARoundPipeUpToItsWall) {
    const meshing::HexGrid grid = test::pipe();
    const HexCells cells(grid);
    for (const Kernel kernel : kernels) {
        const auto error = moment_errors(cells, kernel, in_pipe(150));
        EXPECT_LT(error[0], 1e-12) << static_cast<int>(kernel);
        EXPECT_LT(error[1], 1e-12) << static_cast<int>(kernel);
        if (kernel == Kernel::lagrange) {
            EXPECT_LT(error[2], 1e-11);
        }
    }
}

TEST_F(HexLinkTest, MeetsLinearVelocitiesAndWithLagrangeQuadraticOnes) {
    const meshing::HexGrid grid = test::skewed_box(8, 0.25);
    const HexCells cells(grid);
    const std::vector<Vec3d> points = test::anywhere(200, 0, 6);
    const Points p(points);
    for (const Kernel kernel : kernels) {
        const double bend = kernel == Kernel::lagrange ? 0.2 : 0;
        const auto flow = [&](const Vec3d& x) {
            return Vec3d{1 + x.x - 2 * x.y + bend * x.x * x.z, 0.5 * x.z + bend * x.y * x.y,
                         x.x + x.y + x.z - bend * x.z * x.y};
        };
        std::vector<Vec3d> at_cells;
        for (const Vec3d& c : grid.centre) at_cells.push_back(flow(c));
        Records field(grid.cells());
        field.set(at_cells);
        HexLink link(cells, kernel, points.size());
        link.locate(test::view(p, points.size()));
        exchange::Buffer<double> v[3];
        for (auto& b : v) b = exchange::Buffer<double>(points.size());
        link.interpolate(field.view(), {{v[0].data(), v[1].data(), v[2].data()}, points.size()});
        const auto x = v[0].to_host(), y = v[1].to_host(), z = v[2].to_host();
        for (std::size_t m = 0; m < points.size(); ++m)
            EXPECT_LT(norm(Vec3d{x[m], y[m], z[m]} - flow(points[m])), 2e-12) << static_cast<int>(kernel);
    }
}

TEST_F(HexLinkTest, SpreadingIsTheAdjointAndConservesForceAndTorque) {
    const meshing::HexGrid grid = test::skewed_box(8, 0.25);
    const HexCells cells(grid);
    std::vector<Vec3d> points = test::anywhere(200, 0, 6);
    for (std::size_t m = 0; m < 60; ++m) points[m] = Vec3d{2, 3, 4} + 0.05 * points[m];  // many in few cells
    const std::size_t n = points.size();
    const std::vector<Vec3d> force = test::anywhere(n, -1, 1, 21),
                             u = test::anywhere(grid.cells(), -1, 1, 22);
    const Points p(points), f(force);
    for (const Kernel kernel : kernels) {
        HexLink link(cells, kernel, n);
        link.locate(test::view(p, n));
        Records density(grid.cells()), velocity(grid.cells());
        density.set(test::anywhere(grid.cells(), 5, 9));  // is cleared
        velocity.set(u);
        const auto first = link.spreader(nullptr), second = link.spreader(first.get());
        first->spread(test::view(f, n), 2, density.view());
        second->spread(test::view(f, n), 0.5, density.view());
        exchange::Buffer<double> v[3];
        for (auto& b : v) b = exchange::Buffer<double>(n);
        link.interpolate(velocity.view(), {{v[0].data(), v[1].data(), v[2].data()}, n});
        const auto x = v[0].to_host(), y = v[1].to_host(), z = v[2].to_host();
        double of_nodes = 0, of_cells = 0;
        Vec3d sum{0, 0, 0}, torque{0, 0, 0};
        for (std::size_t m = 0; m < n; ++m) {
            of_nodes += 2.5 * dot(force[m], Vec3d{x[m], y[m], z[m]});
            sum += 2.5 * force[m];
            torque += 2.5 * cross(points[m], force[m]);
        }
        const auto spread = density.get();
        for (std::size_t c = 0; c < grid.cells(); ++c) {
            of_cells += grid.volume[c] * dot(spread[c], u[c]);
            sum -= grid.volume[c] * spread[c];
            torque -= grid.volume[c] * cross(grid.centre[c], spread[c]);
        }
        EXPECT_NEAR(of_nodes, of_cells, 1e-11) << static_cast<int>(kernel);
        EXPECT_LT(norm(sum), 1e-11) << static_cast<int>(kernel);
        EXPECT_LT(norm(torque), 1e-10) << static_cast<int>(kernel);
    }
}

// On equal cells, away from walls, phi3 and phi4 are those of the rectilinear grid.
TEST_F(HexLinkTest, SmoothKernelsAreThoseOfTheRectilinearGridOnEqualCells) {
    const meshing::HexGrid grid = test::skewed_box(12, 0);
    const HexCells hex(grid);
    const auto axis = meshing::uniform_axis(0, 6, 12);
    const meshing::RectilinearGrid box{{axis, axis, axis}};
    const CellGrid straight(box, {false, false, false});
    const std::vector<Vec3d> points = test::anywhere(100, 2.1, 3.9);
    const std::size_t n = points.size();
    const Points p(points), f(test::anywhere(n, -1, 1, 21));
    for (const Kernel kernel : {Kernel::phi3, Kernel::phi4}) {
        const auto a = hex.link(kernel, n), b = straight.link(kernel, n);
        a->locate(test::view(p, n));
        b->locate(test::view(p, n));
        Records on_hex(grid.cells());
        test::Field on_box(straight.view().layout);
        a->spreader(nullptr)->spread(test::view(f, n), 1, on_hex.view());
        b->spreader(nullptr)->spread(test::view(f, n), 1, on_box.view());
        const auto of_hex = on_hex.get();
        const auto of_box = on_box.component[1].to_host();
        for (std::size_t c = 0; c < grid.cells(); ++c) {
            const Vec3d at = 2.0 * grid.centre[c];
            const std::size_t i = straight.view().layout.at(static_cast<int>(at.x), static_cast<int>(at.y),
                                                            static_cast<int>(at.z));
            ASSERT_NEAR(of_hex[c].y, of_box[i], 1e-12) << static_cast<int>(kernel);
        }
    }
}

TEST_F(HexLinkTest, WeightsAreContinuousWhereANodePassesFromCellToCell) {
    const meshing::HexGrid grid = test::skewed_box(8, 0.25);
    const HexCells cells(grid);
    for (const Kernel kernel : kernels) {
        // u = 1 in one cell: the velocity of a node is the weight of that cell
        std::vector<Vec3d> u(grid.cells(), Vec3d{0, 0, 0});
        const std::uint32_t middle = cells.nearest({3, 3, 3});
        u[middle] = {1, 0, 0};
        Records field(grid.cells());
        field.set(u);
        std::vector<Vec3d> line;
        for (int i = 0; i <= 4000; ++i)
            line.push_back(grid.centre[middle] + (i / 4000.0 - 0.5) * Vec3d{3.1, 1.7, 1.4});
        HexLink link(cells, kernel, line.size());
        const Points p(line);
        link.locate(test::view(p, line.size()));
        exchange::Buffer<double> v[3];
        for (auto& b : v) b = exchange::Buffer<double>(line.size());
        link.interpolate(field.view(), {{v[0].data(), v[1].data(), v[2].data()}, line.size()});
        const auto w = v[0].to_host();
        double largest = 0, step = 0;
        for (std::size_t i = 1; i < w.size(); ++i) {
            largest = std::max(largest, std::abs(w[i]));
            step = std::max(step, std::abs(w[i] - w[i - 1]));
        }
        EXPECT_GT(largest, 0.1) << static_cast<int>(kernel);
        EXPECT_LT(step, 0.01) << static_cast<int>(kernel);  // 4000 steps over 5 cells
    }
}

TEST_F(HexLinkTest, IsBitwiseTheSameForAnyNumberOfThreadsAndAnyHistory) {
    const meshing::HexGrid grid = test::skewed_box(8, 0.25, true);
    const HexCells cells(grid);
    const std::vector<Vec3d> points = test::anywhere(500, 0, 6), before = test::anywhere(500, 2, 3, 4);
    const Points p(points), other(before), f(test::anywhere(500, -1, 1, 21));
    std::vector<std::vector<double>> results;
    for (const int threads : {1, 2, 3, 1}) {
        exchange::set_threads(threads);
        HexLink link(cells, Kernel::phi4, 500);
        if (results.size() == 3) link.locate(test::view(other, 500));
        link.locate(test::view(p, 500));
        Records density(grid.cells());
        link.spreader(nullptr)->spread(test::view(f, 500), 1, density.view());
        exchange::Buffer<double> v[3];
        for (auto& b : v) b = exchange::Buffer<double>(500);
        link.interpolate(density.view(), {{v[0].data(), v[1].data(), v[2].data()}, 500});
        std::vector<double> all = density.data.to_host();
        for (const auto& b : v)
            for (const double value : b.to_host()) all.push_back(value);
        results.push_back(all);
    }
    for (std::size_t i = 1; i < results.size(); ++i) EXPECT_EQ(results[i], results[0]) << i;
}

TEST_F(HexLinkTest, RefusesWhatItCannotServe) {
    const meshing::HexGrid grid = test::skewed_box(6, 0);
    const HexCells cells(grid);
    EXPECT_THROW(HexLink(cells, Kernel::phi2, 1), InputError);
    const meshing::HexGrid sheet =
        meshing::make_hex_grid(meshing::box_mesh(Vec3d{0, 0, 0}, {6, 6, 1}, {6, 6, 1}));
    const HexCells thin(sheet);
    EXPECT_THROW(HexLink(thin, Kernel::phi3, 1), InputError);
    EXPECT_THROW(HexLink(thin, Kernel::lagrange, 1), InputError);
}

}  // namespace hemoflux::coupling

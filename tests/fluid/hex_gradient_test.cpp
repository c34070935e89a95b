#include "fluid/hex_gradient.hpp"

#include <gtest/gtest.h>

#include "exchange/error.hpp"
#include "hex_flows.hpp"

namespace hemoflux::fluid {
namespace {

constexpr double slope[4][3] = {
    {0.01, -0.02, 0.015}, {0.3, 0.1, -0.2}, {-0.1, 0.25, 0.05}, {0.2, -0.3, -0.55}};

FlowPoint linear(const Vec3d& x) {
    const auto at = [&](int c) { return slope[c][0] * x.x + slope[c][1] * x.y + slope[c][2] * x.z; };
    return {1 + at(0), {at(1), at(2), at(3)}};
}

/// Largest error of the gradients of a linear field whose values are given on the border.
double linear_error(const meshing::HexGrid& grid, GradientMethod method) {
    HexPatches patches;
    for (const auto& p : grid.patches)
        patches[p.name] = {VelocityCondition::given, DensityCondition::given,
                           [](const Vec3d& x) { return linear(x).velocity; },
                           [](const Vec3d& x) { return linear(x).density; }};
    SolverOptions o;
    o.nu = 0.1;
    o.gradient = method;
    HexSolver solver(grid, patches, o);
    solver.initialise(linear);
    double worst = 0;
    for (const auto& gradient : solver.gradients())
        for (std::size_t c = 0; c < 4; ++c) {
            const double g[3] = {gradient[c].x, gradient[c].y, gradient[c].z};
            for (std::size_t a = 0; a < 3; ++a) worst = std::max(worst, std::abs(g[a] - slope[c][a]));
        }
    return worst;
}

/// Aspect ratios (A.31) up to `flatness` times 2, and every inner node moved at random.
meshing::HexGrid random_box(double flatness) {
    meshing::BoxDistortion distortion;
    distortion.random = 0.3;
    distortion.shuffle = true;
    return meshing::make_hex_grid(
        meshing::box_mesh(Vec3d{0, 0, 0}, Vec3d{1, 0.9, 1.1 / flatness}, {9, 8, 10}, distortion));
}

}  // namespace

TEST(HexGradient, LinearFieldsAreExactOnRandomHexahedra) {
    for (const double flatness : {1.0, 5.0, 40.0})
        for (const GradientMethod method : {GradientMethod::least_squares, GradientMethod::hybrid})
            EXPECT_LT(linear_error(random_box(flatness), method), 1e-12) << flatness;
}

TEST(HexGradient, GreenGaussIsExactOnStraightBoxesOnly) {
    EXPECT_LT(
        linear_error(meshing::make_hex_grid(meshing::box_mesh(Vec3d{0, 0, 0}, Vec3d{1, 2, 3}, {5, 6, 7})),
                     GradientMethod::green_gauss),
        1e-12);
    EXPECT_GT(linear_error(random_box(1), GradientMethod::green_gauss), 1e-3);
}

TEST(HexGradient, LeastSquaresIsExactForQuadraticsOnStretchedBoxes) {
    meshing::RectilinearGrid box;
    box.axes.fill(meshing::chebyshev_axis(0, 1, 8));
    const meshing::HexGrid grid = meshing::make_hex_grid(meshing::box_mesh(box));
    const auto neighbours = hex_neighbours(grid);
    const auto w = gradient_weights(grid, neighbours, GradientMethod::least_squares);
    for (std::size_t i = 0; i < grid.cells(); ++i) {
        double gradient = 0;
        for (std::size_t j = 0; j < hex_sides; ++j) {
            const double x = grid.centre[i].x, there = x + neighbours[6 * i + j].offset.x;
            gradient += w[3 * (6 * i + j)] * (there * there - x * x);
        }
        EXPECT_NEAR(gradient, 2 * grid.centre[i].x, 1e-12);
    }
}

TEST(HexGradient, PeriodicNeighboursAreWhereTheyBelong) {
    const meshing::HexGrid grid = test::box_grid({1, 1, 0.1}, {5, 4, 1}, "xz");
    for (const HexNeighbour& n : hex_neighbours(grid)) {
        EXPECT_GT(dot(n.offset, n.outward * grid.area[n.face]), 0);
        EXPECT_NEAR(norm(n.offset - 2.0 * n.reach), 0, 1e-14);
    }
}

}  // namespace hemoflux::fluid

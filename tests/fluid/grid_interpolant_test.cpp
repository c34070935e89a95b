#include "fluid/grid_interpolant.hpp"

#include <gtest/gtest.h>

#include "fluid/probe.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::fluid {
namespace {

double cubic(const Vec3d& x) {
    return 0.3 + x.x * x.x * x.x - 2 * x.x * x.y * x.y + x.z * x.z + x.x * x.y * x.z - 0.7 * x.y;
}

meshing::RectilinearGrid stretched() {
    return {{meshing::chebyshev_axis(-1, 2, 9), meshing::plateau_axis(0, 1, 8, 2, 0.6),
             meshing::explicit_axis({0, 0.1, 0.25, 0.3, 0.6, 0.7})}};
}

/// Values at the centres of all padded cells, ghosts included.
std::vector<double> padded(const Grid& grid, double (*f)(const Vec3d&)) {
    const exchange::Layout& layout = grid.view().layout;
    std::vector<double> values(layout.size);
    std::array<std::vector<double>, 3> centres;
    for (std::size_t a = 0; a < 3; ++a) {
        const auto& widths = grid.ghosted_widths(static_cast<int>(a));
        double face = grid.rectilinear().axes[a].lower() - widths[0] - widths[1];
        for (const double w : widths) centres[a].push_back(face + w / 2), face += w;
    }
    for (std::size_t k = 0; k < centres[2].size(); ++k)
        for (std::size_t j = 0; j < centres[1].size(); ++j)
            for (std::size_t i = 0; i < centres[0].size(); ++i)
                values[layout.at(static_cast<std::ptrdiff_t>(i) - 2, static_cast<std::ptrdiff_t>(j) - 2,
                                 static_cast<std::ptrdiff_t>(k) - 2)] =
                    f({centres[0][i], centres[1][j], centres[2][k]});
    return values;
}

TEST(GridInterpolant, ExactForCubicsFromInsideAlone) {
    const Grid grid(stretched(), {false, false, false});
    const GridInterpolant f(grid, padded(grid, cubic), {});
    for (const Vec3d& x : {Vec3d{-1, 0, 0}, {1.97, 0.99, 0.69}, {0.4, 0.33, 0.27}, {-0.2, 0.9, 0.05}})
        EXPECT_NEAR(f(x), cubic(x), 1e-12);
}

TEST(GridInterpolant, TakesTheValueOfASideFromItsGhosts) {
    const Grid grid(stretched(), {false, false, false});
    // zero on the sides, anything inside: ghosts are minus their mirror cells
    std::vector<double> inside(grid.view().layout.cells());
    for (std::size_t c = 0; c < inside.size(); ++c) inside[c] = std::sin(1.0 + static_cast<double>(c));
    std::array<Border, 6> faces;
    faces.fill(Border::face);
    const GridInterpolant f(grid, padded_field(grid, inside, -1), faces);
    for (const Vec3d& x :
         {Vec3d{-1, 0.4, 0.2}, {2, 0.7, 0.1}, {0.3, 0, 0.4}, {0.3, 1, 0.4}, {0.1, 0.2, 0}, {2, 1, 0.7}})
        EXPECT_NEAR(f(x), 0, 1e-13);
    EXPECT_GT(std::abs(f({0.4, 0.33, 0.27})), 1e-3);
}

TEST(GridInterpolant, PeriodicAxesHaveNoEnds) {
    const meshing::RectilinearGrid box{
        {meshing::uniform_axis(0, 1, 40), meshing::uniform_axis(0, 1, 1), meshing::uniform_axis(0, 1, 1)}};
    Patches patches;
    patches.fill(periodic_patch());
    SolverOptions options;
    options.nu = 0.1;
    Solver solver(box, patches, options);
    const auto u = [](double x) { return 0.1 * std::sin(2 * M_PI * x); };
    solver.initialise([&](const Vec3d& x) { return FlowPoint{1, {0, u(x.x), 0}}; });
    const auto probe = make_probe(solver);
    double worst = 0;
    for (double x = 0; x <= 1; x += 0.01)
        worst = std::max(worst, std::abs((*probe)({x, 0.3, 0.9})[2] - u(x)));
    EXPECT_LT(worst, 0.1 * std::pow(2 * M_PI / 40, 4) * 0.025);  // error of a cubic: 3/128 h^4 f''''
}

TEST(Probe, ExactForQuadraticsBetweenWallsOnAStretchedGrid) {
    // plane Poiseuille flow: the walls' value 0 and the parabola inside
    const meshing::RectilinearGrid box{
        {meshing::uniform_axis(0, 1, 3), meshing::chebyshev_axis(-1, 1, 12), meshing::uniform_axis(0, 1, 1)}};
    Patches patches;
    patches.fill(periodic_patch());
    patches[2] = patches[3] = wall_patch();
    SolverOptions options;
    options.nu = 0.1;
    Solver solver(box, patches, options);
    solver.initialise([](const Vec3d& x) {
        return FlowPoint{1 + 0.02 * x.y * x.y, {0.1 * (1 - x.y * x.y), 0, 0}};
    });
    const auto probe = make_probe(static_cast<const Flow&>(solver));
    for (double y = -1; y <= 1; y += 0.03125) {
        const auto q = (*probe)({0.2, y, 0.5});
        EXPECT_NEAR(q[0], 1 + 0.02 * y * y, 1e-14);
        EXPECT_NEAR(q[1], 0.1 * (1 - y * y), 1e-14);
    }
}

}  // namespace
}  // namespace hemoflux::fluid

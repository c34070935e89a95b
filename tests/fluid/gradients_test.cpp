#include <gtest/gtest.h>

#include "fluid/solver.hpp"
#include "fluid/vorticity.hpp"

namespace hemoflux::fluid {
namespace {

TEST(Gradients, ExactForQuadraticsAwayFromTheSidesOfAStretchedGrid) {
    Patches patches;
    for (Patch& p : patches) p = open_patch();
    SolverOptions options;
    options.nu = 0.1;
    Solver solver({{meshing::chebyshev_axis(0, 1, 8), meshing::chebyshev_axis(0, 2, 7),
                    meshing::uniform_axis(0, 1, 5)}},
                  patches, options);
    solver.initialise([](const Vec3d& x) {
        return FlowPoint{
            1 + 0.01 * x.x * x.x,
            {0.02 * x.y * x.y - 0.01 * x.z, 0.03 * x.x * x.x + 0.01 * x.z * x.z, 0.05 * x.y + 0.02 * x.x}};
    });
    const auto gradients = solver.gradients();
    const auto zeta = vorticity(gradients);
    std::size_t inside = 0;
    for (std::size_t c = 0; c < solver.cells(); ++c) {
        const std::size_t i = c % 8, j = c / 8 % 7, k = c / 56;
        if (i % 7 == 0 || j % 6 == 0 || k % 4 == 0) continue;
        ++inside;
        const Vec3d x = solver.centre(c);
        EXPECT_NEAR(gradients[c][0].x, 0.02 * x.x, 1e-14);
        EXPECT_NEAR(gradients[c][1].y, 0.04 * x.y, 1e-14);
        EXPECT_NEAR(gradients[c][1].z, -0.01, 1e-14);
        EXPECT_NEAR(zeta[c].x, 0.05 - 0.02 * x.z, 1e-14);
        EXPECT_NEAR(zeta[c].y, -0.01 - 0.02, 1e-14);
        EXPECT_NEAR(zeta[c].z, 0.06 * x.x - 0.04 * x.y, 1e-14);
    }
    EXPECT_EQ(inside, 6u * 5 * 3);
}

}  // namespace
}  // namespace hemoflux::fluid

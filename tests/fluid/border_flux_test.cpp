#include "fluid/border_flux.hpp"

#include <gtest/gtest.h>

#include "fluid/solver.hpp"

namespace hemoflux::fluid {

TEST(BorderFlux, IsTheViscousStressOfShearAndThePressure) {
    meshing::RectilinearGrid grid;
    grid.axes = {meshing::uniform_axis(0, 3, 6), meshing::explicit_axis({0, 0.4, 1, 1.5, 2.2, 2.5}),
                 meshing::uniform_axis(0, 2, 5)};
    constexpr double rate = 0.01, nu = 0.3;
    Patches patches;
    patches.fill(periodic_patch());
    patches[2] = patches[3] = velocity_patch([](const Vec3d& x) { return Vec3d{rate * x.y, 0, 0}; });
    SolverOptions o;
    o.nu = nu;
    o.scheme = Scheme::factored;
    Solver solver(grid, patches, o);
    solver.initialise([](const Vec3d& x) { return FlowPoint{1, {rate * x.y, 0, 0}}; });
    const auto flux = solver.border_momentum();
    EXPECT_NEAR(flux[2].x, nu * rate * 6, 1e-5 * nu * rate * 6);
    EXPECT_NEAR(flux[3].x, -nu * rate * 6, 1e-5 * nu * rate * 6);
    EXPECT_NEAR(flux[3].y, 6.0 / 3, 1e-3);
    EXPECT_NEAR(flux[2].y, -6.0 / 3, 1e-3);
    for (const std::size_t side : {0, 1, 4, 5}) EXPECT_EQ(norm(flux[side]), 0);
}

}  // namespace hemoflux::fluid

#include "fluid/hex_probe.hpp"

#include <gtest/gtest.h>

#include "fluid/hex_solver.hpp"
#include "fluid/probe.hpp"
#include "tests/fluid/hex_flows.hpp"

namespace hemoflux::fluid {
namespace {

Vec3d quadratic(const Vec3d& x) {
    return {0.02 * x.x * x.x - 0.01 * x.y * x.z, 0.01 + 0.03 * x.y * x.y - 0.02 * x.x, 0.01 * x.z * x.x};
}

TEST(HexProbe, ExactForQuadraticsOnSkewedCellsAndOnWalls) {
    meshing::BoxDistortion distortion;
    distortion.random = 0.3;
    Patches patches;
    patches.fill(velocity_patch(quadratic));
    patches[0].density = DensityCondition::given;
    patches[0].density_profile = [](const Vec3d& x) { return 1 + 0.01 * x.y * x.y; };
    patches[1].velocity = VelocityCondition::zero_gradient;
    SolverOptions options;
    options.nu = 0.01;
    HexSolver solver(test::box_grid({1, 2, 1}, {7, 8, 6}, "", distortion), test::by_name(patches), options);
    solver.initialise([](const Vec3d& x) { return FlowPoint{1 + 0.01 * x.y * x.y, quadratic(x)}; });
    const auto probe = make_probe(static_cast<const Flow&>(solver));
    for (const Vec3d& x :
         {Vec3d{0.5, 1, 0.5}, {0.01, 0.03, 0.98}, {0, 1.1, 0.4}, {0.3, 2, 0.7}, {0.97, 0.02, 0.03}}) {
        const auto q = (*probe)(x);
        const Vec3d u = quadratic(x);
        EXPECT_NEAR(q[0], 1 + 0.01 * x.y * x.y, 1e-12);
        EXPECT_NEAR(q[1], u.x, 1e-12);
        EXPECT_NEAR(q[2], u.y, 1e-12);
        EXPECT_NEAR(q[3], u.z, 1e-12);
    }
}

TEST(HexProbe, ExactForPlaneQuadraticsInFlatCellsOneCellThick) {
    const meshing::RectilinearGrid box{{meshing::uniform_axis(0, 1, 6), meshing::chebyshev_axis(0, 1, 40),
                                        meshing::uniform_axis(0, 0.3, 1)}};
    Patches patches;
    patches[4] = patches[5] = periodic_patch();
    patches[0] = patches[1] = open_patch();
    SolverOptions options;
    options.nu = 0.01;
    HexSolver solver(meshing::make_hex_grid(meshing::box_mesh(box), test::pairs("z")), test::by_name(patches),
                     options);
    const auto u = [](const Vec3d& x) { return 0.1 * x.y * (1 - x.y); };
    solver.initialise([&](const Vec3d& x) { return FlowPoint{1 + 0.01 * x.x * x.y, {u(x), 0, 0}}; });
    const auto probe = make_probe(solver);
    for (const Vec3d& x : {Vec3d{0.5, 0.5, 0.1}, {0.02, 0.001, 0.3}, {0.9, 0, 0}, {0.41, 0.9999, 0.2}}) {
        EXPECT_NEAR((*probe)(x)[0], 1 + 0.01 * x.x * x.y, 1e-12);
        EXPECT_NEAR((*probe)(x)[1], u(x), 1e-12);
    }
}

double worst_error(int n) {
    const auto f = [](const Vec3d& x) { return 0.1 * std::sin(3 * x.x) * std::cos(2 * x.y + x.z); };
    Patches patches;
    patches.fill(open_patch());
    SolverOptions options;
    options.nu = 0.01;
    meshing::BoxDistortion distortion;
    distortion.skew = 0.05;
    HexSolver solver(test::box_grid({1, 1, 1}, {n, n, n}, "", distortion), test::by_name(patches), options);
    solver.initialise([&](const Vec3d& x) { return FlowPoint{1, {f(x), 0, 0}}; });
    const auto probe = make_probe(solver);
    double worst = 0;
    for (int i = 0; i <= 20; ++i)
        for (int j = 0; j <= 20; ++j) {
            const Vec3d x{0.05 * i, 0.05 * j, 0.45};
            worst = std::max(worst, std::abs((*probe)(x)[1] - f(x)));
        }
    return worst;
}

TEST(HexProbe, ThirdOrderOnSmoothlySkewedCells) {
    const double coarse = worst_error(8), fine = worst_error(16);
    EXPECT_GT(std::log2(coarse / fine), 2.7);
    EXPECT_LT(fine, 0.1 * 27 / std::pow(16, 3));  // f''' h^3
}

}  // namespace
}  // namespace hemoflux::fluid

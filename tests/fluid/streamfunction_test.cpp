#include "fluid/streamfunction.hpp"

#include <gtest/gtest.h>

#include "exchange/error.hpp"
#include "fluid/solver.hpp"
#include "tests/fluid/flows.hpp"

namespace hemoflux::fluid {
namespace {

/// A closed square: psi = -A sin^2(pi x) sin^2(pi y), no slip on all sides.
double psi_closed(double x, double y) { return -0.01 * std::pow(std::sin(M_PI * x) * std::sin(M_PI * y), 2); }

Solver square_solver(const meshing::Axis& x, const meshing::Axis& y, const Patches& patches) {
    SolverOptions options;
    options.nu = 0.01;
    return Solver({{x, y, meshing::uniform_axis(0, 0.1, 1)}}, patches, options);
}

Patches walls() {
    Patches patches;
    patches[4] = patches[5] = periodic_patch();
    return patches;
}

double closed_error(int n) {
    Solver solver = square_solver(meshing::chebyshev_axis(0, 1, n), meshing::uniform_axis(0, 1, n), walls());
    solver.initialise([](const Vec3d& x) {
        const double sx = std::sin(M_PI * x.x), sy = std::sin(M_PI * x.y);
        return FlowPoint{1,
                         {-0.01 * M_PI * sx * sx * std::sin(2 * M_PI * x.y),
                          0.01 * M_PI * std::sin(2 * M_PI * x.x) * sy * sy, 0}};
    });
    const PlaneField psi = streamfunction(solver);
    double worst = 0;
    for (std::size_t c = 0; c < psi.values.size(); ++c) {
        const Vec3d at = solver.centre(c);
        worst = std::max(worst, std::abs(psi.values[c] - psi_closed(at.x, at.y)) / 0.01);
    }
    return worst;
}

TEST(Streamfunction, SecondOrderInAClosedSquareOnAStretchedGrid) {
    test::ConvergenceTable table("streamfunction");
    table.add(1.0 / 20, closed_error(20));
    EXPECT_GE(table.add(1.0 / 40, closed_error(40)), 1.9);
    const double error = closed_error(80);
    EXPECT_GE(table.add(1.0 / 80, error), 1.9);
    EXPECT_LT(error, 2e-3);
}

TEST(Streamfunction, CountsTheFluxThroughOpenSides) {
    // uniform stream at an angle: psi = u y - v x, exact
    const auto stream = [](const Vec3d&) { return Vec3d{0.03, 0.02, 0}; };
    Patches patches = walls();
    for (std::size_t p = 0; p < 4; ++p) patches[p] = velocity_patch(stream);
    Solver solver = square_solver(meshing::chebyshev_axis(-1, 1, 7), meshing::uniform_axis(2, 3, 6), patches);
    solver.initialise([&](const Vec3d& x) { return FlowPoint{1, stream(x)}; });
    const PlaneField psi = streamfunction(solver);
    for (std::size_t c = 0; c < psi.values.size(); ++c) {
        const Vec3d at = solver.centre(c);
        EXPECT_NEAR(psi.values[c], 0.03 * (at.y - 2) - 0.02 * (at.x + 1), 1e-15);
    }
}

TEST(Streamfunction, RefusesPeriodicPlanes) {
    Patches patches = walls();
    patches[0] = patches[1] = periodic_patch();
    const Solver solver =
        square_solver(meshing::uniform_axis(0, 1, 4), meshing::uniform_axis(0, 1, 4), patches);
    EXPECT_THROW((void)streamfunction(solver), InputError);
}

}  // namespace
}  // namespace hemoflux::fluid

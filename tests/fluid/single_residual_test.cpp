#include "fluid/single_residual.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exchange/backend.hpp"
#include "exchange/error.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::fluid {
namespace {

constexpr double turn = 2 * M_PI;

SolverOptions options(bool single, double nu) {
    SolverOptions o;
    o.nu = nu;
    o.single_precision = single;
    return o;
}

meshing::RectilinearGrid cubes(int nx, int ny, int nz) {
    return {{meshing::uniform_axis(0, nx, nx), meshing::uniform_axis(0, ny, ny),
             meshing::uniform_axis(0, nz, nz)}};
}

Patches all(const Patch& patch) {
    Patches p;
    p.fill(patch);
    return p;
}

/// Root mean square of a - b over that of b.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double error = 0, size = 0;
    for (std::size_t i = 0; i < a.size(); ++i) error += (a[i] - b[i]) * (a[i] - b[i]), size += b[i] * b[i];
    return std::sqrt(error / size);
}

std::vector<double> residual(const Solver& solver, std::size_t component) {
    return solver.residual().interior(solver.residual().view().q[component]);
}

/// A vortex flow of Mach 0.09 with a density wave, on cells that are no whole number of packs.
FlowPoint vortices(const Vec3d& x) {
    const double a = turn * x.x / 27, b = turn * x.y / 22, c = turn * x.z / 19;
    return {1 + 0.002 * std::cos(2 * a) * std::cos(b),
            {0.05 * std::sin(a) * std::cos(b), -0.05 * std::cos(a) * std::sin(b),
             0.03 * std::sin(b) * std::cos(c)}};
}

}  // namespace

class SingleResidualWith : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Gamma, SingleResidualWith, ::testing::Values(1.0, 0.3));

// Every step of the residual rounds to 6e-8 of fluxes of about rho u; their differences over a cell are a tenth
// to a hundredth of them.
TEST_P(SingleResidualWith, IsCloseToDouble) {
    for (const bool walls : {false, true}) {
        const Patches patches = all(walls ? velocity_patch([](const Vec3d& x) {
            return Vec3d{0.001 * std::sin(turn * x.y / 22), 0, 0};
        })
                                          : periodic_patch());
        SolverOptions wide = options(false, 0.3), narrow = options(true, 0.3);
        wide.gamma = narrow.gamma = GetParam();
        Solver exact(cubes(27, 22, 19), patches, wide), rounded(cubes(27, 22, 19), patches, narrow);
        exact.initialise(vortices);
        rounded.initialise(vortices);
        exact.evaluate();
        rounded.evaluate();
        for (std::size_t c = 0; c < 4; ++c) {
            const double error = difference(residual(rounded, c), residual(exact, c));
            EXPECT_LT(error, c == 0 ? 2e-6 : 1e-5) << c << " walls " << walls;
            EXPECT_GT(error, 1e-9) << "not in single precision at all";
            RecordProperty("error_" + std::to_string(c), std::to_string(error));
        }
    }
}

TEST(SingleResidual, IsBitwiseTheSameForAnyNumberOfThreads) {
    Solver solver(cubes(27, 22, 19), all(periodic_patch()), options(true, 0.3));
    solver.initialise(vortices);
    exchange::set_threads(1);
    solver.evaluate();
    const auto one = residual(solver, 1);
    exchange::set_threads(3);
    solver.evaluate();
    EXPECT_EQ(residual(solver, 1), one);
    exchange::set_threads(0);
}

// The decay of the Taylor-Green vortex, where the discretisation's error is far above what rounding adds.
TEST(SingleResidual, TaylorGreenKeepsItsError) {
    const int n = 32;
    const double u0 = 0.02, nu = 0.2, k = turn / n;
    const auto start = [&](const Vec3d& x) {
        const double a = k * x.x, b = k * x.y;
        return FlowPoint{1 - 0.75 * u0 * u0 * (std::cos(2 * a) + std::cos(2 * b)),
                         {-u0 * std::cos(a) * std::sin(b), u0 * std::sin(a) * std::cos(b), 0}};
    };
    const double dt = 0.5;
    const int steps = 100;
    const double decay = std::exp(-2 * nu * k * k * dt * steps);
    std::vector<double> errors;
    for (const bool single : {false, true}) {
        Solver solver(cubes(n, n, 1), all(periodic_patch()), options(single, nu));
        solver.initialise(start);
        for (int s = 0; s < steps; ++s) solver.step(dt);
        const std::vector<double> u = solver.values(1);
        std::vector<double> exact;
        for (std::size_t i = 0; i < u.size(); ++i)
            exact.push_back(decay * start(solver.centre(i)).velocity.x);
        errors.push_back(difference(u, exact));
    }
    EXPECT_LT(errors[0], 0.01);
    EXPECT_NEAR(errors[1], errors[0], 1e-5);
}

TEST(SingleResidual, RefusesWhatItCannotDo) {
    SolverOptions force = options(true, 0.3);
    force.with_force = true;
    EXPECT_THROW(Solver(cubes(8, 8, 8), all(periodic_patch()), force), InputError);
    const meshing::RectilinearGrid boxes{
        {meshing::uniform_axis(0, 8, 8), meshing::uniform_axis(0, 9, 8), meshing::uniform_axis(0, 8, 8)}};
    EXPECT_THROW(Solver(boxes, all(periodic_patch()), options(true, 0.3)), InputError);
}

}  // namespace hemoflux::fluid

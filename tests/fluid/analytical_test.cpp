#include "fluid/analytical.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "flows.hpp"
#include "fluid/solver.hpp"

namespace hemoflux::fluid {
namespace {

/// Central differences of a velocity field.
struct Derivatives {
    const ExactFlow& flow;
    static constexpr double h = 1e-4;
    [[nodiscard]] Vec3d d(const Vec3d& x, double t, const Vec3d& e) const {
        return (0.5 / h) * (flow(x + h * e, t).velocity - flow(x - h * e, t).velocity);
    }
    [[nodiscard]] Vec3d laplacian(const Vec3d& x, double t) const {
        Vec3d sum{0, 0, 0};
        for (const Vec3d& e : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}})
            sum += (1 / (h * h)) *
                   (flow(x + h * e, t).velocity + flow(x - h * e, t).velocity - 2.0 * flow(x, t).velocity);
        return sum;
    }
    [[nodiscard]] Vec3d pressure_gradient(const Vec3d& x, double t) const {
        const auto d = [&](const Vec3d& e) {
            return (flow(x + h * e, t).density - flow(x - h * e, t).density) / (6 * h);
        };
        return {d({1, 0, 0}), d({0, 1, 0}), d({0, 0, 1})};
    }
    /// du/dt + u.grad u + grad p - nu laplace u - f
    [[nodiscard]] Vec3d navier_stokes(const Vec3d& x, double t, double nu, const Vec3d& f) const {
        const Vec3d u = flow(x, t).velocity;
        const Vec3d rate = (0.5 / h) * (flow(x, t + h).velocity - flow(x, t - h).velocity);
        return rate + u.x * d(x, t, {1, 0, 0}) + u.y * d(x, t, {0, 1, 0}) + u.z * d(x, t, {0, 0, 1}) +
               pressure_gradient(x, t) - nu * laplacian(x, t) - f;
    }
};

const Vec3d places[] = {{0.1, 0.2, 0}, {0.33, 0.71, 0.2}, {0.9, 0.45, 0.5}};

}  // namespace

TEST(Analytical, TaylorGreenSolvesNavierStokes) {
    const double nu = 0.05;
    const ExactFlow flow = TaylorGreen{0.7, 6, 4, nu};
    const Derivatives of{flow};
    for (const Vec3d& x : places) {
        EXPECT_NEAR(of.d(x, 0.3, {1, 0, 0}).x + of.d(x, 0.3, {0, 1, 0}).y, 0, 1e-6);
        EXPECT_LT(norm(of.navier_stokes(x, 0.3, nu, {0, 0, 0})), 1e-5);
    }
    const TaylorGreen tg{0.7, 6, 4, nu};
    EXPECT_NEAR(norm(tg(places[0], tg.decay_time()).velocity) / norm(tg(places[0], 0).velocity),
                std::exp(-1.0), 1e-14);
}

TEST(Analytical, WomersleySolvesNavierStokesAtAnyNumber) {
    for (const double wo : {0.5, 4.0, 10.0, 60.0}) {
        const double nu = 0.1, a = 0.5, omega = wo * wo * nu / (a * a), force = 0.3, phase = 0.4;
        const Womersley w{force, omega, phase, nu, 0.5, a};
        EXPECT_NEAR(w.number(), wo, 1e-12 * wo);
        const ExactFlow flow = w;
        const Derivatives of{flow};
        for (const Vec3d& x : places) {
            const double t = 0.37 * w.period();
            EXPECT_LT(norm(of.navier_stokes(x, t, nu, {force * std::cos(omega * t + phase), 0, 0})),
                      1e-4 * std::max(1.0, omega))
                << wo;
        }
        EXPECT_NEAR(flow({0, 1, 0}, 0.1).velocity.x, 0, 1e-15);
        EXPECT_NEAR(flow({0, 0, 0}, 0.1).velocity.x, 0, 1e-15);
    }
    // slowly driven, it is Poiseuille's flow; at Wo = 1000 the core swings freely
    const Womersley slow{0.3, 1e-6, 0, 0.1, 0.5, 0.5};
    EXPECT_NEAR(slow({0, 0.3, 0}, 0).velocity.x,
                Poiseuille({0.3 / (8 * 0.1), 0, 1})({0, 0.3, 0}, 0).velocity.x, 1e-7);
    const Womersley fast{1, 4e5, 0, 0.1, 0.5, 0.5};
    EXPECT_NEAR(fast({0, 0.5, 0}, std::numbers::pi / 2 / fast.omega).velocity.x, 1 / fast.omega, 1e-18);
}

TEST(Analytical, ChannelFlowsMeetTheirWalls) {
    const Couette couette{0.2, -1, 4};
    EXPECT_EQ(couette({7, -1, 0}, 3).velocity.x, 0);
    EXPECT_EQ(couette({7, 3, 0}, 3).velocity.x, 0.2);
    const ExactFlow flow = Poiseuille{0.2, -1, 4};
    EXPECT_EQ(flow({7, 3, 0}, 3).velocity.x, 0);
    EXPECT_EQ(flow({7, 1, 0}, 3).velocity.x, 0.2);
    const double nu = 0.3;
    EXPECT_LT(norm(Derivatives{flow}.navier_stokes(places[1], 0, nu, {8 * nu * 0.2 / 16, 0, 0})), 1e-6);
}

TEST(Analytical, ErrorNorms) {
    Patches p;
    p.fill(periodic_patch());
    SolverOptions o;
    o.nu = 0.1;
    meshing::RectilinearGrid grid;
    grid.axes = {meshing::explicit_axis({0, 1, 4}), meshing::uniform_axis(0, 1, 1),
                 meshing::uniform_axis(0, 1, 1)};
    Solver solver(grid, p, o);
    // volumes 1 and 3; exact speeds 0.1 and 0.2, errors 0.01 and 0.02 across them
    const ExactFlow exact = [](const Vec3d& x, double) {
        return FlowPoint{x.x < 1 ? 1.02 : 0.99, {x.x < 1 ? 0.1 : 0.2, 0, 0}};
    };
    solver.initialise([](const Vec3d& x) {
        return x.x < 1 ? FlowPoint{1.04, {0.1, 0.01, 0}} : FlowPoint{1.0, {0.2, 0, 0.02}};
    });
    const VelocityError e = velocity_error(solver, exact, 0);
    EXPECT_NEAR(e.relative, 0.1, 1e-15);
    EXPECT_NEAR(e.total, 0.1 * std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(e.largest, 0.1, 1e-15);
    EXPECT_NEAR(e.norm, std::sqrt(0.13 / 4), 1e-15);
    EXPECT_NEAR(e.absolute, std::sqrt(0.0013 / 4), 1e-15);
    // about their means: 0.03, -0.01 against 0.0225, -0.0075
    EXPECT_NEAR(density_error(solver, exact, 0), 1.0 / 3, 1e-12);
    EXPECT_TRUE(std::isnan(density_error(solver, Couette{1, 0, 1}, 0)));
}

/// Error of the flow between plates after a quarter period, started from the exact solution. Driven by an oscillating
/// force, by walls that move with the fluid in its frame, or both halved.
double womersley_error(int cells, int steps, bool moving_walls, const std::vector<double>* reference,
                       std::vector<double>* result) {
    const Womersley w{0.02, 1.0, 0.3, 0.01, 0.5, 0.5};
    SolverOptions o;
    o.nu = w.nu;
    o.with_force = true;
    if (!moving_walls) o.oscillating_force = {{w.amplitude, 0, 0}, w.omega, w.phase};
    // In the frame of the freely swinging fluid there is no force, and the walls swing backwards.
    const auto frame = [w](double t) {
        return Vec3d{-w.amplitude / w.omega * std::sin(w.omega * t + w.phase), 0, 0};
    };
    Patches p;
    p.fill(periodic_patch());
    p[2] = p[3] = wall_patch();
    if (moving_walls)
        p[2].unsteady_velocity =
            p[3].unsteady_velocity = [frame](const Vec3d&, double t) { return frame(t); };
    meshing::RectilinearGrid grid;
    const double h = 1.0 / cells;
    grid.axes = {meshing::uniform_axis(0, 2 * h, 2), meshing::uniform_axis(0, 1, cells),
                 meshing::uniform_axis(0, h, 1)};
    Solver solver(grid, p, o);
    const ExactFlow exact = [&](const Vec3d& x, double t) {
        FlowPoint at = w(x, t);
        if (moving_walls) at.velocity += frame(t);
        return at;
    };
    solver.initialise([&](const Vec3d& x) { return exact(x, 0); });
    const double end = w.period() / 4;
    for (int s = 0; s < steps; ++s) solver.step(end / steps);
    EXPECT_NEAR(solver.time(), end, 1e-12);
    if (result) *result = solver.values(1);
    if (!reference) return velocity_error(solver, exact, end).relative;
    double sum = 0;
    const auto u = solver.values(1);
    for (std::size_t i = 0; i < u.size(); ++i) sum += (u[i] - (*reference)[i]) * (u[i] - (*reference)[i]);
    return std::sqrt(sum);
}

class UnsteadyChannel : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(DrivenByForceOrWalls, UnsteadyChannel, ::testing::Bool());

TEST_P(UnsteadyChannel, IsSecondOrderInSpace) {
    test::ConvergenceTable table("Womersley, quarter period, error of u");
    double order = 0;
    for (const int n : {8, 16, 32})
        order = table.add(1.0 / n, womersley_error(n, 20 * n, GetParam(), nullptr, nullptr));
    EXPECT_GE(order, 1.95);
}

// A condition frozen over a step, or taken at the wrong stage, would leave first or second order.
TEST_P(UnsteadyChannel, IsFourthOrderInTime) {
    test::ConvergenceTable table("Womersley, quarter period, time error");
    std::vector<double> reference;
    womersley_error(8, 1600, GetParam(), nullptr, &reference);
    double order = 0;
    for (const int steps : {25, 50, 100})
        order = table.add(1.0 / steps, womersley_error(8, steps, GetParam(), &reference, nullptr));
    EXPECT_GE(order, 3.9);
}

}  // namespace hemoflux::fluid

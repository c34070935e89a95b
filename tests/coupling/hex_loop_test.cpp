#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "coupling/loop.hpp"
#include "coupling/rigid_body.hpp"
#include "exchange/backend.hpp"
#include "exchange/error.hpp"
#include "hex_grids.hpp"
#include "membrane/shapes.hpp"
#include "meshing/icosphere.hpp"

namespace hemoflux::coupling {
namespace {

/// A periodic box of n^3 unit cells about the origin, straight or as hexahedra; what a loop needs.
struct Fluid {
    std::unique_ptr<fluid::Solver> straight;
    std::unique_ptr<fluid::HexSolver> hex;
    fluid::Flow* flow = nullptr;

    Fluid(int n, double width, bool hexahedra, fluid::SolverOptions o, double random = 0) {
        o.with_force = true;
        o.scheme = fluid::Scheme::euler;
        const double half = n * width / 2;
        const auto axis = meshing::uniform_axis(-half, half, n);
        const meshing::RectilinearGrid box{{axis, axis, axis}};
        if (!hexahedra) {
            fluid::Patches patches;
            patches.fill(fluid::periodic_patch());
            straight = std::make_unique<fluid::Solver>(box, patches, o);
            flow = straight.get();
            return;
        }
        meshing::BoxDistortion d;
        d.random = random;
        d.shuffle = true;
        hex = std::make_unique<fluid::HexSolver>(
            meshing::make_hex_grid(meshing::box_mesh(box, d), {{"x-", "x+"}, {"y-", "y+"}, {"z-", "z+"}}),
            fluid::HexPatches{}, o);
        flow = hex.get();
    }
    std::unique_ptr<Loop> loop(Kernel kernel) const {
        return hex ? std::make_unique<Loop>(*hex, kernel) : std::make_unique<Loop>(*straight, kernel);
    }
    std::unique_ptr<Loop> loop(membrane::Batch& cells, const LoopOptions& o) const {
        return hex ? std::make_unique<Loop>(*hex, cells, o) : std::make_unique<Loop>(*straight, cells, o);
    }
    [[nodiscard]] Vec3d momentum() const {
        const auto rho = flow->values(0);
        double m[3] = {0, 0, 0};
        for (int q = 0; q < 3; ++q) {
            const auto u = flow->values(q + 1);
            for (std::size_t i = 0; i < u.size(); ++i) m[q] += flow->volume(i) * rho[i] * u[i];
        }
        return {m[0], m[1], m[2]};
    }
};

/// A sphere that is held in a fluid driven by a force.
struct HeldSphere {
    Fluid fluid;
    std::unique_ptr<Loop> loop;
    std::unique_ptr<RigidBody> body;

    HeldSphere(bool hexahedra, BodyFreedom freedom, BodyForcing forcing, double random = 0,
               Kernel kernel = Kernel::phi3)
        : fluid(12, 1, hexahedra, options(), random), loop(fluid.loop(kernel)) {
        BodyOptions o;
        o.freedom = freedom;
        o.forcing = forcing;
        BodySurface surface = closed_surface(meshing::icosphere(2, 2.6));
        retract(surface, loop->grid(), {0, 0, 0}, 0.3);
        BodyState start;
        start.velocity = {0.002, 0.001, 0};
        start.angular_velocity = {0, 0, 0.003};
        body = std::make_unique<RigidBody>(std::move(surface), loop->grid(), o, start);
        loop->add(*body);
        fluid.flow->initialise([](const Vec3d& x) {
            return fluid::FlowPoint{1, {0.01 + 0.002 * std::sin(0.5 * x.y), 0, 0.001 * std::cos(0.5 * x.x)}};
        });
    }
    static fluid::SolverOptions options() {
        fluid::SolverOptions o;
        o.nu = 0.4;
        o.uniform_force[0] = 1e-5;
        return o;
    }
    void run(int steps) {
        for (int i = 0; i < steps; ++i) loop->step(0.2);
    }
};

/// A cell with its own cytosol.
struct Cell {
    std::unique_ptr<membrane::Batch> cells;
    Fluid fluid;
    std::unique_ptr<Loop> loop;

    explicit Cell(bool hexahedra, Kernel kernel = Kernel::phi3) : fluid(18, 0.6, hexahedra, options()) {
        static const membrane::Cell cell = membrane::make_discocyte(2);
        cells = std::make_unique<membrane::Batch>(cell.topology, cell.parameters, cell.reference, 1);
        cells->set_positions(0, cell.positions);
        LoopOptions o;
        o.kernel = kernel;
        o.force_factor = 0.05;
        o.nu_inside = {0.1};
        loop = fluid.loop(*cells, o);
        fluid.flow->initialise([](const Vec3d& x) {
            return fluid::FlowPoint{1, {0.02 * std::sin(0.5818 * x.y), 0.01 * std::cos(0.5818 * x.z), 0}};
        });
    }
    static fluid::SolverOptions options() {
        fluid::SolverOptions o;
        o.nu = 0.3;
        o.with_viscosity = true;
        return o;
    }
    [[nodiscard]] std::vector<double> state() const {
        std::vector<double> all = cells->x().to_host();
        for (const auto& part : {cells->y().to_host(), cells->z().to_host()})
            all.insert(all.end(), part.begin(), part.end());
        return all;
    }
};

class HexLoop : public testing::Test {
  protected:
    void SetUp() override { exchange::set_threads(1); }
    void TearDown() override { exchange::set_threads(0); }
};

}  // namespace

// On equal cells, with a smooth kernel, everything is the same: bodies that are moved or free, both ways to force them.
TEST_F(HexLoop, BodiesMoveOnHexahedraAsOnRowsOfEqualCells) {
    for (const BodyFreedom freedom : {BodyFreedom::prescribed, BodyFreedom::free})
        for (const BodyForcing forcing : {BodyForcing::direct, BodyForcing::feedback}) {
            HeldSphere a(false, freedom, forcing), b(true, freedom, forcing);
            a.run(30);
            b.run(30);
            const BodyForces fa = a.body->fluid_forces(), fb = b.body->fluid_forces();
            EXPECT_GT(norm(fa.force), 1e-4);
            EXPECT_LT(norm(fa.force - fb.force), 1e-10 + 1e-9 * norm(fa.force));
            EXPECT_LT(norm(fa.torque - fb.torque), 1e-10 + 1e-9 * norm(fa.torque));
            EXPECT_LT(norm(a.body->state().centre - b.body->state().centre), 1e-10);
            EXPECT_NEAR(a.body->slip(), b.body->slip(), 1e-10);
            b.loop->check();
        }
}

// Zuzovsky, Adler and Brenner (1983), as for rows in rigid_body_test.cpp. On equal cells phi3 is that of rows; the
// windows of `lagrange` reach further than its cubic weights on rows, and so does its surface, by 0.07 cells.
TEST_F(HexLoop, TorqueOnATurningSphere) {
    const auto torque = [](Kernel kernel, bool hexahedra, double retraction) {
        fluid::SolverOptions o;
        o.nu = 0.5;
        const Fluid f(16, 1, hexahedra, o);
        const auto loop = f.loop(kernel);
        BodySurface surface = closed_surface(meshing::icosphere(2, 4));
        retract(surface, loop->grid(), {0, 0, 0}, retraction);
        BodyState start;
        start.angular_velocity = {0, 0, 0.002};
        RigidBody body(std::move(surface), loop->grid(), BodyOptions{}, start);
        loop->add(body);
        f.flow->initialise([](const Vec3d&) { return fluid::FlowPoint{1, {0, 0, 0}}; });
        for (int i = 0; i < 700; ++i) loop->step(0.2);
        const double c = 4.0 / 3 * std::numbers::pi * 64 / 4096;
        return -body.fluid_forces().torque.z * (1 - c) / (8 * std::numbers::pi * 0.5 * 64 * 0.002);
    };
    EXPECT_NEAR(torque(Kernel::lagrange, true, 0.19), 1, 0.02);
    EXPECT_NEAR(torque(Kernel::lagrange, false, 0.12), 1, 0.02);
    EXPECT_GT(torque(Kernel::lagrange, true, 0.12), 1.03);
    const double of_rows = torque(Kernel::phi3, false, 0.38);
    EXPECT_NEAR(torque(Kernel::phi3, true, 0.38), of_rows, 1e-9 * of_rows);
}

TEST_F(HexLoop, CellsMoveOnHexahedraAsOnRowsOfEqualCells) {
    Cell a(false), b(true);
    const auto before = a.state();
    for (int s = 0; s < 60; ++s) a.loop->step(0.1), b.loop->step(0.1);
    b.loop->check();
    EXPECT_EQ(a.loop->viscosity_updates(), b.loop->viscosity_updates());
    const auto of_box = a.state(), of_hex = b.state();
    double moved = 0;
    for (std::size_t i = 0; i < of_box.size(); ++i) {
        moved = std::max(moved, std::abs(of_box[i] - before[i]));
        ASSERT_NEAR(of_box[i], of_hex[i], 1e-9);
    }
    EXPECT_GT(moved, 0.02);
}

// In a box that repeats, the fluid gains what force and nodes give, on skewed hexahedra as well.
TEST_F(HexLoop, MomentumIsBalancedToRoundingOnSkewedHexahedra) {
    HeldSphere s(true, BodyFreedom::prescribed, BodyForcing::feedback, 0.2, Kernel::lagrange);
    s.run(5);
    const Vec3d before = s.fluid.momentum();
    s.loop->step(0.2);
    const Vec3d gained = s.fluid.momentum() - before;
    const NodalForce nodes = s.loop->nodal_force();
    const Vec3d given = 0.2 * Vec3d{1e-5 * std::pow(12.0, 3), 0, 0};
    // the forces of the nodes that acted in this step are those before its correction
    EXPECT_GT(nodes.gross, 0);
    HeldSphere t(true, BodyFreedom::prescribed, BodyForcing::feedback, 0.2, Kernel::lagrange);
    t.run(5);
    const Vec3d acted = 0.2 * t.loop->nodal_force().sum;
    EXPECT_LT(norm(gained - given - acted), 1e-12 * 0.2 * nodes.gross + 1e-13);
}

TEST_F(HexLoop, IsBitwiseTheSameForAnyNumberOfThreads) {
    std::vector<std::vector<double>> states;
    for (const int threads : {1, 2, 3}) {
        exchange::set_threads(threads);
        Cell c(true, Kernel::lagrange);
        for (int s = 0; s < 12; ++s) c.loop->step(0.1);
        states.push_back(c.state());
    }
    EXPECT_EQ(states[1], states[0]);
    EXPECT_EQ(states[2], states[0]);
}

TEST_F(HexLoop, NamesTheNodeThatHasLeftThePipe) {
    fluid::SolverOptions o;
    o.nu = 0.4;
    o.with_force = true;
    o.scheme = fluid::Scheme::euler;
    fluid::HexPatches wall{{"wall", fluid::wall_patch()}};
    fluid::HexSolver solver(test::pipe(1500), wall, o);
    Loop loop(solver, Kernel::phi3);
    BodyState start;
    start.centre = {6, 0, 4.5};
    RigidBody body(closed_surface(meshing::icosphere(1, 1)), loop.grid(), {}, start);
    loop.add(body);
    EXPECT_THROW(loop.check(), NumericalError);
}

}  // namespace hemoflux::coupling

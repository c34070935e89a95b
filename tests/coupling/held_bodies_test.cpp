#include "coupling/held_bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "exchange/backend.hpp"
#include "exchange/error.hpp"
#include "fluid/steady.hpp"
#include "meshing/icosphere.hpp"

namespace hemoflux::coupling {
namespace {

constexpr double pi = std::numbers::pi;
/// What makes the drag of arrays right (see DragOfAnArrayOfCylinders).
constexpr double retraction = 0.14;

/// A body held in a periodic box of n x n x depth unit cells, through which a uniform force drives the fluid.
struct Array {
    static constexpr double nu = 0.1, force = 1e-7;
    double box;
    std::unique_ptr<fluid::Solver> fluid;
    std::unique_ptr<RigidBody> body;
    std::unique_ptr<HeldBodies> held;
    fluid::SteadyResult result;

    Array(int n, int depth, BodySurface surface, const Vec3d& centre, double tolerance,
          const BodyOptions& options = {}, const Vec3d& velocity = {0, 0, 0})
        : box(static_cast<double>(n) * n * depth) {
        const auto axis = meshing::uniform_axis(-n / 2.0, n / 2.0, n),
                   z = meshing::uniform_axis(-depth / 2.0, depth / 2.0, depth);
        fluid::Patches patches;
        patches.fill(fluid::periodic_patch());
        fluid::SolverOptions o;
        o.nu = nu;
        o.with_force = true;
        o.uniform_force[0] = force;
        fluid = std::make_unique<fluid::Solver>(meshing::RectilinearGrid{{axis, axis, z}}, patches, o);
        const CellGrid grid(fluid->grid().rectilinear(), {true, true, true});
        BodyState start;
        start.centre = centre;
        start.velocity = velocity;
        retract(surface, grid, centre, retraction);
        body = std::make_unique<RigidBody>(std::move(surface), grid, options, start);
        held = std::make_unique<HeldBodies>(*fluid, Kernel::lagrange, std::vector<RigidBody*>{body.get()});
        fluid::SteadyOptions steady;
        steady.tolerance = tolerance;
        result = fluid::find_steady_state(*fluid, steady, {}, held.get());
        held->settle();
    }
    [[nodiscard]] double mean_velocity() const {
        double sum = 0;
        for (const double u : fluid->values(1)) sum += u;
        return sum / box;
    }
    [[nodiscard]] double drag() const { return body->fluid_forces().force.x; }
};

BodySurface cylinder(double radius, int depth) {
    return cylinder_mantle(2 * radius, depth, {0, 0, 1}, 48, 5);
}

class HeldBodiesFlow : public testing::Test {
  protected:
    void SetUp() override { exchange::set_threads(1); }
    void TearDown() override { exchange::set_threads(0); }
};

}  // namespace

// The body carries the whole force, and the mean velocity then is that of Stokes flow: through a square array of
// cylinders F/(mu U) = 4 pi / [ln c^(-1/2) - 0.738 + c - 0.887 c^2 + 2.038 c^3] per length (Sangani and Acrivos 1982),
// wherever the cylinder lies between the cells.
TEST_F(HeldBodiesFlow, DragOfAnArrayOfCylinders) {
    const int n = 32, depth = 4;
    const double radius = 6, c = pi * radius * radius / (n * n);
    const double k = 4 * pi / (-0.5 * std::log(c) - 0.738 + c - 0.887 * c * c + 2.038 * c * c * c);
    for (const double offset : {0.0, 0.4}) {
        const Array a(n, depth, cylinder(radius, depth), {offset, 0.7 * offset, 0}, 1e-5);
        EXPECT_EQ(a.result.end, fluid::SteadyEnd::converged);
        EXPECT_NEAR(a.drag() / (Array::force * a.box), 1, 1e-3);
        EXPECT_NEAR(a.drag() / (k * Array::nu * a.mean_velocity() * depth), 1, 0.01) << offset;
        EXPECT_LT(a.body->slip(), 0.01 * a.mean_velocity());
    }
}

// The same for spheres in a cubic array, c = 0.065: 2.81 is the value of Zick and Homsy (1982) at c = 0.064.
TEST_F(HeldBodiesFlow, DragOfAnArrayOfSpheres) {
    const int n = 20;
    const double c = 0.064, radius = n * std::cbrt(0.75 * c / pi);
    const Array a(n, n, closed_surface(meshing::icosphere(3, radius)), {0, 0, 0}, 1e-4);
    EXPECT_NEAR(a.drag() / (Array::force * a.box), 1, 2e-3);
    EXPECT_NEAR(a.drag() / (6 * pi * Array::nu * radius * a.mean_velocity()), 2.81, 0.02 * 2.81);
}

TEST_F(HeldBodiesFlow, IsBitwiseTheSameForAnyNumberOfThreads) {
    std::vector<double> states[2];
    for (const int threads : {1, 3}) {
        exchange::set_threads(threads);
        const Array a(16, 4, cylinder(3, 4), {0.2, 0, 0}, 1e-3);
        for (int q = 0; q < 4; ++q)
            for (const double v : a.fluid->values(q)) states[threads == 3].push_back(v);
        for (const auto& f : a.body->memory().forces)
            states[threads == 3].insert(states[threads == 3].end(), f.begin(), f.end());
    }
    EXPECT_EQ(states[0], states[1]);
}

TEST_F(HeldBodiesFlow, RefusesBodiesThatMove) {
    BodyOptions free;
    free.freedom = BodyFreedom::free;
    const auto ball = [] { return closed_surface(meshing::icosphere(2, 3)); };
    EXPECT_THROW(Array(12, 12, ball(), {0, 0, 0}, 1e-2, free), InputError);
    EXPECT_THROW(Array(12, 12, ball(), {0, 0, 0}, 1e-2, {}, {1e-5, 0, 0}), InputError);
    Array a(12, 12, ball(), {0, 0, 0}, 0.1);
    fluid::SteadyOptions local;
    local.method = fluid::SteadyMethod::local_steps;
    EXPECT_THROW(fluid::find_steady_state(*a.fluid, local, {}, a.held.get()), InputError);
}

}  // namespace hemoflux::coupling

#include "coupling/step_control.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "coupling/loop.hpp"
#include "exchange/backend.hpp"
#include "membrane/shapes.hpp"

namespace hemoflux::coupling {
namespace {

constexpr StepBounds bounds{.longest = 8, .shortest = 0.01, .first = 1, .tolerance = 0.1};

/// Observes as often as the controller waits, and once more.
void observe(StepControl& control, double taken, double error) {
    while (control.waiting() > 0) control.observe(taken, error);
    control.observe(taken, error);
}

}  // namespace

TEST(StepControl, GrowsByAtMostTwoAndNeverBeyondTheLongest) {
    StepControl control(bounds);
    EXPECT_EQ(control.step(), 1);
    for (const double expected : {2.0, 4.0, 8.0, 8.0}) {
        observe(control, control.step(), 0);
        EXPECT_EQ(control.step(), expected);
    }
    StepControl some(bounds);
    some.observe(1, 0.06);  // 0.9 * 0.1/0.06
    EXPECT_DOUBLE_EQ(some.step(), 1.5);
}

TEST(StepControl, ShrinksToWhatTheErrorAllowsByAtMostHalf) {
    StepControl control(bounds);
    control.observe(1, 0.12);
    EXPECT_DOUBLE_EQ(control.step(), 0.75);
    observe(control, 0.6, 0.12);  // a step shorter than the wished one tells of itself
    EXPECT_DOUBLE_EQ(control.step(), 0.45);
    observe(control, 0.45, 1e9);
    EXPECT_DOUBLE_EQ(control.step(), 0.225);
    for (int i = 0; i < 4; ++i) observe(control, control.step(), 1e9);
    EXPECT_FALSE(control.failed());
    observe(control, control.step(), 1e9);
    EXPECT_TRUE(control.failed());
}

TEST(StepControl, WaitsAfterAChange) {
    StepControl control(bounds);
    control.observe(1, 0);
    ASSERT_EQ(control.step(), 2);
    StepControl restored(bounds);
    restored.restore(control.step(), control.waiting());
    for (int i = 0; i < settling_steps; ++i) {
        control.observe(2, 1e9);
        EXPECT_EQ(control.step(), 2);
    }
    control.observe(2, 1e9);
    EXPECT_EQ(control.step(), 1);
    observe(restored, 2, 1e9);
    EXPECT_EQ(restored.step(), 1);
}

TEST(StepControl, KeepsAStepThatIsAboutRight) {
    StepControl control(bounds);
    for (const double error : {0.0999, 0.0721, 0.0999}) {
        control.observe(1, error);
        EXPECT_EQ(control.step(), 1) << error;
    }
    control.observe(1, 0.0719);  // one longer by a quarter is allowed
    EXPECT_GT(control.step(), 1.25);
    const double now = control.step();
    observe(control, now, std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(control.step(), now);
}

TEST(StepControl, SettlesWhereTheErrorIsProportionalToTheStep) {
    StepControl control(bounds);
    for (int i = 0; i < 20; ++i) observe(control, control.step(), 0.03 * control.step());
    EXPECT_LE(0.03 * control.step(), 0.1);
    EXPECT_GE(0.03 * control.step(), 0.07);
}

TEST(StepControl, RefusesBoundsThatLeaveNoStep) {
    for (const StepBounds& b : {StepBounds{8, 0, 1, 0.1}, StepBounds{8, 0.01, 9, 0.1},
                                StepBounds{8, 2, 1, 0.1}, StepBounds{8, 0.01, 1, 0}})
        EXPECT_THROW(StepControl{b}, std::invalid_argument);
}

TEST(VelocityChange, IsTheLargestOfAllNodesAndSaysWhere) {
    constexpr std::size_t nodes = 1000;
    std::vector<double> values(nodes, 1.0);
    exchange::Buffer<double> x(values), y(values), z(values);
    const exchange::FieldView u{{x.data(), y.data(), z.data()}, nodes};
    VelocityChange change(nodes), copy(nodes);
    EXPECT_TRUE(change.memory().empty());
    change.observe(u);
    EXPECT_FALSE(change.known());
    copy.restore(change.memory());
    values[700] = 4;
    x.assign(values);
    values[700] = 5;
    y.assign(values);
    change.observe(u);
    copy.observe(u);
    ASSERT_TRUE(change.known() && copy.known());
    EXPECT_DOUBLE_EQ(change.largest(), 5);  // (3, 4, 0)
    EXPECT_EQ(change.where(), 700u);
    EXPECT_EQ(copy.largest(), change.largest());
    change.observe(u);
    EXPECT_EQ(change.largest(), 0);
    EXPECT_THROW(copy.restore({1, 2, 3}), std::length_error);
}

namespace {

/// A coarse cell in shear, the same every time.
struct Sheared {
    std::unique_ptr<membrane::Batch> cells;
    std::unique_ptr<fluid::Solver> fluid;
    std::unique_ptr<Loop> loop;
    static constexpr double rate = 0.004;

    /// After `steps` steps of dt, watched.
    Sheared(int steps, double dt) {
        static const membrane::Cell cell = membrane::make_discocyte(2);
        cells = std::make_unique<membrane::Batch>(cell.topology, cell.parameters, cell.reference, 1);
        std::vector<Vec3d> positions = cell.positions;
        for (Vec3d& r : positions) r = Vec3d{r.x, r.z, -r.y};
        cells->set_positions(0, positions);
        meshing::RectilinearGrid grid;
        grid.axes = {meshing::uniform_axis(-6, 6, 16), meshing::uniform_axis(-6, 6, 16),
                     meshing::uniform_axis(-6, 6, 16)};
        fluid::Patches patches;
        patches.fill(fluid::velocity_patch([](const Vec3d& x) { return Vec3d{rate * x.y, 0, 0}; }));
        fluid::SolverOptions o;
        o.nu = 0.5 * grid.smallest();
        o.with_force = true;
        o.scheme = fluid::Scheme::factored;
        fluid = std::make_unique<fluid::Solver>(grid, patches, o);
        fluid->initialise([](const Vec3d& x) { return fluid::FlowPoint{1, {rate * x.y, 0, 0}}; });
        LoopOptions l;
        l.force_factor = 0.01;
        loop = std::make_unique<Loop>(*fluid, *cells, l);
        loop->watch_velocities();
        for (int s = 0; s < steps; ++s) loop->step(dt);
    }
};

double largest_distance(const Sheared& a, const Sheared& b) {
    const auto x = a.cells->positions(0), y = b.cells->positions(0);
    double largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, norm(x[i] - y[i]));
    return largest;
}

}  // namespace

// From one state, a step against two of half its length: their distance is half the displacement that the step gets wrong.
// Reached with three lengths of step, since what changes with the step itself is estimated too.
TEST(VelocityChange, EstimatesTheErrorOfAStepAgainstHalvesOfIt) {
    constexpr int before = 120;
    constexpr double longest = 0.15;
    double estimate[3], error[3];
    for (int level = 0; level < 3; ++level) {
        const double dt = longest / (1 << level);
        Sheared whole(before << level, dt), halves(before << level, dt);
        whole.loop->step(dt);
        estimate[level] = 0.5 * dt * whole.loop->velocity_change().value();
        for (int s = 0; s < 2; ++s) halves.loop->step(dt / 2);
        error[level] = 2 * largest_distance(whole, halves);
    }
    EXPECT_NEAR(estimate[0] / estimate[1], 4, 0.1);
    EXPECT_NEAR(estimate[1] / estimate[2], 4, 0.1);
    EXPECT_NEAR(estimate[0] / error[0], 1, 0.6);
    EXPECT_NEAR(estimate[1] / error[1], 1, 0.3);
    EXPECT_NEAR(estimate[2] / error[2], 1, 0.15);
}

TEST(Loop, WatchedVelocitiesChangeNothingAndNameTheNode) {
    Sheared watched(30, 0.3);
    EXPECT_EQ(watched.loop->most_changed().rfind("membrane node ", 0), 0u);
    EXPECT_EQ(watched.loop->velocities().size(), 3 * watched.cells->x().size());
    exchange::set_threads(2);
    Sheared again(30, 0.3);
    exchange::set_threads(0);
    EXPECT_EQ(again.loop->velocity_change(), watched.loop->velocity_change());
    EXPECT_EQ(again.cells->x().to_host(), watched.cells->x().to_host());
}

}  // namespace hemoflux::coupling

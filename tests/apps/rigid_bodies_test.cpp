// Rigid bodies in case files: what is refused, and runs of the built program.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "apps/case.hpp"
#include "apps/output/checkpoint.hpp"
#include "apps/output/summary.hpp"
#include "apps/rigid_surface.hpp"
#include "coupling/cell_grid.hpp"
#include "exchange/error.hpp"
#include "fluid/probe.hpp"
#include "fluid/solver.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/surface_io.hpp"
#include "tests/apps/example_case.hpp"
#include "tests/apps/program.hpp"

namespace hemoflux::apps {
namespace {

const std::string body_case = R"(title = "A sphere in shear"
kind = "fluid"
[fluid]
viscosity = "1 mPa s"
[grid]
length = ["16 um", "16 um", "16 um"]
cells = [16, 16, 16]
[boundary]
x = "periodic"
z = "periodic"
y = { velocity = "shear" }
[shear]
rate = "2000 1/s"
[[body]]
name = "ball"
diameter = "6 um"
motion = "torque-free"
speed = "6 mm/s"
[time]
strain = 0.4
[numerics]
mach = 0.1
[output]
interval_strain = 0.1
history_interval_strain = 0.02
checkpoint_interval_strain = 0.1
pictures = false
)";

std::string refusal(const std::vector<std::string>& sets) {
    return message_of<InputError>([&] { static_cast<void>(parse_case(body_case, "case", "/", sets)); });
}

class RigidRun : public Program {
  protected:
    [[nodiscard]] output::Checkpoint last(const std::string& run_folder) const {
        return output::latest_checkpoint(folder_ / run_folder).checkpoint;
    }
};

}  // namespace

TEST(RigidBodies, ReadsATableWithItsDefaults) {
    const Case c = parse_case(body_case, "case", "/", {"body.0.axis=[0, 0, 2]"});
    ASSERT_EQ(c.bodies.size(), 1u);
    const RigidInput& b = c.bodies[0];
    EXPECT_EQ(b.name, "ball");
    EXPECT_EQ(b.motion, RigidMotion::torque_free);
    EXPECT_EQ(b.method, RigidMethod::direct);
    EXPECT_DOUBLE_EQ(b.diameter, 6);
    EXPECT_DOUBLE_EQ(b.axis[2], 1);
    EXPECT_FALSE(b.density || b.nodes || b.stiffness || b.retraction);
    EXPECT_EQ(parse_case(c.resolved), c);
    const double h = cells_around(b, coupling::CellGrid(make_grid(c.grid), {true, false, true}));
    EXPECT_DOUBLE_EQ(h, 1);
    EXPECT_EQ(make_surface(b, h).nodes.size(), 162u);  // 1.43 per um^2
    EXPECT_EQ(make_surface(b, 0.9 * h).nodes.size(), 642u);
    EXPECT_NEAR(reference_area(b, make_surface(b, h)), 28.27, 0.01);
}

TEST(RigidBodies, RefusesWhatHasNoEffectOrNoMeaning) {
    EXPECT_EQ(refusal({}), "");
    EXPECT_NE(refusal({"body.0.length=\"3 um\""}).find("only a cylinder has one"), std::string::npos);
    EXPECT_NE(refusal({"body.0.shape=\"cylinder\""}).find("none is given"), std::string::npos);
    EXPECT_NE(refusal({"body.0.shape=\"cylinder\"", "body.0.length=\"3 um\""}).find("no inertia"),
              std::string::npos);
    EXPECT_NE(refusal({"body.0.stiffness=\"3 Pa/m\""}).find("no effect"), std::string::npos);
    EXPECT_NE(refusal({"body.0.axis=[0, 0, 0]"}).find("no direction"), std::string::npos);
    EXPECT_NE(refusal({"body.0.file=\"a.vtp\""}).find("both given"), std::string::npos);
    EXPECT_NE(refusal({"steady.method=\"local-steps\""}).find("only the implicit method"), std::string::npos);
    EXPECT_NE(refusal({"steady.tolerance=1e-5", "body.0.method=\"feedback\""}).find("without springs"),
              std::string::npos);
    EXPECT_NE(refusal({"body.0.diametre=\"3 um\""}).find("diameter"), std::string::npos);
    EXPECT_NE(refusal({"body.0.aspect=-1"}).find("out of range"), std::string::npos);
}

TEST_F(RigidRun, IsRefusedBeforeAnyStep) {
    write("case.toml", body_case);
    const Outcome outside = run("run case.toml -o a --set 'body.0.position=[\"0 um\", \"6 um\", \"0 um\"]'");
    EXPECT_EQ(outside.code, 2);
    EXPECT_NE(outside.text.find("reaches through the border of the grid"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder_ / "a"));
    const Outcome light =
        run("run case.toml -o a --set body.0.motion=free --set 'body.0.density=\"500 kg/m^3\"'");
    EXPECT_EQ(light.code, 2);
    EXPECT_NE(light.text.find("lighter"), std::string::npos);
}

TEST_F(RigidRun, TurnsAndIsMeasuredAndContinuesBitwise) {
    write("case.toml", body_case);
    ASSERT_EQ(run("run case.toml -o whole --threads 1 --quiet").code, 0);
    const output::Summary s = output::read_summary(folder_ / "whole" / "summary.json");
    EXPECT_NEAR(s.observables.at("angular_velocity_z_over_rate"), -0.5, 0.05);
    EXPECT_LT(s.observables.at("no_slip_error"), 0.01);
    EXPECT_LT(std::abs(s.observables.at("drag_coefficient")), 1e-6);
    EXPECT_TRUE(s.observables.contains("pressure_difference_pa"));
    const meshing::SurfaceMesh frame = meshing::read_surface(folder_ / "whole" / "cells_0004.vtp");
    EXPECT_EQ(frame.vertices.size(), 162u);
    EXPECT_NEAR(norm(frame.vertices[7]), 3, 1e-9);

    fs::copy(folder_ / "whole", folder_ / "cut");
    fs::remove(output::latest_checkpoint(folder_ / "cut").path);
    ASSERT_EQ(run("run --quiet --threads 1 --restart cut").code, 0);
    EXPECT_EQ(content("whole/history.csv"), content("cut/history.csv"));
    const output::Checkpoint whole = last("whole"), cut = last("cut");
    for (const auto& [name, values] : whole.arrays())
        if (name != "history") {  // compared above; it holds residuals that are not numbers yet
            EXPECT_EQ(values, cut.array(name)) << name;
        }
}

// Exact Stokes flow about a sphere of ten cells to the diameter, -> p = -3/2 mu U R cos / r^2 (Stokes 1851).
TEST(RigidBodies, PressureAtTheSurfaceIsThatOfStokesFlow) {
    const auto axis = meshing::uniform_axis(-10, 10, 20);
    fluid::Patches patches;
    patches.fill(fluid::open_patch());
    fluid::SolverOptions o;
    o.nu = 0.5;
    fluid::Solver flow(meshing::RectilinearGrid{{axis, axis, axis}}, patches, o);
    const double radius = 5, speed = 1e-3;
    flow.initialise([&](const Vec3d& x) -> fluid::FlowPoint {
        const double r = std::max(norm(x), radius), s = radius / r, along = x.x / r;
        const double across = speed * (1 - 0.75 * s - 0.25 * s * s * s);
        const double radial = speed * along * (1 - 1.5 * s + 0.5 * s * s * s) - across * along;
        return {1 - 3 * 1.5 * o.nu * speed * s * s * along / radius, Vec3d{across, 0, 0} + (radial / r) * x};
    });
    coupling::CellGrid cells(flow.grid().rectilinear(), {false, false, false});
    const coupling::RigidBody body(coupling::closed_surface(meshing::icosphere(3, radius)), cells, {}, {});
    const double p = pressure_difference(body, {1, 0, 0}, cells, o, *fluid::make_probe(flow));
    EXPECT_NEAR(p / (3 * o.nu * speed / radius), 1, 0.05);
}

// A sphere that is held: the torque is 4 pi mu G R^3 and somewhat more between plates at 2.7 radii.
TEST_F(RigidRun, EndsInTheSteadyState) {
    write("case.toml", body_case);
    const Outcome outcome =
        run("run case.toml -o run --threads 1 --quiet --set time.strain=4 --set time.steady=1e-4 "
            "--set body.0.motion=prescribed");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const output::Summary s = output::read_summary(folder_ / "run" / "summary.json");
    EXPECT_LT(s.observables.at("time_s"), 0.5 * 4 / 2000);
    const double torque = s.observables.at("torque_z_Nm") / (-4 * std::numbers::pi * 1e-3 * 2000 * 27e-18);
    EXPECT_GT(torque, 1);
    EXPECT_LT(torque, 1.2);
    EXPECT_NEAR(s.observables.at("angular_velocity_z_1_per_s"), 0, 1e-12);
}

// The steady state found at once is that which the run in time approaches.
TEST_F(RigidRun, IsHeldInTheSteadyFlowFoundImplicitly) {
    write("case.toml", body_case);
    const std::string common = " --threads 1 --quiet --set body.0.motion=prescribed";
    ASSERT_EQ(run("run case.toml -o time --set time.strain=6" + common).code, 0);
    const Outcome outcome =
        run("run case.toml -o steady --set steady.tolerance=1e-6 --set numerics.gamma=1" + common);
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const output::Summary t = output::read_summary(folder_ / "time" / "summary.json"),
                          s = output::read_summary(folder_ / "steady" / "summary.json");
    EXPECT_EQ(s.observables.at("converged"), 1);
    EXPECT_NEAR(s.observables.at("torque_z_Nm") / t.observables.at("torque_z_Nm"), 1, 0.02);
    EXPECT_LT(s.observables.at("no_slip_error"), 0.02);
    EXPECT_TRUE(fs::exists(folder_ / "steady" / "cells_0000.vtp"));
    const Outcome moving = run("run case.toml -o no --set steady.tolerance=1e-6");
    EXPECT_EQ(moving.code, 2);
    EXPECT_NE(moving.text.find("moves in a steady flow"), std::string::npos);
}

}  // namespace hemoflux::apps

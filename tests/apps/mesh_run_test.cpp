// Bodies and cells on meshes of hexahedra: what is refused, and runs of the built program.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/case.hpp"
#include "apps/case_suspension.hpp"
#include "apps/output/checkpoint.hpp"
#include "apps/output/summary.hpp"
#include "exchange/error.hpp"
#include "tests/apps/example_case.hpp"
#include "tests/apps/program.hpp"

namespace hemoflux::apps {
namespace {

const std::string body_case = R"(title = "A sphere in shear, on a mesh"
kind = "fluid"
[fluid]
viscosity = "1 mPa s"
initial = "shear"
[grid]
mesh = { kind = "cube", size = "16 um", cells = 3500, wall = 1 }
[boundary]
"x-" = { periodic = "x+" }
"x+" = { periodic = "x-" }
"z-" = { velocity = "symmetry" }
"z+" = { velocity = "symmetry" }
"y-" = { velocity = "shear" }
"y+" = { velocity = "shear" }
[shear]
rate = "2000 1/s"
[[body]]
name = "ball"
diameter = "6 um"
motion = "torque-free"
[coupling]
kernel = "phi3"
[time]
strain = 0.2
[numerics]
mach = 0.1
[output]
interval_strain = 0.1
history_interval_strain = 0.02
checkpoint_interval_strain = 0.1
pictures = false
)";

const std::string pipe_case = R"(title = "A cell in a pipe"
kind = "coupled"
[fluid]
viscosity = "1.2 mPa s"
[grid]
mesh = { kind = "pipe", size = "10 um", length = 1, cells = 2000, wall = 1 }
[boundary]
inlet = { periodic = "outlet" }
outlet = { periodic = "inlet" }
wall = { velocity = "no-slip" }
[body_force]
acceleration = ["384 m/s^2", "0 m/s^2", "0 m/s^2"]
[[cell]]
nodes = 162
reference = "uniform"
cytosol_viscosity = "6 mPa s"
position = ["5 um", "0.2 um", "0 um"]
axis = [1, 0, 0]
[time]
strain = 0.06
[numerics]
reynolds = 8
[output]
interval_strain = 0.03
history_interval_strain = 0.02
checkpoint_interval_strain = 0.03
window_strain = [0, 0.06]
pictures = false
)";

std::string refusal(const std::string& text, const std::vector<std::string>& sets) {
    return message_of<InputError>([&] { static_cast<void>(parse_case(text, "case", "/", sets)); });
}

/// Runs on meshes.
class MeshRun : public Program {
  protected:
    /// A run continued from its first checkpoint but one ends as it does uncut.
    void expect_same_after_restart(const std::string& arguments) {
        const Outcome outcome = run("run case.toml -o whole --threads 1 --quiet " + arguments);
        ASSERT_EQ(outcome.code, 0) << outcome.text;
        fs::copy(folder_ / "whole", folder_ / "cut");
        fs::remove(output::latest_checkpoint(folder_ / "cut").path);
        ASSERT_EQ(run("run --quiet --threads 2 --restart cut").code, 0);
        EXPECT_EQ(content("whole/history.csv"), content("cut/history.csv"));
    }
};

}  // namespace

TEST(MeshCase, RefusesWhatAMeshCannotServe) {
    EXPECT_EQ(refusal(body_case, {}), "");
    EXPECT_EQ(refusal(pipe_case, {}), "");
    EXPECT_NE(refusal(body_case, {"coupling.kernel=phi2"}).find("too few cells"), std::string::npos);
    EXPECT_NE(refusal(pipe_case, {"packing.haematocrit=0.1"}).find("packed into boxes"), std::string::npos);
    EXPECT_NE(refusal(pipe_case, {"contact.walls=true"}).find("those of a box"), std::string::npos);
    EXPECT_NE(refusal(pipe_case, {"boundary.wall.velocity=zero-gradient"}).find("clock"), std::string::npos);
}

TEST(MeshCase, TheClockOfAPipeIsItsWallRate) {
    const Case c = parse_case(pipe_case);
    const auto flow = undisturbed_flow(c);
    ASSERT_TRUE(flow);
    EXPECT_NEAR(flow->wall_rate(), 384 * 1000 * 5e-6 / 2 / 1.2e-3, 1e-6);
    EXPECT_DOUBLE_EQ(*c.shear_rate, flow->wall_rate());
    EXPECT_EQ(c.fluid.initial, InitialFlow::channel);
}

TEST_F(MeshRun, ABodyTurnsIsMeasuredAndContinuesBitwise) {
    write("case.toml", body_case);
    expect_same_after_restart("");
    const output::Summary s = output::read_summary(folder_ / "whole" / "summary.json");
    EXPECT_NEAR(s.observables.at("angular_velocity_z_over_rate"), -0.5, 0.1);
    EXPECT_LT(s.observables.at("no_slip_error"), 0.02);
    EXPECT_TRUE(fs::exists(folder_ / "whole" / "cells_0002.vtp"));
    EXPECT_TRUE(fs::exists(folder_ / "whole" / "fluid_0002.vtu"));
    const Outcome outside = run("run case.toml -o a --set 'body.0.position=[\"0 um\", \"6 um\", \"0 um\"]'");
    EXPECT_EQ(outside.code, 2);
    EXPECT_NE(outside.text.find("reaches through the border"), std::string::npos) << outside.text;
}

TEST_F(MeshRun, ACellFlowsThroughAPipeAndContinuesBitwise) {
    write("case.toml", pipe_case);
    expect_same_after_restart("");
    const output::Summary s = output::read_summary(folder_ / "whole" / "summary.json");
    // the cell goes with the stream, faster than its mean of 1 mm/s and slower than its middle
    EXPECT_GT(s.observables.at("cell_speed_um_s"), 1000);
    EXPECT_LT(s.observables.at("cell_speed_um_s"), 2000);
    EXPECT_NEAR(s.observables.at("flow_speed_um_s"), 1000, 60);
    const Outcome outside = run("run case.toml -o a --set 'cell.0.position=[\"5 um\", \"3 um\", \"0 um\"]'");
    EXPECT_EQ(outside.code, 2);
    EXPECT_NE(outside.text.find("not periodic"), std::string::npos) << outside.text;
}

}  // namespace hemoflux::apps

// Steady runs and flows on meshes, through the program.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/output/history.hpp"
#include "apps/output/summary.hpp"
#include "exchange/error.hpp"
#include "tests/apps/program.hpp"

namespace hemoflux::apps {
namespace {

class SteadyRunTest : public Program {
  protected:
    [[nodiscard]] output::Summary summary(const std::string& run) const {
        return output::read_summary(folder_ / run / "summary.json");
    }

    /// A gap of 10 um whose upper wall moves; Re = 5.
    const std::string couette = R"(title = "Gap"
kind = "fluid"
[fluid]
viscosity = "1 mPa s"
[grid]
length = ["4 um", "10 um", "1 um"]
cells = [4, 10, 1]
origin = "corner"
[boundary]
x = "periodic"
"y-" = { velocity = "no-slip" }
"y+" = { velocity = ["0.5 m/s", "0 m/s", "0 m/s"] }
z = "periodic"
[analytical]
solution = "couette"
speed = "0.5 m/s"
[steady]
criterion = "residual"
tolerance = 1e-8
[numerics]
tau_floor = 0
[output]
pictures = false
fields = ["velocity", "pressure", "vorticity"]
)";

    const std::string cube = R"(title = "Cube"
kind = "fluid"
[fluid]
viscosity = "1 mPa s"
[grid]
mesh = { kind = "cube", size = "10 um", cells = 3000 }
[boundary]
x = { velocity = "no-slip" }
"y-" = { velocity = "no-slip" }
"y+" = { velocity = ["1 m/s", "0 m/s", "0 m/s"] }
z = { velocity = "no-slip" }
[steady]
tolerance = 1e-3
[output]
pictures = false
fields = ["velocity", "pressure", "vorticity"]
)";
};

TEST_F(SteadyRunTest, BothMethodsReachTheExactFlow) {
    write("case.toml", couette);
    for (const char* method : {"implicit", "local-steps"}) {
        const Outcome outcome = run(std::string("run case.toml -q -o out --set steady.method=") + method);
        ASSERT_EQ(outcome.code, 0) << outcome.text;
        const output::Summary s = summary("out");
        EXPECT_EQ(s.observables.at("converged"), 1) << method;
        EXPECT_LT(s.observables.at("residual"), 1e-8) << method;
        EXPECT_LT(s.observables.at("error_relative"), 1e-6) << method;
        const output::Table history = output::read_table(folder_ / "out/history.csv");
        EXPECT_EQ(history.column("step").back(), s.observables.at("iterations")) << method;
        EXPECT_EQ(history.column("evaluations").back(), s.observables.at("residual_evaluations")) << method;
        EXPECT_LT(history.column("measure").back(), 1e-8) << method;
    }
}

TEST_F(SteadyRunTest, StartsFromACoarserRun) {
    write("case.toml", couette);
    ASSERT_EQ(run("run case.toml -q -o coarse").code, 0);
    const std::string fine =
        "run case.toml -q -o fine --set 'grid.cells=[4, 20, 1]' --set numerics.mach=0.05 --set "
        "steady.iterations=1 --set steady.start=coarse";
    const Outcome outcome = run(fine);
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    // interpolation and change of units are exact for a linear profile
    EXPECT_LT(summary("fine").observables.at("error_relative"), 1e-6);
    EXPECT_EQ(run("run case.toml -q -o out --set steady.start=nowhere").code, 4);
    EXPECT_EQ(run("run -q --restart coarse").code, 2);
}

TEST_F(SteadyRunTest, FlowOnAMesh) {
    write("case.toml", cube);
    const Outcome outcome = run("run case.toml -q -o out");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const output::Summary s = summary("out");
    EXPECT_EQ(s.observables.at("converged"), 1);
    EXPECT_NEAR(s.observables.at("cells"), 3000, 100);
    EXPECT_GT(s.observables.at("largest_speed_um_per_s"), 3e5);
    EXPECT_TRUE(fs::exists(folder_ / "out/fluid_0000.vtu"));
    // in time, too
    EXPECT_EQ(run("run case.toml --check --set grid.mesh.cells=4000").code, 0);
}

TEST_F(SteadyRunTest, BadMeshCasesAreRefused) {
    write("case.toml", cube);
    for (const char* set : {"'boundary.lid={ velocity = \"no-slip\" }'",
                            "'boundary.x={ periodic = \"lid\" }'", "grid.mesh.kind=file", "grid.mesh.size=0",
                            "'boundary.z={ velocity = \"parabolic\", speed = \"1 m/s\" }'",
                            "steady.tolerance=0", "kind=coupled"}) {
        const Outcome outcome = run(std::string("run case.toml -o out --set ") + set);
        EXPECT_EQ(outcome.code, 2) << set << " " << outcome.text;
    }
    write("box.toml", couette);
    EXPECT_EQ(run("run box.toml -o out --set 'boundary.lid={ velocity = \"no-slip\" }'").code, 2);
    EXPECT_EQ(run("run box.toml -o out --set 'boundary.\"y+\"={ periodic = \"y-\" }'").code, 2);
}

}  // namespace
}  // namespace hemoflux::apps

// Motion of one cell through the built program: its name, deformation index, tweezers in the fluid, membrane viscosity,
// and sweeps of them.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/output/checkpoint.hpp"
#include "apps/output/history.hpp"
#include "apps/output/summary.hpp"
#include "tests/apps/program.hpp"

namespace hemoflux::apps {
namespace {

class Dynamics : public Program {
  protected:
    [[nodiscard]] output::Summary summary(const std::string& run_folder) const {
        return output::read_summary(folder_ / run_folder / "summary.json");
    }
};

/// A coarse cell between walls; the disc's axis along z, where a pull along x is in its plane.
const std::string pulled_case = R"(title = "Pulled"
kind = "coupled"
[fluid]
viscosity = "1.2 mPa s"
[grid]
length = ["16 um", "12 um", "12 um"]
cells = [20, 16, 16]
[boundary]
x = { velocity = "no-slip" }
y = { velocity = "no-slip" }
z = { velocity = "no-slip" }
[[cell]]
nodes = 162
reference = "stress-free"
shear_modulus = "4 uN/m"
axis = [0, 0, 1]
[tweezers]
force = "40 pN"
[time]
strain = 3
[numerics]
reynolds = 10
[output]
pictures = false
history_interval_strain = 0.25
checkpoint_interval_strain = 1
)";

TEST_F(Dynamics, MotionHasItsNameInSummaryAndTable) {
    ASSERT_EQ(run(small_run + "-o out").code, 0);
    const output::Summary s = summary("out");
    EXPECT_EQ(s.labels.at("mode"), "too short to tell");  // a fifth of a strain unit
    EXPECT_EQ(s.observables.at("flips"), 0);
    EXPECT_TRUE(std::isnan(s.observables.at("tumbling_period_strain")));
    const auto index = output::read_table(folder_ / "out/history.csv").column("0.deformation_index_pct");
    EXPECT_GT(index.front(), 20);  // the disc from its edge
    EXPECT_NE(content("out/log.txt").find("mode"), std::string::npos);
}

TEST_F(Dynamics, TweezersPullTheCellUntilItRests) {
    write("case.toml", pulled_case);
    const Outcome outcome = run("run case.toml -q -o out");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const auto axial = output::read_table(folder_ / "out/history.csv").column("0.axial_um"),
               transverse = output::read_table(folder_ / "out/history.csv").column("0.transverse_um");
    EXPECT_GT(axial.back(), axial.front() + 0.3);
    EXPECT_LT(transverse.back(), transverse.front() - 0.1);
    EXPECT_EQ(summary("out").observables.at("axial_diameter_um"), axial.back());
    EXPECT_NE(content("out/log.txt").find("no shear, clock G = K_S/(mu R0)"), std::string::npos);

    // with a large tolerance it is at rest as soon as two strain units have passed
    ASSERT_EQ(run("run case.toml -q -o early --set 'tweezers.tolerance=\"1 m/s\"'").code, 0);
    EXPECT_LT(summary("early").observables.at("strain"), 2.5);
}

TEST_F(Dynamics, PulledNodesAndMembraneViscositySurviveARestart) {
    write("case.toml", pulled_case);
    const std::string viscous = " --set 'cell.0.membrane_viscosity=\"0.3e-6 Pa s m\"' --set time.strain=1.6 ";
    ASSERT_EQ(run("run case.toml -q -o whole" + viscous).code, 0);
    fs::copy(folder_ / "whole", folder_ / "cut");
    fs::remove(output::latest_checkpoint(folder_ / "cut").path);
    fs::remove(folder_ / "cut/summary.json");
    const Outcome outcome = run("run --restart cut -q");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(content("whole/history.csv"), content("cut/history.csv"));

    ASSERT_EQ(run("run case.toml -q -o free --set time.strain=1.6").code, 0);
    EXPECT_LT(summary("whole").observables.at("axial_diameter_um"),
              summary("free").observables.at("axial_diameter_um"));
}

TEST_F(Dynamics, TweezersTakeOneCell) {
    write("case.toml", pulled_case + "[[cell]]\nnodes = 162\n");
    expect_error("run case.toml -q -o out", 2, "[tweezers] with 2 cells");
}

TEST_F(Dynamics, SweepsShowNamesOfMotionAndMeasuredPoints) {
    const std::string quick = " --set cell.0.nodes=42 --set 'time.strain=0.1' ";
    write("measured.csv", "F_pN,DA_um\n0,7.7\n40,10.9\n");
    const std::string sweep =
        "[sweep]\nobservables = [\"mode\", \"axial_diameter_um\"]\nlog = \"none\"\n[sweep.values]\n"
        "\"tweezers.force\" = [\"0 pN\", \"40 pN\"]\n[[sweep.measured]]\nfile = \"measured.csv\"\nx = "
        "\"F_pN\"\n"
        "y = \"DA_um\"\nlabel = \"measured\"\n";
    write("case.toml", pulled_case + sweep);
    const Outcome outcome = run("sweep case.toml -o out" + quick);
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("steady"), std::string::npos) << outcome.text;
    const std::string table = content("out/sweep.csv");
    EXPECT_NE(table.find(",mode,"), std::string::npos) << table;
    EXPECT_NE(table.find(",steady,"), std::string::npos) << table;

    write("lost.toml", pulled_case + sweep.substr(0, sweep.find("\"measured.csv\"")) +
                           "\"none.csv\"\nx = \"F_pN\"\n" + "y = \"DA_um\"\nlabel = \"measured\"\n");
    EXPECT_EQ(run("sweep lost.toml -o lost" + quick).code, 4);
    EXPECT_FALSE(fs::exists(folder_ / "lost"));
}

}  // namespace
}  // namespace hemoflux::apps

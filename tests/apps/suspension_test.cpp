// Runs of several cells in a channel from end to end.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/output/history.hpp"
#include "apps/output/summary.hpp"
#include "tests/apps/program.hpp"

namespace hemoflux::apps {
namespace {

class Suspension : public Program {};

const std::string channel_of_cells = R"(title = "Two cells in a channel"
[fluid]
viscosity = "1.2 mPa s"
[grid]
length = ["16 um", "10 um", "12 um"]
cells = [16, 10, 12]
[boundary]
x = "periodic"
y = { velocity = "no-slip" }
z = "periodic"
[body_force]
acceleration = ["100 m/s^2", "0 m/s^2", "0 m/s^2"]
[[cell]]
nodes = 162
[packing]
haematocrit = 0.1
[contact]
pressure = "50 Pa"
[time]
strain = 0.2
[output]
interval_strain = 0.1
history_interval_strain = 0.05
checkpoint_interval_strain = 0.1
pictures = false
)";

TEST_F(Suspension, MeasuresSpeedsViscosityGapsAndMomentum) {
    write("case.toml", channel_of_cells);
    const Outcome outcome = run("run case.toml --quiet -o out");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const output::Table history = output::read_table(folder_ / "out/history.csv");
    // rho a H^2/(12 mu) = 694 um/s without cells, where the run starts
    EXPECT_NEAR(history.column("flow_speed_um_s").front(), 694, 7);
    EXPECT_LT(history.column("flow_speed_um_s").back(), history.column("flow_speed_um_s").front());
    EXPECT_NEAR(history.column("relative_viscosity").front(), 1, 0.01);
    EXPECT_GT(history.column("relative_viscosity").back(), 1);
    EXPECT_NEAR(history.column("cell_speed_um_s").back(), 694, 350);
    for (const double gap : history.column("smallest_gap_um")) EXPECT_GT(gap, 0);
    for (const double error : history.column("momentum_error")) EXPECT_LT(error, 1e-10);
    const auto observables = output::read_summary(folder_ / "out/summary.json").observables;
    EXPECT_NEAR(observables.at("tube_haematocrit"), 2 * 93.64 / 1920, 2e-3);
    EXPECT_LT(observables.at("momentum_error"), 1e-10);
    EXPECT_GT(observables.at("momentum_error"), 0);
    EXPECT_TRUE(observables.contains("discharge_haematocrit"));

    // a restart from the middle, on two threads, ends in the same state to the last bit
    fs::create_directory(folder_ / "half");
    std::string last;
    for (const auto& entry : fs::directory_iterator(folder_ / "out"))
        if (entry.path().extension() == ".bin") last = std::max(last, entry.path().filename().string());
    for (const auto& entry : fs::directory_iterator(folder_ / "out"))
        if (entry.path().filename() != last && (entry.path().extension() == ".bin"))
            fs::copy(entry.path(), folder_ / "half");
    const Outcome again = run("run case.toml --quiet --threads 2 --restart half -o rest");
    ASSERT_EQ(again.code, 0) << again.text;
    EXPECT_TRUE(content("out/" + last) == content("rest/" + last));
}

TEST_F(Suspension, RefusesWhatCannotBePacked) {
    write("case.toml", channel_of_cells);
    const Outcome outcome = run("run case.toml --quiet --set packing.haematocrit=0.6 -o out");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.text.find("% of their size"), std::string::npos) << outcome.text;
}

}  // namespace
}  // namespace hemoflux::apps

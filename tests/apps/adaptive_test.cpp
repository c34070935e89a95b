// Steps that follow the error, through the built program: where they end, how long they are, restarts, threads, failures.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "apps/output/history.hpp"
#include "apps/output/pvd_series.hpp"
#include "apps/output/summary.hpp"
#include "tests/apps/bad_input.hpp"
#include "tests/apps/restarts.hpp"

namespace hemoflux::apps {
namespace {

const std::string adaptive_run = small_run + "--set time.adaptive=true ";

class Adaptive : public Restart {
  protected:
    [[nodiscard]] output::Table history(const std::string& run_folder) const {
        return output::read_table(folder_ / run_folder / "history.csv");
    }
    [[nodiscard]] double steps(const std::string& run_folder) const {
        return output::read_summary(folder_ / run_folder / "summary.json").performance.steps;
    }
};

TEST_F(Adaptive, MeetsIntervalsAndTheEndExactlyWithStepsBelowTheStableOne) {
    ASSERT_EQ(run(small_run + "-o equal").code, 0);
    ASSERT_EQ(run(adaptive_run + "--set time.strain=0.17 --set output.interval_strain=0.07 -o out").code, 0);
    const double longest = history("equal").column("dt_s").front();
    const output::Table table = history("out");
    const auto strain = table.column("strain"), dt = table.column("dt_s");
    const double expected[] = {0, 0.05, 0.07, 0.1, 0.14, 0.15, 0.17};
    ASSERT_EQ(strain.size(), std::size(expected));
    for (std::size_t i = 0; i < strain.size(); ++i) EXPECT_DOUBLE_EQ(strain[i], expected[i]);
    EXPECT_EQ(strain.back(), 0.17);
    for (const double step : dt) EXPECT_LE(step, longest * (1 + 1e-8));
    EXPECT_LT(dt.front(), longest / 10);
    const auto frames = output::read_pvd(folder_ / "out/cells.pvd");
    ASSERT_EQ(frames.size(), 4u);
    EXPECT_DOUBLE_EQ(frames[2].time, 0.14);
    EXPECT_NE(content("out/log.txt").find("adaptive steps: "), std::string::npos);
}

TEST_F(Adaptive, ATighterToleranceTakesMoreSteps) {
    ASSERT_EQ(run(small_run + "-o equal").code, 0);
    double before = steps("equal");
    for (const char* tolerance : {"0.01", "0.001"}) {
        const std::string name = std::string("out") + tolerance;
        ASSERT_EQ(run(adaptive_run + "--set time.tolerance=" + tolerance + " -o " + name).code, 0);
        EXPECT_GT(steps(name), before) << tolerance;
        before = steps(name);
    }
}

TEST_F(Adaptive, ContinuesBitwise) { continue_bitwise(adaptive_run, "--threads 2"); }

// While the steps still grow, between a change and the next one that is waited for.
TEST_F(Adaptive, ContinuesBitwiseWhereTheStepChanges) {
    continue_bitwise(adaptive_run + "--set time.strain=0.02 --set time.tolerance=1 --set " +
                         "output.checkpoint_interval_strain=0.0101",
                     "");
}

/// Two cells and a free body between plates.
const std::string crowded = R"toml(title = "Crowded"
kind = "coupled"
[fluid]
viscosity = "22 mPa s"
[grid]
length = ["12 um", "18 um", "12 um"]
cells = [12, 18, 12]
[boundary]
x = "periodic"
z = "periodic"
y = { velocity = "shear" }
[shear]
rate = "3 1/s"
[[cell]]
nodes = 162
position = ["0 um", "-5.5 um", "0 um"]
[[cell]]
nodes = 162
position = ["0.5 um", "-1.5 um", "0 um"]
[contact]
pressure = "1 Pa"
[[body]]
diameter = "3 um"
motion = "free"
position = ["0 um", "5 um", "0 um"]
[time]
strain = 0.2
adaptive = true
[numerics]
reynolds = 1
[output]
interval_strain = 0.1
checkpoint_interval_strain = 0.12
pictures = false
)toml";

TEST_F(Adaptive, OfSeveralCellsAndABodyContinuesBitwise) {
    write("case.toml", crowded);
    continue_bitwise("run case.toml --quiet --threads 2", "--threads 1");
}

TEST_F(Adaptive, AnInterruptedRunEndsWhereTheUninterruptedOneEnds) {
    const std::string longer = adaptive_run + "--set time.strain=1 ";
    const pid_t pid = start(longer + "-o out", "printed.txt");
    const auto rows = [&] {
        if (!fs::exists(folder_ / "out/history.csv")) return std::ptrdiff_t{0};
        const std::string text = content("out/history.csv");
        return std::count(text.begin(), text.end(), '\n');
    };
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(5);
    while (rows() < 4 && std::chrono::steady_clock::now() < give_up)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    ASSERT_EQ(::kill(pid, SIGINT), 0);
    int status = 0;
    ASSERT_EQ(::waitpid(pid, &status, 0), pid);
    ASSERT_EQ(WEXITSTATUS(status), 130) << content("printed.txt");
    ASSERT_EQ(run("run --quiet --restart out").code, 0);
    ASSERT_EQ(run(longer + "-o whole").code, 0);
    expect_same_end("whole", "out");
}

TEST_F(Adaptive, FailsWithTheNodeWhereStepsWouldBeTooShort) {
    const Outcome outcome = run(adaptive_run + "--set time.tolerance=1e-9 -o out");
    EXPECT_EQ(outcome.code, 3) << outcome.text;
    for (const char* part : {"error: membrane node ", " of cell 0 moves with an error of ",
                             "time.tolerance = 1e-09", "Raise time.tolerance"})
        EXPECT_NE(outcome.text.find(part), std::string::npos) << part << " is not in " << outcome.text;
    EXPECT_NO_THROW(last("out"));
}

TEST_F(BadInput, AdaptiveSteps) {
    const std::string body = "[[body]]\ndiameter = \"1 um\"\nmethod = \"feedback\"\n";
    expect_refused({
        {flow_with("strain = 0.1", "strain = 0.1\nadaptive = true"),
         {"case.toml", "time.adaptive in a case of kind \"fluid\""}},
        {flow_with("strain = 0.1", "strain = 0.1\nadaptive = 1"), {"line 16", "time.adaptive"}},
        {cell_with("strain = 25", "strain = 25\nadaptive = true\nstep = \"1 ms\""),
         {"case.toml", "time.adaptive with time.step", "not given"}},
        {cell_with("strain = 25", "strain = 25\ntolerance = 0.001"),
         {"case.toml", "time.tolerance without time.adaptive = true"}},
        {cell_with("strain = 25", "strain = 25\nadaptive = true\ntolerance = 0"), {"time.tolerance", "R0"}},
        {cell_with("strain = 25", "strain = 25\nadaptive = true\ntolerance = -1"), {"time.tolerance", "R0"}},
        {cell_with("strain = 25\n[numerics]", "strain = 25\nadaptive = true\n[numerics]\nstep_strain = 1e-3"),
         {"case.toml", "time.adaptive with numerics.step_strain"}},
        {cell_with("strain = 25", "strain = 25\nadaptive = true") + body,
         {"case.toml", "time.adaptive with a [[body]] whose stiffness is \"auto\""}},
    });
}

}  // namespace
}  // namespace hemoflux::apps

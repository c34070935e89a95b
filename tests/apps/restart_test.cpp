// Restarts through the built program: bit for bit, elsewhere, of another case, after an interruption.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "apps/output/history.hpp"
#include "apps/output/pvd_series.hpp"
#include "tests/apps/restarts.hpp"

namespace hemoflux::apps {
namespace {

const std::string fluid_case = R"(title = "Start-up of shear"
kind = "fluid"
[fluid]
viscosity = "1 mPa s"
initial = "rest"
[grid]
length = ["2 um", "10 um", "2 um"]
cells = [2, 20, 2]
[boundary]
x = "periodic"
z = "periodic"
y = { velocity = "shear" }
[shear]
rate = "1e4 1/s"
[time]
strain = 0.2
[output]
interval_strain = 0.05
checkpoint_interval_strain = 0.05
pictures = false
)";

TEST_F(Restart, EndsBitwiseWhereTheUninterruptedRunEnds) {
    ASSERT_EQ(run(small_run + "-o whole").code, 0);
    copy_cut_short("whole", "cut");
    ASSERT_LT(last("cut").checkpoint.number("step"), last("whole").checkpoint.number("step"));
    const Outcome outcome = run("run --quiet --restart cut");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    expect_same_end("whole", "cut");
    EXPECT_EQ(content("whole/cells.pvd"), content("cut/cells.pvd"));
    EXPECT_EQ(content("whole/fluid.pvd"), content("cut/fluid.pvd"));
    EXPECT_TRUE(fs::exists(folder_ / "cut/summary.json"));
}

TEST_F(Restart, IntoAnotherFolder) {
    ASSERT_EQ(run(small_run + "-o whole").code, 0);
    copy_cut_short("whole", "cut");
    const std::string before = content("cut/log.txt");
    const Outcome outcome = run("run --quiet --restart cut --output elsewhere --threads 2");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    expect_same_end("whole", "elsewhere");
    EXPECT_EQ(content("cut/log.txt"), before) << "the old folder is left as it is";
    for (const char* series : {"cells.pvd", "fluid.pvd"})
        for (const output::Frame& frame : output::read_pvd(folder_ / "elsewhere" / series))
            EXPECT_TRUE(fs::exists(folder_ / "elsewhere" / frame.file)) << frame.file;
}

TEST_F(Restart, OfTheFluidAlone) {
    write("case.toml", fluid_case);
    ASSERT_EQ(run("run case.toml --quiet -o whole").code, 0);
    copy_cut_short("whole", "cut");
    const Outcome outcome = run("run --quiet --restart cut");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    expect_same_end("whole", "cut");
    EXPECT_EQ(content("whole/fluid.pvd"), content("cut/fluid.pvd"));
}

// Every look at the flow writes a checkpoint, so that the one which ends the run is the first after the restart.
TEST_F(Restart, OfARunThatEndsInTheSteadyState) {
    write("case.toml", fluid_case);
    continue_bitwise(
        "run case.toml --quiet --set time.strain=0.5 --set time.steady=1e-3 --set "
        "output.checkpoint_interval_strain=0.005",
        "");
    EXPECT_LT(output::read_table(folder_ / "whole/history.csv").rows.back()[1], 0.4e-4);
}

TEST_F(Restart, OfAnotherCaseIsRefusedAndChangesNothing) {
    ASSERT_EQ(run(small_run + "-o old").code, 0);
    const std::string log = content("old/log.txt");
    expect_error(small_run + "--restart old --set shear.rate='5 1/s'", 2, "rate = \"5 1/s\"");
    expect_error(small_run + "--restart old --set shear.rate='5 1/s'", 2, "rate = \"3 1/s\"");
    expect_error(small_run + "--restart old --set cell.0.nodes=642 -o new", 2, "nodes = 642");
    EXPECT_FALSE(fs::exists(folder_ / "new"));
    EXPECT_EQ(content("old/log.txt"), log);
    EXPECT_TRUE(fs::exists(folder_ / "old/summary.json"));
}

TEST_F(Restart, WithoutACheckpointIsAFileError) {
    expect_error("run --restart nowhere", 4, "nowhere");
    ASSERT_EQ(run(small_run + "-o empty").code, 0);
    for (int i = 0; i < 2; ++i) fs::remove(last("empty").path);
    expect_error("run --restart empty", 4, "no checkpoint");
}

class Interruption : public Restart {
  protected:
    /// A run is sent the signal, writes a checkpoint, says how to go on, and ends where an uninterrupted one ends.
    void interrupt_by(int signal) const {
        const pid_t pid = start(small_run + "--set time.strain=1 -o out", "printed.txt");
        const auto rows = [&] {
            const fs::path history = folder_ / "out/history.csv";
            if (!fs::exists(history)) return std::ptrdiff_t{0};
            const std::string text = output::read_file(history);
            return std::count(text.begin(), text.end(), '\n');
        };
        const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(5);
        while (rows() < 4 && std::chrono::steady_clock::now() < give_up)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        ASSERT_EQ(::kill(pid, signal), 0);
        int status = 0;
        ASSERT_EQ(::waitpid(pid, &status, 0), pid);
        ASSERT_TRUE(WIFEXITED(status));
        EXPECT_EQ(WEXITSTATUS(status), 130);
        EXPECT_NE(content("printed.txt").find("hemoflux run --restart out"), std::string::npos)
            << content("printed.txt");
        EXPECT_FALSE(fs::exists(folder_ / "out/summary.json"));

        ASSERT_EQ(run("run --quiet --restart out").code, 0);
        ASSERT_EQ(run(small_run + "--set time.strain=1 -o whole").code, 0);
        expect_same_end("whole", "out");
    }
};

TEST_F(Interruption, ByTheKeyboard) { interrupt_by(SIGINT); }
TEST_F(Interruption, ByATermination) { interrupt_by(SIGTERM); }

/// A cell between two plates, the upper of which swings: the boundary condition has a clock.
const std::string swinging = R"toml(title = "Swinging plate"
kind = "coupled"
[fluid]
viscosity = "22 mPa s"
initial = "rest"
[grid]
length = ["12 um", "12 um", "12 um"]
cells = [12, 12, 12]
[boundary]
x = "periodic"
z = "periodic"
"y-" = { velocity = "no-slip" }
"y+" = { velocity = "expression", velocity_expression = ["2e-5*sin(60*t)", "0", "0"] }
[shear]
rate = "3 1/s"
[[cell]]
nodes = 162
position = ["0 um", "-2 um", "0 um"]
[time]
strain = 0.2
[output]
interval_strain = 0.1
checkpoint_interval_strain = 0.12
pictures = false
)toml";
const std::string second_cell =
    "[[cell]]\nnodes = 162\nposition = [\"0.5 um\", \"2 um\", \"0 um\"]\n"
    "[contact]\npressure = \"1 Pa\"\n[time]";
const std::string body =
    "[[body]]\ndiameter = \"3 um\"\nmotion = \"free\"\nposition = [\"0 um\", \"3 um\", \"0 um\"]\n[time]";

std::string swinging_with(const std::string& tables) {
    std::string text = swinging;
    return text.replace(text.find("[time]"), 6, tables);
}

TEST_F(Restart, OfEveryScheme) {
    write("case.toml", swinging);
    for (const char* scheme : {"euler", "rk4", "factored"})
        continue_bitwise(std::string("run case.toml --quiet --set time.scheme=") + scheme, "--threads 2");
}

TEST_F(Restart, OfSeveralCells) {
    write("case.toml", swinging_with(second_cell));
    continue_bitwise("run case.toml --quiet --threads 2", "--threads 1");
}

TEST_F(Restart, OfBodiesBesideCells) {
    write("case.toml", swinging_with(body));
    continue_bitwise("run case.toml --quiet", "");
}

TEST_F(Restart, OfAnotherVersionIsRefused) {
    ASSERT_EQ(run(small_run + "-o old").code, 0);
    output::Checkpoint checkpoint = last("old").checkpoint;
    checkpoint.put_text("version", "0.0.9");
    output::write_checkpoint(last("old").path, checkpoint);
    const std::string message =
        expect_error("run --quiet --restart old", 2, "the version of hemoflux was 0.0.9");
    EXPECT_NE(message.find("and is 0.1.0 now"), std::string::npos) << message;
}

TEST_F(Restart, FromAFolderWhoseFilesAreSpoilt) {
    ASSERT_EQ(run(small_run + "-o old").code, 0);
    copy_cut_short("old", "new");
    write("new/cells.pvd", "garbage");
    expect_error("run --quiet --restart new", 2, "cells.pvd");
    write("new/" + last("new").path.filename().string(), "HEMOFLUXgarbage");
    expect_error("run --quiet --restart new", 4, "damaged");
}

// Twenty splits at random strains, over schemes, numbers of cells and of threads.
TEST_F(ValidationRestart, TwentyRandomSplits) {
    std::mt19937 random(20);
    std::uniform_real_distribution<double> strain(0.101, 0.199);
    const char* const schemes[] = {"euler", "rk4", "factored"};
    for (int i = 0; i < 20; ++i) {
        write("case.toml", i % 2 == 0 ? swinging : swinging_with(i % 4 == 1 ? second_cell : body));
        continue_bitwise("run case.toml --quiet --set time.scheme=" + std::string(schemes[i % 3]) +
                             " --set output.checkpoint_interval_strain=" + std::to_string(strain(random)) +
                             " --threads " + std::to_string(1 + i % 2),
                         "--threads " + std::to_string(2 - i % 2));
    }
}

}  // namespace
}  // namespace hemoflux::apps

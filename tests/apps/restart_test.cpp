// Restarts through the built program: bit for bit, elsewhere, of another case, after an interruption.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "apps/output/checkpoint.hpp"
#include "apps/output/pvd_series.hpp"
#include "tests/apps/program.hpp"

namespace hemoflux::apps {
namespace {

class Restart : public Program {
  protected:
    [[nodiscard]] output::LatestCheckpoint last(const std::string& run_folder) const {
        return output::latest_checkpoint(folder_ / run_folder);
    }

    /// Copies a finished run as it was before its last checkpoint: a run that was killed.
    void copy_cut_short(const std::string& from, const std::string& to) const {
        fs::copy(folder_ / from, folder_ / to);
        fs::remove(last(to).path);
        fs::remove(folder_ / to / "summary.json");
    }

    void expect_same_end(const std::string& a, const std::string& b) const {
        EXPECT_EQ(content(a + "/history.csv"), content(b + "/history.csv"));
        EXPECT_EQ(last(a).path.filename(), last(b).path.filename());
        EXPECT_TRUE(output::read_file(last(a).path) == output::read_file(last(b).path));
    }

    /// Starts the program, its output in `log`.
    [[nodiscard]] pid_t start(const std::string& arguments, const std::string& log) const {
        const pid_t pid = ::fork();
        if (pid == 0) {
            const int file = ::open((folder_ / log).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
            ::dup2(file, STDOUT_FILENO);
            ::dup2(file, STDERR_FILENO);
            const std::string command =
                "cd '" + folder_.string() + "' && HEMOFLUX_THREADS=1 exec " HEMOFLUX_PROGRAM " " + arguments;
            ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
            ::_exit(127);
        }
        return pid;
    }
};

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

TEST_F(Restart, OfAnotherCaseIsRefusedAndChangesNothing) {
    ASSERT_EQ(run(small_run + "-o old").code, 0);
    const std::string log = content("old/log.txt");
    expect_error(small_run + "--restart old --set shear.rate='5 1/s'", 2, "rate = \"5 1/s\"");
    expect_error(small_run + "--restart old --set shear.rate='5 1/s'", 2, "rate = \"3 1/s\"");
    expect_error(small_run + "--restart old --set cell.0.nodes=42 -o new", 2, "nodes = 42");
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

TEST_F(Restart, AfterAnInterruption) {
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
    ASSERT_EQ(::kill(pid, SIGINT), 0);
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

}  // namespace
}  // namespace hemoflux::apps

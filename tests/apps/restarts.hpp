// Runs that are cut, killed or interrupted, and then continued.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

#include "apps/output/checkpoint.hpp"
#include "tests/apps/program.hpp"

namespace hemoflux::apps {

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

    /// Runs the command as a whole, and once more from its last checkpoint but one with `more` on the command line.
    void continue_bitwise(const std::string& command, const std::string& more) const {
        SCOPED_TRACE(command);
        const Outcome whole = run(command + " -o whole");
        ASSERT_EQ(whole.code, 0) << whole.text;
        copy_cut_short("whole", "cut");
        ASSERT_LT(last("cut").checkpoint.number("step"), last("whole").checkpoint.number("step"));
        const Outcome rest = run("run --quiet --restart cut " + more);
        ASSERT_EQ(rest.code, 0) << rest.text;
        expect_same_end("whole", "cut");
        fs::remove_all(folder_ / "cut");
    }

    /// Starts the program, its output in `log`.
    [[nodiscard]] pid_t start(const std::string& arguments, const std::string& log) const {
        const pid_t pid = ::fork();
        if (pid == 0) {
            const int file = ::open((folder_ / log).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
            ::dup2(file, STDOUT_FILENO);
            ::dup2(file, STDERR_FILENO);
            const std::string command =
                "cd '" + folder_.string() +
                "' && OMP_WAIT_POLICY=passive HEMOFLUX_THREADS=1 exec " HEMOFLUX_PROGRAM " " + arguments;
            ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
            ::_exit(127);
        }
        return pid;
    }
};

class ValidationRestart : public Restart {};

}  // namespace hemoflux::apps

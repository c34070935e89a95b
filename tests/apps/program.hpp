// The built program, run in a scratch folder of its own as a user runs it.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "apps/output/atomic_file.hpp"
#include "tests/apps/example_case.hpp"

namespace hemoflux::apps {

namespace fs = std::filesystem;

class Program : public ::testing::Test {
  protected:
    struct Outcome {
        int code;
        std::string text;  ///< standard output and error
    };

    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "hemoflux-run-XXXXXX").string();
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }

    /// Runs the program in the scratch folder, on one thread unless --threads is given.
    [[nodiscard]] Outcome run(const std::string& arguments) const {
        const std::string command = "cd '" + folder_.string() +
                                    "' && OMP_WAIT_POLICY=passive HEMOFLUX_THREADS=1 " HEMOFLUX_PROGRAM " " +
                                    arguments + " 2>&1";
        return run_command(command);
    }

    /// Runs any command.
    [[nodiscard]] static Outcome run_command(const std::string& command) {
        FILE* pipe = popen(command.c_str(), "r");
        Outcome outcome{-1, ""};
        std::array<char, 4096> part;
        for (std::size_t n = 0; (n = fread(part.data(), 1, part.size(), pipe)) > 0;)
            outcome.text.append(part.data(), n);
        const int status = pclose(pipe);
        outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        return outcome;
    }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return name;
    }

    [[nodiscard]] std::string content(const std::string& name) const {
        return output::read_file(folder_ / name);
    }

    /// The program ends with `code` and exactly one line "error: what: why. what to do." that has `part`; the line.
    std::string expect_error(const std::string& arguments, int code, const std::string& part) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.code, code) << arguments << "\n" << outcome.text;
        EXPECT_TRUE(outcome.text.starts_with("error: ")) << outcome.text;
        EXPECT_TRUE(outcome.text.ends_with(".\n")) << outcome.text;
        EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
        const auto colon = outcome.text.find(": ", 7);
        EXPECT_NE(colon, std::string::npos) << outcome.text;
        EXPECT_NE(outcome.text.find(". ", colon), std::string::npos) << outcome.text;
        EXPECT_NE(outcome.text.find(part), std::string::npos)
            << "\"" << part << "\" is not in: " << outcome.text;
        return outcome.text;
    }

    fs::path folder_;
};

/// The quick case in little: a coarse cell on a coarse grid for a fifth of a strain unit.
inline const std::string small_run =
    "run '" HEMOFLUX_CASES
    "/tank_treading_quick.toml' --quiet --set cell.0.nodes=162 --set 'grid.cells=[16, 16, 16]' --set "
    "'grid.plateau={ a = 5, b = 0.4 }' --set time.strain=0.2 --set output.pictures=false --set "
    "output.window_strain=auto --set output.checkpoint_interval_strain=0.05 ";

}  // namespace hemoflux::apps

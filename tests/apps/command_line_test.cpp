// The built program, as a user meets it: exit codes and messages.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "apps/output/history.hpp"
#include "apps/output/summary.hpp"
#include "tests/apps/example_case.hpp"

namespace hemoflux::apps {
namespace {

namespace fs = std::filesystem;

class CommandLine : public ::testing::Test {
  protected:
    struct Outcome {
        int code;
        std::string text;  ///< standard output and error
    };

    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("hemoflux_cli_" + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    /// Runs the program in the scratch folder.
    Outcome run(const std::string& arguments) const {
        const std::string command =
            "cd '" + folder_.string() + "' && " HEMOFLUX_PROGRAM " " + arguments + " 2>&1";
        FILE* pipe = popen(command.c_str(), "r");
        Outcome outcome{-1, ""};
        std::array<char, 4096> part;
        for (std::size_t n = 0; (n = fread(part.data(), 1, part.size(), pipe)) > 0;) {
            outcome.text.append(part.data(), n);
        }
        const int status = pclose(pipe);
        outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        return outcome;
    }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return name;
    }

    /// The program ends with `code` and exactly one line "error: ..." that has `part`.
    void expect_error(const std::string& arguments, int code, const std::string& part) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.code, code) << arguments << "\n" << outcome.text;
        EXPECT_TRUE(outcome.text.starts_with("error: ")) << outcome.text;
        EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
        EXPECT_NE(outcome.text.find(part), std::string::npos)
            << "\"" << part << "\" is not in: " << outcome.text;
    }
    void expect_bad(const std::string& from, const std::string& to, const std::string& part) const {
        expect_error("run --check " + write("case.toml", example_with(from, to)), 2, part);
    }

    fs::path folder_;
};

TEST_F(CommandLine, HelpAndVersionAtEveryLevel) {
    for (const char* level : {"", "run", "mesh", "mesh grid", "mesh rbc", "membrane", "membrane relax",
                              "membrane stretch", "schema"}) {
        const Outcome outcome = run(std::string(level) + " --help");
        EXPECT_EQ(outcome.code, 0) << level;
        EXPECT_NE(outcome.text.find("Example"), std::string::npos) << level << "\n" << outcome.text;
    }
    EXPECT_EQ(run("--version").code, 0);
    EXPECT_TRUE(run("--version").text.starts_with("hemoflux "));
}

TEST_F(CommandLine, WrongCommandsAreBadInput) {
    EXPECT_EQ(run("").code, 2);
    EXPECT_EQ(run("rnu case.toml").code, 2);
    EXPECT_EQ(run("run --no-such-option").code, 2);
    EXPECT_EQ(run("run").code, 2);
}

TEST_F(CommandLine, BadCases) {
    expect_bad("viscosity = \"22", "viscsity = \"22", "unknown key \"viscsity\"");
    expect_bad("viscosity = \"22 mPa s\"\n", "", "\"viscosity\" is missing");
    expect_bad("22 mPa s", "22 mPs", "\"mPs\" is not a unit");
    expect_bad("22 mPa s", "-22 mPa s", "a viscosity is positive");
    expect_bad("position = [\"0 um\", \"0 um\"", "position = [\"0 um\", \"9 um\"", "is outside the box");
    expect_bad("position = [\"0 um\", \"0 um\"", "position = [\"0 um\", \"5.5 um\"", "overlaps the side");
    expect_bad("nodes = 2562", "nodes = 12", "at least 42 nodes");
    expect_bad("kind = \"coupled\"", "kind = ", "not valid TOML");
    expect_bad("strain = 25", "", "the run has no length");
    expect_bad("\"x\" = \"periodic\"", "\"x-\" = \"periodic\"", "no boundary condition");
}

TEST_F(CommandLine, OpenSurfaceIsBadInput) {
    write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
    expect_bad("mesh = \"icosphere\"", "file = \"open.obj\"", "open.obj");
}

TEST_F(CommandLine, UnreadableFilesHaveTheirOwnCode) {
    expect_error("run missing.toml", 4, "missing.toml");
    const std::string text = example_with("mesh = \"icosphere\"", "file = \"missing.vtp\"");
    expect_error("run --check " + write("case.toml", text), 4, "missing.vtp");
}

TEST_F(CommandLine, UnwritableFilesHaveTheirOwnCode) {
    expect_error("mesh rbc --nodes 42 --shape sphere -o /proc/none/rbc.vtp", 4, "/proc/none");
    expect_error("mesh grid --cells 4 -o /proc/none/grid.vtr", 4, "/proc/none");
}

TEST_F(CommandLine, CoarseGridIsAWarning) {
    const std::string file = write("case.toml", example_with("cells = [30, 30, 30]", "cells = [8, 8, 8]"));
    const Outcome outcome = run("run --check " + file + " --set cell.0.nodes=642 --set grid.kind=uniform");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(outcome.text.starts_with("warning: ")) << outcome.text;
}

TEST_F(CommandLine, CheckPrintsACaseThatCanBeRunAgain) {
    const std::string file = write("case.toml", example_case);
    const Outcome first = run("run --check --set cell.0.nodes=162 " + file);
    ASSERT_EQ(first.code, 0) << first.text;
    EXPECT_NE(first.text.find("nodes = 162"), std::string::npos);
    const Outcome second = run("run --check " + write("resolved.toml", first.text));
    EXPECT_EQ(second.text, first.text);
}

TEST_F(CommandLine, MeshGridPrintsSizesAndWrites) {
    const Outcome outcome =
        run("mesh grid --kind plateau --length '12 um' --cells 30 --plateau 10 0.2 -o grid.vtr");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("30 x 30 x 30 = 27000"), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find("cells of 0.2687"), std::string::npos)
        << outcome.text;  // spec: smallest cell 0.269 um
    EXPECT_TRUE(fs::exists(folder_ / "grid.vtr"));
    EXPECT_EQ(run("mesh grid --cells 3 3").code, 2);
    EXPECT_EQ(run("mesh grid --length 12").code, 2);
    EXPECT_EQ(run("mesh grid --cells 0").code, 2);
}

TEST_F(CommandLine, MeshRbcPrintsSizesAndWrites) {
    const Outcome outcome = run("mesh rbc --nodes 2562 --shape evans-fung --area '134.1 um^2' -o rbc.ply");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("nodes            2562"), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find("area             133.88"), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find("volume           93.89"), std::string::npos) << outcome.text;
    EXPECT_TRUE(fs::exists(folder_ / "rbc.ply"));
    EXPECT_EQ(run("mesh rbc --nodes 100").code, 2);
    EXPECT_EQ(run("mesh rbc --nodes 42 --shape sphere -o rbc.xyz").code, 2);
}

TEST_F(CommandLine, MembraneRelaxWritesItsFolder) {
    const Outcome outcome =
        run("membrane relax --nodes 162 --set cell.0.reference=spheroid --output relaxed");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    for (const char* file : {"resolved.toml", "summary.json", "cells.pvd", "cells_0000.vtp", "log.txt"}) {
        EXPECT_TRUE(fs::exists(folder_ / "relaxed" / file)) << file;
    }
    EXPECT_NE(outcome.text.find("diameter_um"), std::string::npos) << outcome.text;
    EXPECT_EQ(run("run relaxed/resolved.toml --quiet -o again").text, "");
}

TEST_F(CommandLine, MembraneStretchWritesItsCurve) {
    const Outcome outcome =
        run("membrane stretch --nodes 642 --reference stress-free --shear-modulus '6.1 uN/m' "
            "--forces '0 pN' '0.1 nN' --set output.pictures=false --quiet -o pulled");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(outcome.text, "");
    const output::Table table = output::read_table(folder_ / "pulled" / "stretch.csv");
    EXPECT_EQ(table.columns, (std::vector<std::string>{"force_pN", "axial_um", "transverse_um", "iterations",
                                                       "area_error", "volume_error"}));
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_DOUBLE_EQ(table.column("force_pN")[1], 100);
    EXPECT_NEAR(table.column("axial_um")[1], 13.21,
                0.05);  // an independent implementation of the same method
    EXPECT_NEAR(table.column("transverse_um")[1], 5.44, 0.05);
    const output::Summary summary = output::read_summary(folder_ / "pulled" / "summary.json");
    EXPECT_DOUBLE_EQ(summary.observables.at("axial_diameter_um"), table.column("axial_um")[1]);
}

TEST_F(CommandLine, MembraneInputIsChecked) {
    expect_error("membrane relax --nodes 12 -o x", 2, "at least 42 nodes");
    expect_error("membrane relax --nodes 100 -o x", 2, "642");
    expect_error("membrane relax --reference unform -o x", 2, "\"uniform\" was meant");
    expect_error("membrane stretch --forces 100 -o x", 2, "the unit is missing");
    expect_error("membrane relax --nodes 42 -o /proc/none/x", 4, "/proc/none/x");
    write("note.txt", "not a run\n");
    expect_error("membrane relax --nodes 42 -o .", 2, "is not empty");
}

TEST_F(CommandLine, SchemaIsThePage) {
    const Outcome outcome = run("schema");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(outcome.text.starts_with("# The case file"));
}

}  // namespace
}  // namespace hemoflux::apps

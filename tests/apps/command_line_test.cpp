// The built program, as a user meets it: exit codes and messages.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "apps/output/history.hpp"
#include "apps/output/summary.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/surface_io.hpp"
#include "tests/apps/program.hpp"

namespace hemoflux::apps {
namespace {

class CommandLine : public Program {
  protected:
    /// The example case with one change is refused by `run --check`, and by `run`, which leaves nothing.
    void expect_bad(const std::string& from, const std::string& to, const std::string& part) const {
        write("case.toml", example_with(from, to));
        expect_error("run --check case.toml", 2, part);
        expect_error("run case.toml -o bad", 2, part);
        EXPECT_FALSE(fs::exists(folder_ / "bad")) << part;
    }
};

TEST_F(CommandLine, HelpAndVersionAtEveryLevel) {
    for (const char* level : {"",
                              "run",
                              "sweep",
                              "mesh",
                              "mesh grid",
                              "mesh rbc",
                              "mesh hex",
                              "mesh hex cube",
                              "mesh hex cylinder",
                              "mesh hex pipe",
                              "mesh hex constriction",
                              "mesh hex box",
                              "mesh hex check",
                              "membrane",
                              "membrane relax",
                              "membrane stretch",
                              "membrane shapes",
                              "membrane moduli",
                              "membrane relax-back",
                              "membrane calibrate",
                              "bench",
                              "bench thesis",
                              "schema",
                              "report"}) {
        const Outcome outcome = run(std::string(level) + " --help");
        EXPECT_EQ(outcome.code, 0) << level;
        EXPECT_NE(outcome.text.find("Example"), std::string::npos) << level << "\n" << outcome.text;
    }
    EXPECT_EQ(run("--version").code, 0);
    EXPECT_TRUE(run("--version").text.starts_with("hemoflux "));
}

TEST_F(CommandLine, WrongCommandsAreBadInput) {
    expect_error("", 2, "hemoflux needs one of run, sweep, mesh, membrane, bench, schema, report");
    expect_error("rnu case.toml", 2, "\"rnu\" is not a command");
    expect_error("mesh rcb", 2, "hemoflux mesh has grid, rbc, hex");
    expect_error("membrane", 2, "hemoflux membrane needs one of relax, stretch");
    expect_error("run --no-such-option", 2, "See hemoflux run --help");
    expect_error("run case.toml --threads -1", 2, "--threads");
    expect_error("run", 2, "No case is given");
}

TEST_F(CommandLine, Benchmarks) {
    const Outcome outcome = run("bench --quick --json speed.json");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("residual, cubic cells"), std::string::npos) << outcome.text;
    EXPECT_NE(content("speed.json").find("\"cells_per_s_per_core\""), std::string::npos);
    const Outcome thesis = run("bench thesis --quick");
    EXPECT_EQ(thesis.code, 0) << thesis.text;
    EXPECT_NE(thesis.text.find("15550"), std::string::npos) << thesis.text;
    EXPECT_NE(thesis.text.find("1177.27"), std::string::npos) << thesis.text;
    for (const char* column : {"483", "126", "25897", "11531", "15709"})
        EXPECT_NE(thesis.text.find(column), std::string::npos) << column << thesis.text;
    EXPECT_EQ(thesis.text.find("nan"), std::string::npos) << thesis.text;
    expect_error("bench --cells 4", 2, "--cells");
}

TEST_F(CommandLine, BadCases) {
    expect_bad("viscosity = \"22", "viscsity = \"22", "unknown key \"viscsity\"");
    expect_bad("viscosity = \"22 mPa s\"\n", "", "\"viscosity\" is missing");
    expect_bad("22 mPa s", "22 mPs", "\"mPs\" is not a unit");
    expect_bad("22 mPa s", "-22 mPa s", "a viscosity is positive");
    expect_bad("position = [\"0 um\", \"0 um\"", "position = [\"0 um\", \"9 um\"", "is outside the box");
    expect_bad("position = [\"0 um\", \"0 um\"", "position = [\"0 um\", \"5.5 um\"", "overlaps the side");
    expect_bad("nodes = 2562", "nodes = 12", "an icosphere has 10 4^level + 2 nodes");
    expect_bad("kind = \"coupled\"", "kind = ", "not valid TOML");
    expect_bad("strain = 25", "", "the run has no length");
    expect_bad("\"x\" = \"periodic\"", "\"x-\" = \"periodic\"", "no boundary condition");
}

TEST_F(CommandLine, BadSurfaces) {
    meshing::SurfaceMesh sphere = meshing::icosphere(2, 3.0);  // 162 nodes
    const meshing::Triangle removed = sphere.triangles.back();
    sphere.triangles.pop_back();
    meshing::write_surface((folder_ / "open.vtp").string(), sphere);
    expect_bad("mesh = \"icosphere\"", "file = \"open.vtp\"", "open.vtp");
    const std::string text = run("run --check case.toml").text;
    EXPECT_NE(text.find("edge"), std::string::npos) << text;
    for (const int vertex : removed) EXPECT_NE(text.find(std::to_string(vertex)), std::string::npos) << text;

    meshing::write_surface((folder_ / "coarse.vtp").string(), meshing::icosphere(0, 3.0));
    expect_bad("mesh = \"icosphere\"", "file = \"coarse.vtp\"", "42");
    write("malformed.vtp", "<VTKFile type=\"PolyData\"><PolyData>");
    expect_bad("mesh = \"icosphere\"", "file = \"malformed.vtp\"", "malformed.vtp");
}

TEST_F(CommandLine, WhatTheSolversRefuseIsBadInputToo) {
    expect_bad("lattice_viscosity", "gamma = 0.5\nlattice_viscosity", "gamma");
    expect_bad("[output]", "[output]\nwindow_strain = [90, 99]", "window_strain");
    expect_bad("[coupling]", "[[cell]]\nnodes = 642\nposition = [\"0 um\", \"3 um\", \"0 um\"]\n[coupling]",
               "[[cell]] number 1");
    write("still.toml",
          "title = \"t\"\nkind = \"fluid\"\n[fluid]\nviscosity = \"1 mPa s\"\n[grid]\ncells = [4, 4, 4]\n"
          "length = [\"1 um\", \"1 um\", \"1 um\"]\n[boundary]\nx = \"periodic\"\ny = \"periodic\"\n"
          "z = \"periodic\"\n[time]\nduration = \"1 s\"\n");
    expect_error("run --check still.toml", 2, "nothing will flow");
    expect_error("run still.toml -o bad", 2, "nothing will flow");
    EXPECT_FALSE(fs::exists(folder_ / "bad"));
}

TEST_F(CommandLine, BadInputSparesAnEarlierRun) {
    ASSERT_EQ(run(small_run + "--set time.strain=0.01 -o out").code, 0);
    const std::string summary = content("out/summary.json");
    expect_error(small_run + "--set numerics.gamma=0.5 -o out", 2, "gamma");
    EXPECT_EQ(content("out/summary.json"), summary);
    expect_error(small_run + "--set numerics.gama=0.5 -o out", 2, "\"gamma\"");
    EXPECT_EQ(content("out/summary.json"), summary);
}

TEST_F(CommandLine, UnreadableFilesHaveTheirOwnCode) {
    expect_error("run missing.toml", 4, "missing.toml");
    expect_error("run .", 4, "Is a directory");
    const std::string text = example_with("mesh = \"icosphere\"", "file = \"missing.vtp\"");
    expect_error("run --check " + write("case.toml", text), 4, "missing.vtp");
}

TEST_F(CommandLine, UnwritableFilesHaveTheirOwnCode) {
    write("file", "a regular file\n");  // nothing can be below it, even for root
    expect_error(small_run + "-o file/out", 4, "file/out");
    expect_error(small_run + "-o file", 4, "output folder file: ");
    expect_error("mesh rbc --nodes 42 --shape sphere -o /proc/none/rbc.vtp", 4, "/proc/none");
    expect_error("mesh grid --cells 4 -o /proc/none/grid.vtr", 4, "/proc/none");
}

TEST_F(CommandLine, CoarseGridIsAWarningAndTheRunGoesOn) {
    const std::string coarse =
        small_run + "--set 'grid.cells=[8, 8, 8]' --set grid.kind=uniform --set numerics.reynolds=1 ";
    const std::string warning = "warning: cell.0: only 0.5";
    const Outcome checked = run(coarse + "--check");
    EXPECT_EQ(checked.code, 0) << checked.text;
    EXPECT_TRUE(checked.text.starts_with(warning)) << checked.text;
    EXPECT_NE(checked.text.find("grid cells across its thinnest part"), std::string::npos) << checked.text;
    const Outcome done = run(coarse + "--set time.strain=0.01 -o out");
    EXPECT_EQ(done.code, 0) << done.text;
    EXPECT_TRUE(done.text.starts_with(warning)) << done.text;
    EXPECT_EQ(std::count(done.text.begin(), done.text.end(), '\n'), 1) << done.text;
    EXPECT_TRUE(fs::exists(folder_ / "out/summary.json"));
}

TEST_F(CommandLine, NodesTooFarApartForTheGridAreWarnedOf) {
    write("case.toml", example_case);
    EXPECT_EQ(run("run --check case.toml --set cell.0.nodes=642").text.find("warning"), std::string::npos);
    const std::string text = run("run --check case.toml --set cell.0.nodes=42").text;
    EXPECT_TRUE(text.starts_with("warning: cell.0: its nodes are 1.9 um apart")) << text;
}

TEST_F(CommandLine, CheckPrintsACaseThatCanBeRunAgain) {
    const std::string file = write("case.toml", example_case);
    const Outcome first = run("run --check --set cell.0.nodes=642 " + file);
    ASSERT_EQ(first.code, 0) << first.text;
    EXPECT_NE(first.text.find("nodes = 642"), std::string::npos);
    // what is derived is a comment, and its estimates are of the moment
    const auto lasting = [](const std::string& text) {
        std::istringstream lines(text);
        std::string kept;
        for (std::string line; std::getline(lines, line);)
            if (!line.starts_with("#   estimated")) kept += line + "\n";
        return kept;
    };
    for (const char* name : {"capillary number", "Reynolds number", "Mach number", "nu/h = 0.5", "steps",
                             "estimated run time", "an estimate", "estimated memory"})
        EXPECT_NE(first.text.find(name), std::string::npos) << name << "\n" << first.text;
    const Outcome second = run("run --check " + write("resolved.toml", first.text));
    EXPECT_EQ(lasting(second.text), lasting(first.text));
}

TEST_F(CommandLine, MeshGridPrintsSizesAndWrites) {
    const Outcome outcome =
        run("mesh grid --kind plateau --length '12 um' --cells 30 --plateau 10 0.2 -o grid.vtr");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("30 x 30 x 30 = 27000"), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find("cells of 0.2687"), std::string::npos)
        << outcome.text;  // the smallest by (5.31)
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

TEST_F(CommandLine, MeshHexReportsQualityAndWrites) {
    const Outcome made = run("mesh hex box --cells 6 5 4 --upper 3 2 1 --skew 0.03 --shuffle -o box.msh");
    EXPECT_EQ(made.code, 0) << made.text;
    EXPECT_NE(made.text.find("cells                120\n"), std::string::npos) << made.text;
    EXPECT_NE(made.text.find("volume               6 L^3"), std::string::npos) << made.text;
    EXPECT_NE(made.text.find("patch y+             24 faces"), std::string::npos) << made.text;
    const Outcome checked = run("mesh hex check box.msh --scale 10 -o box.vtu");
    EXPECT_EQ(checked.code, 0) << checked.text;
    EXPECT_NE(checked.text.find("volume               6000 L^3"), std::string::npos) << checked.text;
    EXPECT_TRUE(fs::exists(folder_ / "box.vtu"));
    expect_error("mesh hex box --skew 1", 2, "turned inside out");
    expect_error("mesh hex box -o box.stl", 2, "Use .msh (gmsh) or .vtu (VTK)");
    expect_error("mesh hex check absent.msh", 4, "absent.msh");
    expect_error("mesh hex sphere", 2, "cube, cylinder, pipe, constriction, box, check");
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
    EXPECT_EQ(table.columns, (std::vector<std::string>{"cell", "force_pN", "axial_um", "transverse_um",
                                                       "iterations", "area_error", "volume_error"}));
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_DOUBLE_EQ(table.column("force_pN")[1], 100);
    EXPECT_NEAR(table.column("axial_um")[1], 13.21,
                0.05);  // an independent implementation of the same method
    EXPECT_NEAR(table.column("transverse_um")[1], 5.44, 0.05);
    const output::Summary summary = output::read_summary(folder_ / "pulled" / "summary.json");
    EXPECT_DOUBLE_EQ(summary.observables.at("axial_diameter_um"), table.column("axial_um")[1]);
}

TEST_F(CommandLine, MembraneInputIsChecked) {
    expect_error("membrane relax --nodes 12 -o x", 2, "an icosphere has 10 4^level + 2 nodes");
    expect_error("membrane relax --nodes 100 -o x", 2, "642");
    expect_error("membrane relax --reference unform -o x", 2, "\"uniform\" was meant");
    expect_error("membrane stretch --forces 100 -o x", 2, "the unit is missing");
    expect_error("membrane relax --nodes 42 -o /proc/none/x", 4, "/proc/none/x");
    expect_error("membrane stretch --set membrane.experiment=none.csv -o x", 4, "none.csv");
    write("bad.csv", "F_pN,DA_um\n0,8\n");
    expect_error("membrane stretch --set membrane.experiment=bad.csv -o x", 2, "DT_um");
    EXPECT_FALSE(fs::exists(folder_ / "x"));
    write("note.txt", "not a run\n");
    expect_error("membrane relax --nodes 42 -o .", 2, "is not empty");
}

TEST_F(CommandLine, SchemaIsThePage) {
    const Outcome outcome = run("schema");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(outcome.text.starts_with("# The case file"));
    const Outcome json = run("schema --json");
    EXPECT_EQ(json.code, 0);
    EXPECT_TRUE(json.text.starts_with("{"));
    for (const char* part :
         {"\"$schema\" : \"http://json-schema.org/draft-07/schema#\"", "\"additionalProperties\" : false",
          "\"exclusiveMinimum\" : 0", "\"default\" : \"6.1 uN/m\"", "\"watchdog\" :", "\"enum\" :"})
        EXPECT_NE(json.text.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace hemoflux::apps

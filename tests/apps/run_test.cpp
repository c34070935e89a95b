// Runs from end to end through the built program: what they leave behind, threads, exact flows, failures.
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkRectilinearGrid.h>
#include <vtkXMLRectilinearGridReader.h>

#include <algorithm>
#include <cmath>

#include "apps/output/checkpoint.hpp"
#include "apps/output/history.hpp"
#include "apps/output/pvd_series.hpp"
#include "apps/output/summary.hpp"
#include "tests/apps/program.hpp"

namespace hemoflux::apps {
namespace {

using output::Table;

class Run : public Program {
  protected:
    [[nodiscard]] output::Summary summary(const std::string& run_folder) const {
        return output::read_summary(folder_ / run_folder / "summary.json");
    }
    [[nodiscard]] output::LatestCheckpoint last(const std::string& run_folder) const {
        return output::latest_checkpoint(folder_ / run_folder);
    }

    /// Velocity in x in the last frame, in the cells along y, and their centres.
    struct Profile {
        std::vector<double> y, u;
    };
    [[nodiscard]] Profile profile(const std::string& run_folder) const {
        const auto frames = output::read_pvd(folder_ / run_folder / "fluid.pvd");
        const vtkNew<vtkXMLRectilinearGridReader> reader;
        reader->SetFileName((folder_ / run_folder / frames.back().file).c_str());
        reader->Update();
        vtkRectilinearGrid* grid = reader->GetOutput();
        vtkDataArray* y = grid->GetYCoordinates();
        vtkDataArray* u = grid->GetCellData()->GetArray("velocity_um_per_s");
        const auto columns = grid->GetXCoordinates()->GetNumberOfTuples() - 1;
        Profile p;
        for (vtkIdType j = 0; j + 1 < y->GetNumberOfTuples(); ++j) {
            p.y.push_back((y->GetTuple1(j) + y->GetTuple1(j + 1)) / 2);
            p.u.push_back(u->GetComponent(j * columns, 0));
        }
        return p;
    }
};

// Between plates 10 um apart; rho a H^2/(8 mu) = 50 mm/s and lid/2 are the speeds in the middle.
std::string channel(const std::string& sides, const std::string& drive) {
    return "title = \"Channel\"\nkind = \"fluid\"\n[fluid]\nviscosity = \"1 mPa s\"\n[grid]\n"
           "length = [\"2 um\", \"10 um\", \"2 um\"]\ncells = [2, 20, 2]\n[boundary]\nx = \"periodic\"\n"
           "z = \"periodic\"\n" +
           sides + drive +
           "[time]\nduration = \"200 us\"\n[output]\ninterval = \"20 us\"\npictures = false\n";
}
const std::string poiseuille =
    channel("y = { velocity = \"no-slip\" }\n",
            "[body_force]\nacceleration = [\"4000 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n");

TEST_F(Run, LeavesTheDocumentedFolder) {
    const Outcome outcome = run(small_run + "-o out");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(outcome.text, "");
    for (const char* file : {"resolved.toml", "summary.json", "history.csv", "log.txt", "fluid.pvd",
                             "fluid_0000.vtr", "cells.pvd", "cells_0000.vtp"})
        EXPECT_TRUE(fs::exists(folder_ / "out" / file)) << file;
    const Table history = output::read_table(folder_ / "out/history.csv");
    EXPECT_EQ(history.columns, (std::vector<std::string>{"step",
                                                         "time_s",
                                                         "strain",
                                                         "0.x_um",
                                                         "0.y_um",
                                                         "0.z_um",
                                                         "0.inclination_deg",
                                                         "0.tank_treading_deg",
                                                         "0.taylor_d",
                                                         "0.axial_um",
                                                         "0.transverse_um",
                                                         "0.area_error",
                                                         "0.volume_error",
                                                         "0.energy_aJ",
                                                         "0.deformation_index_pct",
                                                         "0.taylor_d_volume",
                                                         "0.taylor_d_extent",
                                                         "0.deformation_index_ellipse_pct",
                                                         "mean_density",
                                                         "residual",
                                                         "dt_s"}));
    EXPECT_NEAR(history.column("strain").back(), 0.2, 1e-12);
    EXPECT_NEAR(history.column("time_s").back(), 0.2 / 3, 1e-12);
    EXPECT_EQ(history.rows.size(), 5u);  // every 0.05
    const output::Summary s = summary("out");
    for (const char* name : {"inclination_deg", "tank_treading_cycles_per_strain", "taylor_d",
                             "taylor_d_volume", "taylor_d_extent", "strain"})
        EXPECT_TRUE(std::isfinite(s.observables.at(name))) << name;
    EXPECT_TRUE(std::isnan(s.observables.at("period_strain")));  // no half turn in a fifth of a strain unit
    EXPECT_LT(s.conservation.volume, 2e-4);
    EXPECT_LT(s.conservation.area, 5e-4);
    EXPECT_LT(s.conservation.centroid_um, 1e-9);  // recentred
    EXPECT_LE(s.performance.residuals_per_strain, 700);
    EXPECT_EQ(s.performance.steps, history.column("step").back());
    EXPECT_TRUE(s.errors_estimated.contains("compressibility"));
    // the cell has begun to turn its upper side with the flow
    EXPECT_GT(history.column("0.inclination_deg").back(), 2);
}

TEST_F(Run, SummaryHasOneShapeForEveryKind) {
    write("fluid.toml", poiseuille);
    ASSERT_EQ(run(small_run + "-o coupled").code, 0);
    ASSERT_EQ(run("run fluid.toml --quiet --set grid.cells='[2, 10, 2]' -o fluid").code, 0);
    ASSERT_EQ(run("membrane relax --nodes 42 --quiet -o membrane").code, 0);
    const auto keys = [&](const std::string& kind) {
        std::vector<std::string> found;
        const std::string text = content(kind + "/summary.json");
        for (const char* key :
             {"\"case\"", "\"version\"", "\"backend\"", "\"threads\"", "\"observables\"", "\"references\"",
              "\"conservation\"", "\"volume\"", "\"area\"", "\"mean_density_per_strain\"", "\"centroid_um\"",
              "\"performance\"", "\"wall_s\"", "\"cpu_s\"", "\"steps\"", "\"residuals_per_strain\"",
              "\"cell_residuals_per_s\"", "\"peak_rss_mib\"", "\"errors_estimated\""})
            if (text.find(key) == std::string::npos) found.emplace_back(key);
        return found;
    };
    for (const char* kind : {"coupled", "fluid", "membrane"}) {
        EXPECT_EQ(keys(kind), std::vector<std::string>{}) << "missing in " << kind;
        EXPECT_FALSE(summary(kind).observables.empty()) << kind;
        EXPECT_GT(summary(kind).performance.peak_rss_mib, 1) << kind;
    }
}

TEST_F(Run, ThreadsAndRepetitionDoNotChangeABit) {
    ASSERT_EQ(run(small_run + "--threads 1 -o one").code, 0);
    ASSERT_EQ(run(small_run + "--threads 2 -o two").code, 0);
    ASSERT_EQ(run(small_run + "--threads 2 -o again").code, 0);
    const output::LatestCheckpoint one = last("one");
    EXPECT_EQ(one.checkpoint.array("fluid.u").size(), 4096u);
    for (const char* other : {"two", "again"}) {
        EXPECT_EQ(content("one/history.csv"), content(std::string(other) + "/history.csv"));
        EXPECT_EQ(one.path.filename(), last(other).path.filename());
        EXPECT_TRUE(output::read_file(one.path) == output::read_file(last(other).path)) << other;
    }
}

TEST_F(Run, PoiseuilleProfileAtSecondOrder) {
    write("case.toml", poiseuille);
    double error[2];
    for (int level = 0; level < 2; ++level) {
        const int cells = 10 << level;
        const std::string n = std::to_string(cells), side = std::to_string(20.0 / cells);  // cubic cells
        const Outcome outcome =
            run("run case.toml --quiet -o out --set grid.cells='[2, " + n + ", 2]' --set grid.length='[\"" +
                side + " um\", \"10 um\", \"" + side + " um\"]'");
        ASSERT_EQ(outcome.code, 0) << outcome.text;
        const Profile p = profile("out");
        ASSERT_EQ(p.y.size(), static_cast<std::size_t>(cells));
        error[level] = 0;
        for (std::size_t j = 0; j < p.y.size(); ++j)
            error[level] = std::max(error[level], std::abs(p.u[j] / 5e4 - (1 - p.y[j] * p.y[j] / 25)));
    }
    EXPECT_LT(error[1], 0.006);
    EXPECT_NEAR(error[0] / error[1], 4, 0.2) << error[0] << " " << error[1];
    EXPECT_NEAR(summary("out").observables.at("largest_speed_um_per_s"), 5e4, 0.006 * 5e4);
    EXPECT_NEAR(summary("out").observables.at("time_s"), 2e-4, 1e-15);
}

TEST_F(Run, CouetteProfileIsStraight) {
    const std::string sides =
        "\"y-\" = { velocity = \"no-slip\" }\n"
        "\"y+\" = { velocity = [\"50 mm/s\", \"0 mm/s\", \"0 mm/s\"] }\n";
    write("case.toml", channel(sides, ""));
    // slowest decay at pi^2 nu/H^2 = 1/(10.1 us): e^-30 is left
    const Outcome outcome = run("run case.toml --quiet -o out --set time.duration='300 us'");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const Profile p = profile("out");
    for (std::size_t j = 0; j < p.y.size(); ++j) EXPECT_NEAR(p.u[j] / 5e4, (p.y[j] + 5) / 10, 1e-9) << p.y[j];
}

TEST_F(Run, CoupledFailureKeepsTheLastGoodState) {
    const Outcome outcome = run(small_run + "-o out --set numerics.step_strain=0.05 --set time.strain=2");
    EXPECT_EQ(outcome.code, 3);
    EXPECT_NE(outcome.text.find("error: fluid cell "), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find(" um, density "), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find("the last good state"), std::string::npos) << outcome.text;
    EXPECT_NE(content("out/log.txt").find("fluid cell "), std::string::npos);
    EXPECT_FALSE(fs::exists(folder_ / "out/summary.json"));
    const output::Checkpoint good = last("out").checkpoint;
    for (const auto& [name, values] : good.arrays())
        for (const double v : values)  // the history's residual is nan before the first step
            ASSERT_TRUE(name == "history" || std::isfinite(v)) << name;
    EXPECT_EQ(good.array("membrane.x").size(), good.array("membrane.y").size());
    EXPECT_LT(good.number("step"), 40);
    // it can be continued, and then fails in the same place
    EXPECT_EQ(run("run --quiet --restart out").text, outcome.text);
}

TEST_F(Run, FluidFailureKeepsTheLastGoodState) {
    write("case.toml", poiseuille);
    // forward Euler a little above the limit of ripples across the channel, the only ones that such a smooth start holds:
    // they grow slowly, over many rows of the history
    const Outcome outcome =
        run("run case.toml --quiet -o out --set time.scheme=euler --set time.step='400 ns'");
    EXPECT_EQ(outcome.code, 3) << outcome.text;
    EXPECT_NE(outcome.text.find("error: fluid cell "), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find("the last good state"), std::string::npos) << outcome.text;
    const output::Checkpoint good = last("out").checkpoint;
    const std::vector<double>& rows = good.array("history");
    EXPECT_LT(rows[rows.size() - 6], output::read_table(folder_ / "out/history.csv").column("step").back())
        << "no row was recorded between the good state and the failure";
    EXPECT_LE(rows[rows.size() - 6], good.number("step"));
    EXPECT_EQ(run("run --quiet --restart out").text, outcome.text);
}

}  // namespace
}  // namespace hemoflux::apps

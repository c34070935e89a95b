// The tasks of `hemoflux membrane`, from end to end through the built program.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/output/history.hpp"
#include "apps/output/summary.hpp"
#include "apps/tweezers.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/spheroid.hpp"
#include "meshing/surface_io.hpp"
#include "tests/apps/program.hpp"

namespace hemoflux::apps {
namespace {

class MembraneCommand : public Program {
  protected:
    void SetUp() override {
        Program::SetUp();
        const meshing::SurfaceMesh mesh = meshing::spheroid(meshing::icosphere(2, 1.0), 1.8, 1.5, 0.6);
        mesh_volume_ = meshing::volume(mesh);
        meshing::write_surface(folder_ / "own.ply", mesh);
    }
    /// Runs a task without pictures and expects it to end well, without a word.
    void task(const std::string& arguments) const {
        const Outcome outcome = run("membrane " + arguments + " --quiet --set output.pictures=false");
        EXPECT_EQ(outcome.code, 0) << arguments << "\n" << outcome.text;
        EXPECT_EQ(outcome.text, "") << arguments;
    }
    double mesh_volume_ = 0;  ///< of own.ply, um^3
    [[nodiscard]] output::Summary summary(const std::string& run_folder) const {
        return output::read_summary(folder_ / run_folder / "summary.json");
    }
    [[nodiscard]] output::Table table(const std::string& file) const {
        return output::read_table(folder_ / file);
    }
};

const std::string own = " --file own.ply --set cell.0.spontaneous_curvature=0 ";

TEST_F(MembraneCommand, EveryTaskTakesOnesOwnMesh) {
    task("relax" + own + "-o relax");
    // K_V holds the mesh's own volume as a penalty: it gives by the pressure of bending over K_V, some pascals of 1000.
    EXPECT_NEAR(summary("relax").observables.at("volume_um3"), mesh_volume_, 5e-3 * mesh_volume_);
    task("stretch" + own + "--forces '0 pN' '5 pN' -o stretch");
    EXPECT_GT(table("stretch/stretch.csv").column("axial_um")[1], 3.61);
    task("shapes" + own + "--curvatures 0 1 -o shapes");
    EXPECT_EQ(table("shapes/shapes.csv").rows.size(), 2u);
    task("moduli" + own + "-o moduli");
    task("relax-back" + own + "--forces '5 pN' -o back");
    EXPECT_GT(summary("back").observables.at("recovery_s"), 0);
    write("data.csv", "F_pN,DA_um,DT_um\n0,3.6,3\n2,3.7,2.95\n5,3.8,2.9\n");
    task("calibrate" + own + "--experiment data.csv --curvature-bounds -1 1 -o fit");
    EXPECT_GT(summary("fit").observables.at("shear_modulus_uN_per_m"), 1);
}

TEST_F(MembraneCommand, StretchOfSeveralCellsAgainstMeasurements) {
    write("data.csv", "F_pN,DA_um,DT_um,DA_lo,DA_hi,DT_lo,DT_hi\n0,7.8,7.8,7,9,7,9\n50,11,6,1,2,5,7\n");
    write("case.toml",
          "title = \"Two\"\nkind = \"membrane\"\n[[cell]]\nname = \"soft\"\nnodes = 162\nreference = "
          "\"stress-free\"\nshear_modulus = \"4 uN/m\"\n[[cell]]\nname = \"stiff\"\nnodes = 162\nreference = "
          "\"stress-free\"\nshear_modulus = \"8 uN/m\"\n[membrane]\ntask = \"stretch\"\nforces = [\"0 pN\", "
          "\"50 pN\"]\nexperiment = \"data.csv\"\n[output]\npictures = false\n[[reference]]\nobservable = "
          "\"soft.axial_um_at_50_pN\"\nlow = 9\nhigh = 14\nsource = \"test\"\n");
    const Outcome outcome = run("run case.toml --quiet -o two");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const output::Table t = table("two/stretch.csv");
    EXPECT_EQ(t.column("cell"), (std::vector<double>{0, 0, 1, 1}));
    EXPECT_GT(t.column("axial_um")[1], t.column("axial_um")[3] + 0.5);
    const output::Summary s = summary("two");
    EXPECT_EQ(s.observables.at("soft.axial_inside_bars"), 1);  // the bar at 50 pN ends below
    EXPECT_EQ(s.observables.at("soft.axial_points"), 2);
    EXPECT_EQ(s.observables.at("soft.axial_um_at_50_pN"), t.column("axial_um")[1]);
    EXPECT_FALSE(s.observables.contains("stiff.axial_um_at_50_pN"));
}

TEST_F(MembraneCommand, StaticAndDynamicStretchEndInTheSameShape) {
    const std::string cell = "stretch --nodes 162 --reference stress-free --forces '40 pN' --duration '3 s' ";
    task(cell + "-o static");
    task(cell + "--solver dynamic -o dynamic");
    for (const char* column : {"axial_um", "transverse_um"})
        EXPECT_NEAR(table("static/stretch.csv").column(column)[0],
                    table("dynamic/stretch.csv").column(column)[0], 0.01);
}

TEST_F(MembraneCommand, ContactDiameterIsAnotherWayToHoldTheCell) {
    const std::string cell = "stretch --nodes 642 --reference stress-free --forces '0 pN' '50 pN' ";
    task(cell + "--contact '2 um' -o wide");
    task(cell + "--contact '0.5 um' -o narrow");
    EXPECT_LT(table("wide/stretch.csv").column("axial_um")[1],
              table("narrow/stretch.csv").column("axial_um")[1]);
    expect_error("membrane stretch --nodes 42 --contact '20 um' --quiet -o x", 2, "both ends hold vertex");
    expect_error("membrane stretch --contact 0.7 -o x", 2, "out of range");
}

TEST_F(MembraneCommand, LawAndSchemeAreChosenByFlags) {
    for (const char* law : {"wlc-power", "wlc-hydrostatic", "neo-hookean", "skalak"})
        task(std::string("relax --nodes 162 --reference spheroid --law ") + law + " -o out");
    task("relax --nodes 162 --reference spheroid --bending gompper-kroll -o out");
    EXPECT_NE(content("out/resolved.toml").find("gompper-kroll"), std::string::npos);
    expect_error("membrane relax --law skalk -o x", 2, "\"skalak\" was meant");
    expect_error("membrane relax --bending none -o x", 2, "gompper-kroll");
}

TEST_F(MembraneCommand, ModuliAreThoseOfTheClosedForms) {
    task("moduli --shear-modulus '4 uN/m' -o moduli");
    const output::Table t = table("moduli/moduli.csv");
    ASSERT_EQ(t.rows.size(), 5u);
    for (std::size_t law = 0; law < 5; ++law) {
        EXPECT_NEAR(t.column("shear_uN_per_m")[law], 4, 4e-4);
        EXPECT_NEAR(t.column("young_uN_per_m")[law] / t.column("exact_young")[law], 1, 1e-3);
    }
}

TEST_F(MembraneCommand, ShapesAreNamedAndRefined) {
    task("shapes --nodes 642 --reference spheroid --curvatures 6 8 --area-differences 1 --refine -o shapes");
    const output::Table t = table("shapes/shapes.csv");
    EXPECT_EQ(t.column("c0"), (std::vector<double>{6, 8}));
    EXPECT_EQ(t.column("kind")[0], 1);
    EXPECT_EQ(t.column("nodes")[0], 2562);
    EXPECT_NEAR(t.column("energy_aJ")[0] / t.column("coarse_energy_aJ")[0], 1, 0.01);
}

TEST_F(MembraneCommand, CalibrationFindsTheCellThatMadeTheData) {
    const std::string cell = " --nodes 162 --reference stress-free --shear-modulus ";
    task("stretch" + cell +
         "'5 uN/m' --spontaneous-curvature 4 --forces '0 pN' '20 pN' '60 pN' '120 pN' -o made");
    const output::Table made = table("made/stretch.csv");
    std::string data = "F_pN,DA_um,DT_um\n";
    for (std::size_t i = 0; i < 4; ++i)
        data += std::to_string(made.column("force_pN")[i]) + "," +
                std::to_string(made.column("axial_um")[i]) + "," +
                std::to_string(made.column("transverse_um")[i]) + "\n";
    write("data.csv", data);
    task("calibrate" + cell + "'8 uN/m' --experiment data.csv -o fit");
    const output::Summary s = summary("fit");
    EXPECT_NEAR(s.observables.at("shear_modulus_uN_per_m"), 5, 0.05);
    EXPECT_NEAR(s.observables.at("spontaneous_curvature"), 4, 0.3);
    EXPECT_LT(s.observables.at("axial_rms_um"), 0.01);
}

TEST_F(MembraneCommand, RefusesWhatCannotBeDone) {
    expect_error("membrane calibrate -o x", 2, "nothing to fit to");
    expect_error("membrane calibrate --experiment none.csv -o x", 4, "none.csv");
    write("data.csv", "F_pN,DA_um,DT_um\n0,3.6,3\n");
    expect_error("membrane calibrate --experiment data.csv --curvature-bounds 5 1 -o x", 2, "range is empty");
    expect_error("membrane calibrate --nodes 42 --reference stress-free --experiment data.csv -o x", 2,
                 "a fit needs more");
    expect_error("membrane relax-back --recovery none.csv -o x", 4, "none.csv");
    write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expect_error("membrane relax --file open.obj -o y", 2, "open.obj");
    const Outcome far = run("membrane stretch --nodes 162 --forces '1e6 pN' --quiet -o far");
    EXPECT_EQ(far.code, 3) << far.text;
    EXPECT_NE(far.text.find("pulled with 1e+06 pN"), std::string::npos) << far.text;
    EXPECT_NE(far.text.find("contour length"), std::string::npos) << far.text;
}

TEST(Tweezers, DistanceFromMeasuredPoints) {
    const DiameterCurve curve{{0, 100}, {8, 10}};
    const Experiment::Diameter measured{{8, 9.5, 20}, {7, 9.2, 19}, {9, 9.8, 21}};
    const Distance d = distance(curve, {0, 50, 150}, measured);  // the last is not spanned
    EXPECT_EQ(d.points, 2);
    EXPECT_EQ(d.inside, 1);
    EXPECT_DOUBLE_EQ(d.rms_um, std::sqrt(0.25 / 2));
    EXPECT_TRUE(std::isnan(distance(curve, {150}, {{20}, {}, {}}).rms_um));
}

}  // namespace
}  // namespace hemoflux::apps

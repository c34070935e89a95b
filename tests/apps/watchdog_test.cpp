// What ends a run that has gone wrong: each cause alone, with its place, the last good state and exit code 3.
#include "apps/watchdog.hpp"

#include <gtest/gtest.h>

#include "apps/output/checkpoint.hpp"
#include "exchange/error.hpp"
#include "membrane/relax.hpp"
#include "meshing/icosphere.hpp"
#include "tests/apps/program.hpp"

namespace hemoflux::apps {
namespace {

class WatchdogTest : public Program {
  protected:
    /// The run stops with exit code 3 and a message with these parts, and its checkpoint holds finite numbers.
    void expect_stop(const std::string& arguments, const std::vector<std::string>& parts) const {
        const Outcome outcome = run(arguments + " -o out");
        EXPECT_EQ(outcome.code, 3) << outcome.text;
        const auto error = outcome.text.find("error: ");
        ASSERT_NE(error, std::string::npos) << outcome.text;
        for (const std::string& part : parts)
            EXPECT_NE(outcome.text.find(part, error), std::string::npos)
                << part << " is not in " << outcome.text;
        const output::Checkpoint good = output::latest_checkpoint(folder_ / "out").checkpoint;
        for (const auto& [name, values] : good.arrays())
            for (const double v : values) ASSERT_TRUE(name == "history" || std::isfinite(v)) << name;
    }
};

TEST_F(WatchdogTest, VolumeAndAreaOfACell) {
    expect_stop(small_run + "--set watchdog.volume_drift=1e-9",
                {"the volume of cell 0 has changed", "volume_modulus"});
    expect_stop(small_run + "--set watchdog.area_drift=1e-9",
                {"the area of cell 0 has changed", "area_modulus"});
}

TEST_F(WatchdogTest, DensityOfTheFluid) {
    expect_stop(small_run + "--set 'watchdog.density=[0.9999999, 1.0000001]' --set watchdog.interval=1",
                {"fluid cell ", "density 1", "watchdog.density", "numerics.mach"});
}

TEST_F(WatchdogTest, NodesThatLeaveTheBox) {
    // drifts with the upper half of the shear flow through the side x+
    expect_stop(small_run +
                    "--set coupling.recentre=false --set time.strain=10 --set "
                    "'cell.0.position=[\"1.8 um\", \"1 um\", \"0 um\"]'",
                {"membrane node ", "of cell 0", "left the box"});
}

TEST_F(WatchdogTest, SpringsAtTheirContourLength) {
    expect_stop(small_run + "--set tweezers.force='2 nN'", {"spring ", "between vertices", "contour length"});
}

TEST_F(WatchdogTest, SteadyRunsThatStallOrFail) {
    write("case.toml",
          "title = \"Gap\"\nkind = \"fluid\"\n[fluid]\nviscosity = \"1 mPa s\"\n[grid]\nlength = [\"4 um\", "
          "\"10 um\", \"1 "
          "um\"]\ncells = [4, 10, 1]\n[boundary]\nx = \"periodic\"\n\"y-\" = { velocity = \"no-slip\" "
          "}\n\"y+\" = { "
          "velocity = [\"0.5 m/s\", \"0 m/s\", \"0 m/s\"] }\nz = \"periodic\"\n[steady]\ncriterion = "
          "\"residual\"\n"
          "tolerance = 1e-14\nmethod = \"local-steps\"\n[output]\npictures = false\n");
    expect_stop("run case.toml -q --set steady.method=implicit --set watchdog.patience=2",
                {"the residual stalls", "fluid cell ", "steady.tolerance"});
    EXPECT_TRUE(fs::exists(folder_ / "out/summary.json"));
    expect_stop("run case.toml -q --set steady.sigma=20 --set numerics.tau_floor=0",
                {"fluid cell ", "left its range in iteration"});
}

TEST(Watchdog, TrianglesThatAreFoldedOver) {
    const meshing::SurfaceMesh sphere = meshing::icosphere(2, 3.0);
    const auto topology = std::make_shared<const membrane::Topology>(sphere);
    membrane::Batch cells(topology, {}, membrane::reference_from_shape(*topology, sphere.vertices));
    std::vector<Vec3d> positions = sphere.vertices;
    cells.set_positions(0, positions);
    cells.compute_forces();
    const WatchdogInput in;
    const Watchdog watchdog(in, {cells.sums(0).volume}, {cells.sums(0).area});
    EXPECT_NO_THROW(watchdog.check(cells));
    const meshing::Triangle t = sphere.triangles[7];
    // one corner over the opposite edge and beyond: the triangle lies on its back
    const auto at = [&](int v) { return positions[static_cast<std::size_t>(v)]; };
    positions[static_cast<std::size_t>(t[0])] = 1.2 * (at(t[1]) + at(t[2])) - 1.4 * at(t[0]);
    cells.set_positions(0, positions);
    ASSERT_LT(membrane::folded_triangle(*topology, positions), sphere.triangles.size());
    const std::string message = message_of<NumericalError>([&] { watchdog.check(cells); });
    EXPECT_NE(message.find("of cell 0 (vertices "), std::string::npos) << message;
    EXPECT_NE(message.find("is folded over"), std::string::npos) << message;
    WatchdogInput without;
    without.folds = false;
    EXPECT_NO_THROW(Watchdog(without, {cells.sums(0).volume}, {cells.sums(0).area}).check(cells));
}

}  // namespace
}  // namespace hemoflux::apps

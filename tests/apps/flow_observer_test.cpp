#include "apps/flow_observer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/output/history.hpp"
#include "exchange/error.hpp"
#include "fluid/solver.hpp"
#include "tests/apps/output/temporary_folder.hpp"

namespace hemoflux::apps {
namespace {

class FlowObserverTest : public output::TemporaryFolder {
  protected:
    /// A box of 2 x 2 um, its lid moving with 2 mm/s, and what is to be measured.
    [[nodiscard]] Case read(const std::string& observables) const {
        return parse_case(
            "title = \"box\"\nkind = \"fluid\"\n[fluid]\nviscosity = \"1 mPa s\"\n[grid]\n"
            "length = [\"2 um\", \"2 um\", \"0.1 um\"]\ncells = [64, 64, 1]\norigin = "
            "\"corner\"\n[boundary]\n"
            "z = \"periodic\"\nx = { velocity = \"no-slip\" }\n\"y-\" = { velocity = \"no-slip\" }\n"
            "\"y+\" = { velocity = [\"2 mm/s\", \"0 m/s\", \"0 m/s\"] }\n[time]\nduration = \"1 ms\"\n"
            "[output]\ninterval = \"1 ms\"\npictures = false\n" +
                observables,
            "case", folder_);
    }
    /// Lattice speed 1 is 20 mm/s, so the lid moves with 0.1.
    static Scales scales() { return {2e4, 0.4, 2e-5, 1000}; }
    static fluid::Solver solver(const Case& c) {
        fluid::SolverOptions options;
        options.nu = 0.05;
        fluid::Patches patches = make_patches(c, scales(), 0);
        patches[3] = fluid::wall_patch();  // the manufactured flows rest at the lid
        return {make_grid(c.grid), patches, options};
    }
    static FlowBox box() { return {{0, 0, 0}, {2, 2, 0.1}}; }

    output::Summary observe(const Case& c, fluid::Flow& flow) const {
        const output::OutputFolder out(folder_ / "run", output::Folder::fresh);
        output::write_table(out.resolved(), {{"case"}, {}});
        output::Summary summary;
        EXPECT_EQ(FlowObserver(c, scales(), box(), 1, flow).observe(summary, out), "");
        return summary;
    }
};

TEST_F(FlowObserverTest, CavityInUnitsOfItsLidAndWidth) {
    put("reference.csv", "# exact\nline,s,value\nu,0.25,0.44428829381583\nu,0.6,-99\nv,0.3,1\n");
    const Case c = read(
        "[observables]\ncavity = true\n[[profile]]\nfield = \"u\"\nalong = \"y\"\nfile = \"reference.csv\"\n"
        "columns = [\"s\", \"value\"]\nrows = [\"line\", \"u\"]\nskip = [0.6]\n");
    fluid::Solver flow = solver(c);
    // psi = -A sin^2(pi x/2) sin^2(pi y/2): one vortex; u = dpsi/dy, v = -dpsi/dx
    const double a = 0.05;
    flow.initialise([&](const Vec3d& r) {
        const double x = M_PI * r.x / 2, y = M_PI * r.y / 2;
        const double sx = std::sin(x) * std::sin(x), sy = std::sin(y) * std::sin(y);
        return fluid::FlowPoint{
            1, {-a * sx * (M_PI / 2 * std::sin(2 * y)), a * M_PI / 2 * std::sin(2 * x) * sy, 0}};
    });
    const output::Summary s = observe(c, flow);
    const auto& o = s.observables;
    const double peak = a * M_PI / 2 / 0.1;
    EXPECT_NEAR(o.at("u_min"), -peak, 1e-4 * peak);
    EXPECT_NEAR(o.at("u_min_y"), 0.25, 1e-3);
    EXPECT_NEAR(o.at("v_max"), peak, 1e-4 * peak);
    EXPECT_NEAR(o.at("v_max_x"), 0.25, 1e-3);
    EXPECT_NEAR(o.at("v_min"), -peak, 1e-4 * peak);
    EXPECT_NEAR(o.at("v_min_x"), 0.75, 1e-3);
    EXPECT_NEAR(o.at("psi_min"), -a / (0.1 * 2), 2e-3 * a / 0.2);
    EXPECT_NEAR(o.at("vortex_x"), 0.5, 1e-4);
    EXPECT_NEAR(o.at("vortex_y"), 0.5, 1e-4);
    const double u = -peak;  // at y = 0.25
    EXPECT_NEAR(o.at("u_profile_rms"), std::abs(u - 0.44428829381583), 1e-4);
    const auto profile = output::read_table(folder_ / "run" / "centreline_u.csv");
    EXPECT_DOUBLE_EQ(profile.rows.back()[0], 1);
    EXPECT_NEAR(profile.rows.back()[1], 0, 1e-12);
}

TEST_F(FlowObserverTest, ForcesAndWakeBehindASide) {
    const Case c = read(
        "[observables]\nspeed = \"2 mm/s\"\nlength = \"0.5 um\"\nbody = { patch = \"y-\", area = \"0.1 "
        "um^2\", "
        "lift = [0, 1, 0], centre = [\"0.25 um\", \"1 um\", \"0.05 um\"], front = [\"0.1 um\", \"1 um\", "
        "\"0.05 um\"] }\n");
    fluid::Solver flow = solver(c);
    // shear 0.05 y at the lower wall, and a stream that turns at x = 1.5
    flow.initialise([](const Vec3d& r) {
        return fluid::FlowPoint{1.003 + 0.01 * r.x, {0.05 * r.y * (r.x - 1.5), 0, 0}};
    });
    const auto o = observe(c, flow).observables;
    // mean of x - 1.5 over the wall is -0.5; friction nu 0.05 (-0.5) * 2 um * 0.1 um
    EXPECT_NEAR(o.at("drag_coefficient"), -0.05 * 0.05 * 0.5 * 0.2 / (0.5 * 0.01 * 0.1), 1e-10);
    EXPECT_NEAR(o.at("drag_coefficient_pressure"), 0, 1e-12);
    // mean excess of density 0.013 presses the wall down
    EXPECT_NEAR(o.at("lift_coefficient"), -0.013 / 3 * 0.2 / (0.5 * 0.01 * 0.1), 1e-10);
    EXPECT_NEAR(o.at("recirculation_length"), (1.5 - 0.5) / 0.5, 1e-9);
    EXPECT_NEAR(o.at("pressure_difference"), 0.01 / 3 * (0.1 - 0.5) / 0.01, 1e-10);
    EXPECT_NEAR(o.at("pressure_difference_pa"), 0.01 / 3 * (0.1 - 0.5) * 0.4, 1e-12);
    EXPECT_EQ(output::read_table(folder_ / "run" / "wall.csv").rows.size(), 64u);
}

TEST_F(FlowObserverTest, RefusesWhatCannotBeMeasured) {
    put("reference.csv", "s,value\n0.5,1\n");
    const auto refused = [&](const std::string& observables) {
        const Case c = read(observables);
        fluid::Solver flow = solver(c);
        try {
            const FlowObserver observer(c, scales(), box(), 1, flow);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const std::string profile = "[[profile]]\nfield = \"u\"\nalong = \"y\"\nfile = \"reference.csv\"\n";
    EXPECT_EQ(refused("[observables]\n" + profile + "columns = [\"s\", \"value\"]\n"), "");
    EXPECT_NE(refused("[observables]\n" + profile + "columns = [\"s\", \"u\"]\n").find("no column"),
              std::string::npos);
    EXPECT_NE(refused("[observables]\n" + profile + "columns = [\"s\", \"value\"]\n" + profile +
                      "columns = [\"s\", \"value\"]\n")
                  .find("two profiles"),
              std::string::npos);
    EXPECT_NE(refused("[observables]\nbody = { patch = \"y-\" }\n").find("length"), std::string::npos);
    EXPECT_NE(
        refused("[observables]\nlength = \"1 um\"\nbody = { patch = \"ball\" }\n").find("has the patches"),
        std::string::npos);
    EXPECT_THROW(read(profile + "columns = [\"s\", \"value\"]\n"), InputError);
}

}  // namespace
}  // namespace hemoflux::apps

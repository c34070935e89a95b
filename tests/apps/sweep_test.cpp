#include "apps/sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/output/checkpoint.hpp"
#include "apps/output/history.hpp"
#include "apps/output/summary.hpp"
#include "apps/sweep_report.hpp"
#include "exchange/error.hpp"
#include "tests/apps/example_case.hpp"
#include "tests/apps/program.hpp"

namespace hemoflux::apps {
namespace {

TEST(Sweep, ListsGoTogetherOrAsProduct) {
    SweepInput sweep{.keys = {"a", "b"},
                     .values = {{"1", "2"}, {"3", "4"}},
                     .observables = {},
                     .order = {},
                     .extrapolate = {},
                     .order_range = {},
                     .measured = {}};
    EXPECT_EQ(sweep_points(sweep), (std::vector<SweepPoint>{{"1", "3"}, {"2", "4"}}));
    sweep.product = true;
    EXPECT_EQ(sweep_points(sweep), (std::vector<SweepPoint>{{"1", "3"}, {"2", "3"}, {"1", "4"}, {"2", "4"}}));
}

TEST(Sweep, AbscissaOfNumbersQuantitiesListsAndWords) {
    EXPECT_EQ(abscissa("0.25", "1"), 0.25);
    EXPECT_NEAR(abscissa("\"2 ms\"", "\"500 us\""), 2000, 1e-9);
    EXPECT_EQ(abscissa("[5, 40, 1]", "[5, 10, 1]"), 40);
    EXPECT_TRUE(std::isnan(abscissa("\"green-gauss\"", "\"green-gauss\"")));
}

TEST(Sweep, OrderIsTheSlopeOfTheLogarithms) {
    EXPECT_NEAR(fitted_order({1, 2, 4, 8}, {3, 12, 48, NAN}), 2, 1e-12);
    EXPECT_TRUE(std::isnan(fitted_order({1, 2}, {0, 3})));
    SweepResults r;
    r.sweep = {.keys = {"grid.cells", "numerics.gradient"},
               .values = {{"[10, 10, 1]", "[20, 20, 1]"}, {"\"a\"", "\"b\""}},
               .product = true,
               .observables = {},
               .order = {"error"},
               .extrapolate = {},
               .order_range = {},
               .measured = {}};
    r.points = sweep_points(r.sweep);
    r.rows = {{{"error", 0.4}}, {{"error", 0.1}}, {{"error", 0.8}}, {{"error", 0.1}}};
    const auto orders = sweep_orders(r);
    EXPECT_NEAR(orders.at("order_error numerics.gradient=a"), 2, 1e-12);
    EXPECT_NEAR(orders.at("order_error numerics.gradient=b"), 3, 1e-12);
}

class SweepRun : public Program {
  protected:
    const std::string vortex = R"(title = "Vortex"
kind = "fluid"
[fluid]
viscosity = "1 mPa s"
initial = "analytical"
[grid]
length = ["10 um", "10 um", "1 um"]
cells = [16, 16, 1]
origin = "corner"
[boundary]
x = "periodic"
y = "periodic"
z = "periodic"
[analytical]
solution = "taylor-green"
speed = "1 m/s"
times = [1]
[time]
scheme = "rk4"
step = "5 ns"
[numerics]
mach = 0.02
tau_floor = 0
[output]
pictures = false
[sweep]
order = ["error_relative"]
[sweep.values]
"grid.cells" = [[16, 16, 1], [32, 32, 1]]
"grid.length" = [["10 um", "10 um", "1 um"], ["10 um", "10 um", "1 um"]]
[[reference]]
observable = "order_error_relative"
low = 1.8
source = "second-order scheme"
)";
};

TEST_F(SweepRun, LeavesTableSummaryAndOrders) {
    write("case.toml", vortex);
    const Outcome outcome = run("sweep case.toml -o out");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("inside"), std::string::npos) << outcome.text;
    const output::Summary all = output::read_summary(folder_ / "out/summary.json");
    const output::Summary one = output::read_summary(folder_ / "out/run_01/summary.json");
    const output::Summary coarse = output::read_summary(folder_ / "out/run_00/summary.json");
    EXPECT_NEAR(all.observables.at("order_error_relative"),
                std::log2(coarse.observables.at("error_relative") / one.observables.at("error_relative")),
                1e-9);
    EXPECT_TRUE(one.references.empty());
    const std::string table = content("out/sweep.csv");
    EXPECT_TRUE(table.starts_with("grid.cells,grid.length,cpu_s,error_density,error_largest,error_relative,"))
        << table;
    EXPECT_NE(table.find("\n\"[32, 32, 1]\",\"[\"\"10 um\"\", \"\"10 um\"\", \"\"1 um\"\"]\","),
              std::string::npos)
        << table;
    EXPECT_TRUE(fs::exists(folder_ / "out/run_01/profile_u_along_y.csv"));

    // finished runs are taken over, and only those of the same case
    const auto before = fs::last_write_time(folder_ / "out/run_01/summary.json");
    ASSERT_EQ(run("sweep case.toml -o out").code, 0);
    EXPECT_EQ(fs::last_write_time(folder_ / "out/run_01/summary.json"), before);
    ASSERT_EQ(run("sweep case.toml -q -o out --set numerics.mach=0.06").code, 0);
    EXPECT_NE(fs::last_write_time(folder_ / "out/run_01/summary.json"), before);
}

TEST_F(SweepRun, IsRefusedBeforeAnythingIsWritten) {
    write("case.toml", vortex);
    for (const char* set : {"'sweep.values={ }'", "'sweep.values={ \"grid.cells\" = [] }'",
                            "'sweep.values={ \"grid.cells\" = [[8, 8, 1], [8, 8]] }'",
                            "'sweep.values={ \"numerics.mach\" = [0.1, 0.2], \"numerics.gamma\" = [1] }'",
                            "'sweep.values={ \"numerics.mahc\" = [0.1] }'"}) {
        const Outcome outcome = run(std::string("sweep case.toml -o out --set ") + set);
        EXPECT_EQ(outcome.code, 2) << set << outcome.text;
        EXPECT_FALSE(fs::exists(folder_ / "out")) << set;
    }
    write("plain.toml", vortex.substr(0, vortex.find("[sweep]")));
    EXPECT_EQ(run("sweep plain.toml -o out").code, 2);
    // a plain run leaves the sweep aside
    EXPECT_EQ(run("run case.toml -q -o out").code, 0);
    EXPECT_EQ(content("out/resolved.toml").find("sweep"), std::string::npos);
}

/// Restarted in the middle, with the errors of the times before.
TEST_F(SweepRun, ErrorsSurviveARestart) {
    const std::string case_text = vortex.substr(0, vortex.find("[sweep]"));
    write("case.toml", case_text);
    const std::string times = " --set 'analytical.times=[0, 0.5, 1]' --set 'output.interval=100 ns' ";
    ASSERT_EQ(run("run case.toml -q -o whole" + times).code, 0);
    ASSERT_EQ(run("run case.toml -q -o cut" + times).code, 0);
    const auto newest = output::latest_checkpoint(folder_ / "cut").path;
    fs::remove(newest);
    const Outcome outcome = run("run -q --restart cut");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(content("cut/errors.csv"), content("whole/errors.csv"));
    EXPECT_EQ(content("cut/profile_u_along_y.csv"), content("whole/profile_u_along_y.csv"));
    EXPECT_EQ(content("cut/history.csv"), content("whole/history.csv"));
}

/// Words, vectors and expressions that mean the same inflow and pressure give the same flow.
TEST_F(SweepRun, ExpressionsAreConditionsLikeOthers) {
    const auto channel = [](const std::string& inflow, const std::string& outlet) {
        return "title = \"Channel\"\nkind = \"fluid\"\n[fluid]\nviscosity = \"1 mPa s\"\n[grid]\n"
               "length = [\"4 um\", \"10 um\", \"1 um\"]\ncells = [4, 10, 1]\n[boundary]\n\"x-\" = { " +
               inflow + " }\n\"x+\" = { velocity = \"zero-gradient\", " + outlet +
               " }\ny = { velocity = \"no-slip\" }\nz = \"periodic\"\n[time]\nscheme = \"rk4\"\n"
               "duration = \"20 us\"\n[output]\npictures = false\n";
    };
    write("words.toml", channel("velocity = \"parabolic\", speed = \"50 mm/s\"", "density = \"20 Pa\""));
    write("formulas.toml",
          channel(
              "velocity = \"expression\", velocity_expression = [\"0.05*(1 - (y/5e-6)^2)\", \"0\", \"0*t\"]",
              "density = \"expression\", pressure_expression = \"20 + 0*t\""));
    for (const std::string name : {"words", "formulas"}) {
        const Outcome outcome = run("run " + name + ".toml -q -o " + name);
        ASSERT_EQ(outcome.code, 0) << outcome.text;
    }
    const auto words = output::read_table(folder_ / "words/history.csv");
    const auto formulas = output::read_table(folder_ / "formulas/history.csv");
    ASSERT_EQ(words.rows.size(), formulas.rows.size());
    for (std::size_t i = 0; i < words.rows.size(); ++i)
        EXPECT_NEAR(words.rows[i][2], formulas.rows[i][2], 1e-6) << "um/s in row " << i;
    EXPECT_NEAR(words.column("largest_speed_um_per_s").back(), 5e4, 4e3);
}

TEST_F(SweepRun, BadConditionsAreRefused) {
    const std::string box = vortex.substr(0, vortex.find("[boundary]"));
    const std::string rest = "x = \"periodic\"\nz = \"periodic\"\n[time]\nduration = \"1 us\"\n";
    const auto expect_bad = [&](const std::string& side, const std::string& word) {
        write("case.toml", box + "[boundary]\ny = { " + side + " }\n" + rest);
        const Outcome outcome = run("run case.toml -o out --set fluid.initial=rest");
        EXPECT_EQ(outcome.code, 2) << outcome.text;
        EXPECT_NE(outcome.text.find(word), std::string::npos) << outcome.text;
    };
    expect_bad("velocity = \"parabolic\"", "speed");
    expect_bad("velocity = \"no-slip\", speed = \"1 m/s\"", "no effect");
    expect_bad("velocity = \"expression\"", "velocity_expression");
    expect_bad("velocity = \"expression\", velocity_expression = [\"1\", \"q\", \"0\"]", "\"q\"");
    expect_bad("velocity = \"no-slip\", density = \"gradient\"", "pressure_gradient");
    for (const char* set :
         {"numerics.reynolds=2", "numerics.lattice_viscosity=0.5", "numerics.gradient=hybrid",
          "analytical.speed=0", "'analytical.times=[1, 0.5]'", "analytical.solution=couette"}) {
        write("case.toml", vortex);
        EXPECT_EQ(run(std::string("run case.toml -o out --set ") + set).code, 2) << set;
    }
}

}  // namespace
}  // namespace hemoflux::apps

// What the page of a report is made of: numbers, names, axes, curves.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "apps/report/chart_svg.hpp"
#include "apps/report/description.hpp"
#include "apps/report/html.hpp"
#include "apps/report/quantity_name.hpp"
#include "apps/report/ticks.hpp"
#include "apps/toml_input.hpp"
#include "tests/apps/report_folder.hpp"

namespace hemoflux::report {
namespace {

TEST(ReportPieces, NumbersAreReadable) {
    EXPECT_EQ(number(17.7448725), "17.745");
    EXPECT_EQ(number(-0.5),
              "\xE2\x88\x92"
              "0.5");
    EXPECT_EQ(number(4087), "4087");
    EXPECT_EQ(number(1234567), "1234567");
    EXPECT_EQ(number(0), "0");
    EXPECT_EQ(number(NAN), "\xE2\x80\x93");
    EXPECT_EQ(number(1.69e-12),
              "1.69&nbsp;\xC3\x97&nbsp;10<sup>\xE2\x88\x92"
              "12</sup>");
    EXPECT_EQ(percentage(-0.0985),
              "\xE2\x88\x92"
              "9.85&nbsp;%");
    EXPECT_EQ(base64("hemoflux!"), "aGVtb2ZsdXgh");
    EXPECT_EQ(base64("h"), "aA==");
    EXPECT_EQ(base64(""), "");
}

TEST(ReportPieces, NamesCarryTheirUnits) {
    const auto expect = [](const char* key, const char* text, const char* unit) {
        EXPECT_EQ(quantity_name(key).text, text) << key;
        EXPECT_EQ(quantity_name(key).unit, unit) << key;
    };
    expect("inclination_deg", "Inclination", "degrees");
    expect("tank_treading_cycles_per_strain", "Tank treading", "cycles per strain unit");
    expect("period_strain", "Period", "strain units");
    expect("strain", "Strain", "");
    expect("rbc.volume_um3", "rbc: Volume", "\xC2\xB5m\xC2\xB3");
    expect("u_profile_rms", "u profile rms", "");
    expect("order_error_relative", "Order of relative error", "");
    expect("largest_speed_um_per_s", "Largest speed", "\xC2\xB5m/s");
}

TEST(ReportPieces, TicksAreRoundAndInside) {
    for (const auto& [low, high] :
         {std::pair{0.0, 6.0}, {-3.1, 17.9}, {-2e-5, 3e-4}, {1.2e5, 9e6}, {5.0, 5.0}, {0.0, 0.0}}) {
        const AxisTicks axis = make_ticks(low, high, false, 5);
        ASSERT_GE(axis.at.size(), 2U) << low << " to " << high;
        ASSERT_LE(axis.at.size(), 9U);
        for (const double t : axis.at) {
            EXPECT_GE(axis.place(t), -1e-9);
            EXPECT_LE(axis.place(t), 1 + 1e-9);
        }
        EXPECT_EQ(std::set<std::string>(axis.labels.begin(), axis.labels.end()).size(), axis.labels.size());
    }
    EXPECT_EQ(make_ticks(0, 6, false, 5).labels, (std::vector<std::string>{"0", "2", "4", "6"}));
    EXPECT_EQ(make_ticks(0, 2.2e-4, false, 4).factor, "10\xE2\x81\xBB\xE2\x81\xB4");
    EXPECT_EQ(make_ticks(1e-3, 1e3, true, 6).labels.size(), 7U);
    EXPECT_NEAR(make_ticks(1, 100, true, 5).place(10), 0.5, 1e-12);
}

TEST_F(ReportFolder, CellsOfASweepsTableMayHoldCommasAndQuotes) {
    put("sweep.csv", "grid.length,drag\n\"[\"\"1 um\"\", \"\"2 um\"\"]\",3\n");
    const SweepTable table =
        read_sweep_table(folder_ / "sweep.csv", apps::parse_toml("[grid]\nlength = 1\n", "case"));
    EXPECT_EQ(table.keys, 1U);
    EXPECT_EQ(table.rows, (std::vector<std::vector<std::string>>{{"[\"1 um\", \"2 um\"]", "3"}}));
}

TEST(ReportPieces, MeshesAreNamed) {
    const auto described = [](const char* mesh) {
        RunRecord run;
        run.kind = "steady";
        run.input = apps::parse_toml(std::string("[grid.mesh]\n") + mesh, "case");
        return description(run);
    };
    EXPECT_TRUE(has(described("kind = \"file\"\nfile = \"meshes/duct.msh\""), "on the mesh duct.msh"));
    EXPECT_TRUE(has(described("kind = \"cylinder\""), "on an unstructured mesh around a cylinder"));
    EXPECT_TRUE(has(described("kind = \"constriction\""), "on an unstructured mesh of a narrowed pipe"));
}

TEST(ReportPieces, LongCurvesAreThinnedWithTheirPeaks) {
    Chart chart{.key = "k", .plot = {.title = "t", .x_label = "x", .y_label = "y", .curves = {}}};
    output::Curve& c = chart.plot.curves.emplace_back();
    for (int i = 0; i < 100000; ++i) {
        c.x.push_back(i);
        c.y.push_back(i == 77777 ? 5 : std::sin(1e-3 * i));
    }
    chart.plot.y_low = -5;
    chart.plot.y_high = 5;
    const std::string svg = chart_svg(chart);
    EXPECT_LT(svg.size(), 20000U);
    EXPECT_TRUE(has(svg, " 26.0L")) << "the peak at the upper end of the axis is gone";
}

}  // namespace
}  // namespace hemoflux::report

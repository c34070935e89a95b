#include "apps/output/plot.hpp"

#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <cstdlib>

#include "apps/output/child.hpp"
#include "temporary_folder.hpp"

namespace hemoflux::output {
namespace {

class PlotTest : public TemporaryFolder {
  protected:
    static PlotSpec example() {
        PlotSpec spec{"Inclination, it's a test_case", "strain", "inclination, degrees", {}};
        Curve run{"this run", {}, {}};
        for (int i = 0; i <= 50; ++i) {
            run.x.push_back(0.5 * i);
            run.y.push_back(i == 20 ? NAN : 20 + 25 * std::exp(-0.2 * i) * std::cos(0.5 * i));
        }
        spec.curves = {run, {"measured", {5, 15}, {20.5, 19.0}, true, {1, 1.5}}};
        spec.bands = {{"accepted, prototype of this method", 18.5, 21.5}, {"theory", 20, 20}};
        return spec;
    }
};

TEST_F(PlotTest, DrawsSvgAndPng) {
    if (!find_program("gnuplot")) GTEST_SKIP() << "gnuplot is missing";
    const auto message = plot(example(), folder_ / "plot_inclination");
    EXPECT_FALSE(message.has_value()) << *message;
    boost::property_tree::ptree tree;
    boost::property_tree::read_xml((folder_ / "plot_inclination.svg").string(), tree);
    EXPECT_TRUE(tree.count("svg"));
    const std::string svg = content("plot_inclination.svg");
    for (const char* text : {"Inclination, it's a test_case", "strain", "this run", "measured", "theory"})
        EXPECT_NE(svg.find(text), std::string::npos) << text;
    EXPECT_TRUE(content("plot_inclination.png").starts_with("\x89PNG"));
}

TEST_F(PlotTest, RangeHoldsBandsThatLieOutsideTheData) {
    PlotSpec spec{"t", "x", "y", {{"c", {0, 1}, {0, 1}}}};
    spec.bands = {{"far", 9, 10}};
    EXPECT_NE(gnuplot_script(spec, "svg", "a.svg").find("set yrange [-0.8:10.8]"), std::string::npos)
        << gnuplot_script(spec, "svg", "a.svg");
    spec.y_low = 0;
    EXPECT_NE(gnuplot_script(spec, "svg", "a.svg").find("set yrange [0:10.8]"), std::string::npos);
}

TEST_F(PlotTest, SaysWhyThereIsNoPlot) {
    PlotSpec empty{"t", "x", "y", {{"c", {NAN}, {1}}}};
    EXPECT_NE(plot(empty, folder_ / "p").value_or("").find("no data"), std::string::npos);
    PlotSpec uneven{"t", "x", "y", {{"c", {1, 2}, {1}}}};
    EXPECT_NE(plot(uneven, folder_ / "p").value_or("").find("differ in size"), std::string::npos);
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", folder_.c_str(), 1);
    EXPECT_NE(plot(example(), folder_ / "p").value_or("").find("gnuplot-nox"), std::string::npos);
    ::setenv("PATH", path.c_str(), 1);
    if (find_program("gnuplot")) {
        EXPECT_NE(plot(example(), folder_ / "none" / "p").value_or("").find("gnuplot: it exited"),
                  std::string::npos);
    }
}

}  // namespace
}  // namespace hemoflux::output

#include "apps/output/plane_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/output/plane_plot.hpp"
#include "tests/apps/output/temporary_folder.hpp"

namespace hemoflux::output {
namespace {

template <class F>
std::vector<double> field(const Lattice& lattice, const F& f) {
    std::vector<double> values;
    for (const double y : lattice.y)
        for (const double x : lattice.x) values.push_back(f(x, y));
    return values;
}

TEST(PlaneField, LatticeIsAsFineBothWays) {
    const Lattice l = make_lattice(-1, 3, 0, 1, 41);
    ASSERT_EQ(l.x.size(), 41u);
    ASSERT_EQ(l.y.size(), 11u);
    EXPECT_DOUBLE_EQ(l.x[10], 0);
    EXPECT_DOUBLE_EQ(l.y.back(), 1);
}

TEST(PlaneField, ContourOfACircle) {
    const Lattice l = make_lattice(-1.5, 1.5, -1.5, 1.5, 101);
    const auto lines = contour(l, field(l, [](double x, double y) { return x * x + y * y; }), 1);
    double length = 0;
    for (const Polyline& piece : lines) {
        ASSERT_EQ(piece.size(), 2u);
        for (const auto& [x, y] : piece) EXPECT_NEAR(std::hypot(x, y), 1, 5e-4);
        length += std::hypot(piece[0][0] - piece[1][0], piece[0][1] - piece[1][1]);
    }
    EXPECT_NEAR(length, 2 * M_PI, 5e-3);
}

TEST(PlaneField, ContourKeepsOutOfHoles) {
    const Lattice l = make_lattice(0, 1, 0, 1, 21);
    const auto lines = contour(l, field(l, [](double x, double y) { return x < 0.5 ? NAN : y; }), 0.52);
    ASSERT_FALSE(lines.empty());
    for (const Polyline& piece : lines)
        for (const auto& [x, y] : piece) {
            EXPECT_GE(x, 0.5 - 1e-12);
            EXPECT_NEAR(y, 0.52, 1e-12);
        }
}

TEST(PlaneField, StreamlinesOfARotationAreClosedCircles) {
    const Lattice l = make_lattice(-1, 1, -1, 1, 201);
    const auto lines = streamlines(l, field(l, [](double, double y) { return -y; }),
                                   field(l, [](double x, double) { return x; }), 0.1);
    std::size_t circles = 0;
    for (const Polyline& line : lines) {
        const double r = std::hypot(line[0][0], line[0][1]);
        if (r < 0.05) continue;  // a few lattice cells across
        for (const auto& [x, y] : line) EXPECT_NEAR(std::hypot(x, y), r, 2e-4);
        if (r < 0.9 && line.front() == line.back()) ++circles;
    }
    EXPECT_GE(circles, 6u);  // radii 0.1 apart
    EXPECT_LE(lines.size(), 60u);
}

// A vortex whose fluid slowly gathers in its middle: no line winds up beside itself.
TEST(PlaneField, StreamlinesDoNotWindUp) {
    const Lattice l = make_lattice(-1, 1, -1, 1, 101);
    const auto lines = streamlines(l, field(l, [](double x, double y) { return -y - 0.003 * x; }),
                                   field(l, [](double x, double y) { return x - 0.003 * y; }), 0.1);
    ASSERT_FALSE(lines.empty());
    for (const Polyline& line : lines) {
        double length = 0;
        for (std::size_t i = 1; i < line.size(); ++i)
            length += std::hypot(line[i][0] - line[i - 1][0], line[i][1] - line[i - 1][1]);
        EXPECT_LT(length, 2.2 * 3.14159265 * std::hypot(line[0][0], line[0][1]) + 0.7);
    }
}

TEST(PlaneField, StreamlinesAreFoundWhereTheFlowIsSlowAndNotWhereThereIsNone) {
    const Lattice l = make_lattice(0, 1, 0, 1, 101);
    const auto u = field(l, [](double x, double y) { return y < 0.3 ? 1e-9 : x > 0.7 ? NAN : 1.0; });
    const auto lines = streamlines(l, u, field(l, [](double, double) { return 0.0; }), 0.1);
    bool slow = false;
    for (const Polyline& line : lines)
        for (const auto& [x, y] : line) {
            slow = slow || y < 0.25;
            EXPECT_TRUE(y < 0.31 || x <= 0.71);
        }
    EXPECT_TRUE(slow);
}

class PlanePlotTest : public TemporaryFolder {};

TEST_F(PlanePlotTest, DrawsColoursLinesAndABody) {
    PlanePlot p{"A rotation's speed", "x / L", "y / L", "speed / U", make_lattice(-1, 1, -1, 1, 31)};
    p.colour = field(p.lattice, [](double x, double y) { return std::hypot(x, y); });
    p.lines = {{"one", "#ffffff", 1, contour(p.lattice, p.colour, 0.5)}};
    p.body = {{-0.1, -0.1}, {0.1, -0.1}, {0, 0.1}};
    const auto message = plot_plane(p, folder_ / "picture_plane.png");
    if (message && message->find("gnuplot is missing") != std::string::npos) GTEST_SKIP() << *message;
    EXPECT_FALSE(message) << *message;
    EXPECT_EQ(content("picture_plane.png").substr(1, 3), "PNG");
    EXPECT_TRUE(plot_plane({"empty", "", "", "", make_lattice(0, 1, 0, 1, 3)}, folder_ / "none.png"));
}

}  // namespace
}  // namespace hemoflux::output

#include "meshing/rectilinear.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "exchange/error.hpp"

namespace hemoflux::meshing {
namespace {

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// Widths of (5.31) without any of the code under test.
std::vector<double> plateau_widths(double length, int n, double a, double b) {
    std::vector<double> f;
    for (int i = 1; i <= n; ++i) {
        const double x = i - n / 2.0 - 0.5;
        f.push_back(1 + std::exp(-2 * a * b) + std::exp(b * (x - a)) + std::exp(b * (-x - a)));
    }
    const double total = sum(f);
    for (double& value : f) value *= length / total;
    return f;
}

template <class F>
std::string message_of(F call) {
    try {
        call();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no InputError";
}

TEST(Uniform, EqualWidthsAndExactEnds) {
    const Axis axis = uniform_axis(-6, 6, 30);
    EXPECT_EQ(axis.cells(), 30U);
    EXPECT_EQ(axis.lower(), -6);
    EXPECT_EQ(axis.upper(), 6);
    EXPECT_TRUE(axis.uniform());
    EXPECT_NEAR(axis.smallest(), 0.4, 1e-14);
    EXPECT_NEAR(axis.growth(), 1, 1e-13);
    EXPECT_NEAR(axis.centres()[0], -5.8, 1e-14);
    EXPECT_TRUE(uniform_axis(1e6, 1e6 + 1, 7).uniform());
    EXPECT_EQ(uniform_axis(0, 1, 1).cells(), 1U);
}

TEST(Plateau, SmallestCellsOfTheThesisCases) {
    EXPECT_NEAR(plateau_axis(-12, 12, 40, 12, 0.2).smallest(), 0.318, 5e-4);   // optical tweezers
    EXPECT_NEAR(plateau_axis(-12, 12, 20, 8, 0.2).smallest(), 0.980, 5e-4);    // wheel
    EXPECT_NEAR(plateau_axis(-6, 6, 30, 10, 0.2).smallest(), 0.269, 5e-4);     // tank treading
    EXPECT_NEAR(plateau_axis(-32, 32, 100, 32, 0.2).smallest(), 0.138, 5e-4);  // settling sphere
    EXPECT_NEAR(plateau_axis(-32, 32, 100, 34.5, 0.2).smallest(), 0.2, 5e-3);
}

TEST(Plateau, WidthsFollowTheFormula) {
    const Axis axis = plateau_axis(1, 13, 31, 10, 0.2);
    const std::vector<double> expected = plateau_widths(12, 31, 10, 0.2), dx = axis.widths();
    for (std::size_t i = 0; i < dx.size(); ++i) {
        EXPECT_NEAR(dx[i], expected[i], 1e-14);
        EXPECT_NEAR(dx[i], dx[dx.size() - 1 - i], 1e-13);
    }
    EXPECT_FALSE(axis.uniform());
    EXPECT_TRUE(plateau_axis(0, 12, 30, 10, 0).uniform());
}

TEST(Chebyshev, FacesFollowTheFormula) {
    const int n = 40;
    const Axis axis = chebyshev_axis(0, 1, n);
    ASSERT_EQ(axis.faces.size(), 41U);
    for (int i = 0; i <= n; ++i) {
        // (1 - cos t) / 2 = sin^2(t / 2)
        const double s = std::sin(0.5 * std::numbers::pi * i / n);
        EXPECT_NEAR(axis.faces[static_cast<std::size_t>(i)], s * s, 1e-15);
    }
    EXPECT_NEAR(chebyshev_axis(-3, 5, 7).centres()[3], 1, 1e-14);
}

TEST(Axes, WidthsAddUpToTheLength) {
    for (const Axis& axis :
         {uniform_axis(-1, 23, 997), plateau_axis(-12, 12, 40, 12, 0.2), plateau_axis(-32, 32, 500, 200, 0.1),
          chebyshev_axis(0.3, 7.1, 123), explicit_axis({0, 0.1, 0.3, 7})}) {
        EXPECT_NEAR(sum(axis.widths()), axis.length(), 1e-12);
        EXPECT_GT(axis.smallest(), 0);
    }
}

TEST(Grid, CellsVolumeAndQuality) {
    const RectilinearGrid grid{
        {explicit_axis({0, 1, 3}), uniform_axis(0, 8, 2), explicit_axis({0, 0.5, 1.5, 2})}};
    EXPECT_EQ(grid.cells(), 12U);
    EXPECT_EQ(grid.smallest(), 0.5);
    EXPECT_NEAR(grid.volume(), 48, 1e-12);
    const GridQuality q = quality(grid);
    EXPECT_EQ(q.smallest, 0.5);
    EXPECT_EQ(q.largest, 4);
    EXPECT_EQ(q.growth, 2);
    EXPECT_EQ(q.aspect, 8);  // 4 along y over 0.5 along z
    const RectilinearGrid cubes{{uniform_axis(0, 1, 4), uniform_axis(0, 2, 8), uniform_axis(0, 3, 12)}};
    EXPECT_NEAR(quality(cubes).aspect, 1, 1e-13);
}

TEST(BadAxes, AreRefusedWithTheReason) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(message_of([] { uniform_axis(0, 1, 0); }).find("0 cells"), std::string::npos);
    EXPECT_NE(message_of([] { uniform_axis(2, 2, 4); }).find("from 2 to 2 um"), std::string::npos);
    EXPECT_NE(message_of([&] { uniform_axis(nan, 2, 4); }).find("finite"), std::string::npos);
    EXPECT_NE(message_of([] { chebyshev_axis(0, 1, -3); }).find("-3 cells"), std::string::npos);
    EXPECT_NE(message_of([] { chebyshev_axis(1, 0, 3); }).find("from 1 to 0 um"), std::string::npos);
    EXPECT_NE(message_of([] { plateau_axis(0, 1, 10, 3, -0.2); }).find("b = -0.2"), std::string::npos);
    EXPECT_NE(message_of([&] { plateau_axis(0, 1, 10, nan, 0.2); }).find("a = nan"), std::string::npos);
    EXPECT_NE(message_of([] { plateau_axis(0, 1, 4000, 3, 1); }).find("overflow"), std::string::npos);
    // the middle cells are narrower than the rounding of their coordinates
    EXPECT_NE(message_of([] { plateau_axis(0, 1, 200, 10, 1); }).find("ascend"), std::string::npos);
    EXPECT_NE(message_of([] { explicit_axis({0}); }).find("1 faces"), std::string::npos);
    EXPECT_NE(message_of([] {
                  explicit_axis({0, 1, 1});
              }).find("face 2 at 1 um after 1 um"),
              std::string::npos);
    EXPECT_NE(message_of([&] { explicit_axis({0, nan, 1}); }).find("face 1 at nan"), std::string::npos);
}

}  // namespace
}  // namespace hemoflux::meshing

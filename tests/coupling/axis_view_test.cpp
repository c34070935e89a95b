#include "coupling/axis_view.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "exchange/error.hpp"
#include "grids.hpp"

using namespace hemoflux;
using namespace hemoflux::coupling;

// Look-up against a linear search, at centres, faces, between and at the ends. Host memory: skipped on a GPU
// build.
TEST(AxisView, LookUpAgreesWithLinearSearch) {
    if (exchange::on_gpu) GTEST_SKIP();
    auto axes = test::axes();
    axes.push_back({"extreme", meshing::explicit_axis({0, 1e-6, 2e-6, 1, 2, 2.0001, 3})});
    for (const auto& [name, axis] : axes)
        for (const bool periodic : {false, true}) {
            const AxisData data(axis, periodic, "x");
            const AxisView v = data.view();
            const auto centres = axis.centres();
            std::vector<double> points = centres;
            points.insert(points.end(), axis.faces.begin(), axis.faces.end());
            for (const double c : centres)
                for (const double to : {-1e300, 1e300}) points.push_back(std::nextafter(c, to));
            for (int i = 0; i <= 1000; ++i) points.push_back(axis.lower() + axis.length() * i / 1000);
            for (const double X : points) {
                int expected = -1;
                while (expected + 1 < v.n && centres[static_cast<std::size_t>(expected + 1)] <= X) ++expected;
                EXPECT_EQ(v.below(X), expected) << name << " " << X;
            }
        }
}

TEST(AxisView, PeriodicAxisWrapsPositionsAndContinuesCells) {
    if (exchange::on_gpu) GTEST_SKIP();
    const auto axis = meshing::explicit_axis({-2, -1.1, 0, 0.5, 1.4, 2.2, 3});
    const AxisData data(axis, true, "x");
    const AxisView v = data.view();
    int turns;
    EXPECT_DOUBLE_EQ(v.wrap(3.5, &turns), -1.5);
    EXPECT_EQ(turns, 1);
    EXPECT_EQ(v.wrap(3.0, &turns), -2.0);
    EXPECT_DOUBLE_EQ(v.wrap(-17.5, &turns), 2.5);
    EXPECT_EQ(turns, -4);
    // just below the box: rounds to its lower end without losing a turn
    EXPECT_EQ(v.wrap(-2.0 - 1e-16, &turns), -2.0);
    EXPECT_EQ(turns, 0);
    EXPECT_EQ(v.cell(-1), 5);
    EXPECT_EQ(v.cell(6), 0);
    EXPECT_EQ(v.cell(-7), 5);
    EXPECT_EQ(v.turns(-1), -1);
    EXPECT_EQ(v.turns(13), 2);
    EXPECT_DOUBLE_EQ(v.centre[-2], v.centre[4] - 5);
    EXPECT_DOUBLE_EQ(v.centre[7], v.centre[1] + 5);
    for (const double X : {-12.3, -2.1, 0.4, 2.99, 3.01, 14.7}) {
        const int k = v.below_unwrapped(X);
        EXPECT_LE(v.centre[v.cell(k)] + v.turns(k) * 5, X + 1e-12);
        EXPECT_GT(v.centre[v.cell(k + 1)] + v.turns(k + 1) * 5, X - 1e-12);
    }
    EXPECT_FALSE(v.contains(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_FALSE(v.contains(std::numeric_limits<double>::infinity()));
    EXPECT_TRUE(v.contains(1000));
}

TEST(AxisView, WidthIsContinuousAndExactAtCentres) {
    if (exchange::on_gpu) GTEST_SKIP();
    const auto axis = meshing::explicit_axis({-2, -1.1, 0, 0.5, 1.4, 2.2, 3});
    const auto centres = axis.centres(), widths = axis.widths();
    for (const bool periodic : {false, true}) {
        const AxisData data(axis, periodic, "x");
        const AxisView v = data.view();
        for (std::size_t i = 0; i < centres.size(); ++i) {
            EXPECT_DOUBLE_EQ(v.width_at(centres[i]), widths[i]);
            EXPECT_NEAR(v.width_at(centres[i] - 1e-9), widths[i], 1e-8);
        }
        EXPECT_NEAR(v.width_at(3 - 1e-12), v.width_at(periodic ? -2 : 3), 1e-10);
    }
}

TEST(AxisView, TooFewCellsBetweenWallsAreRefused) {
    EXPECT_THROW(AxisData(meshing::uniform_axis(0, 1, 3), false, "x"), InputError);
    EXPECT_NO_THROW(AxisData(meshing::uniform_axis(0, 1, 4), false, "x"));
    EXPECT_NO_THROW(AxisData(meshing::uniform_axis(0, 1, 1), true, "x"));
}

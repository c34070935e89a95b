#include "apps/extrapolation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hemoflux::apps {
namespace {

TEST(Extrapolation, FindsLimitAndOrder) {
    for (const double order : {0.7, 1.0, 1.9, 2.0, 4.0}) {
        std::vector<double> x{0.8, 0.4, 0.2}, y;
        for (const double h : x) y.push_back(6.1 - 0.3 * std::pow(h, order));
        const Extrapolation three = extrapolate(x, y);
        EXPECT_NEAR(three.limit, 6.1, 1e-7) << order;
        EXPECT_NEAR(three.order, order, 1e-5);
        x.push_back(0.13);
        y.push_back(6.1 - 0.3 * std::pow(0.13, order));
        const Extrapolation four = extrapolate(x, y);
        EXPECT_NEAR(four.limit, 6.1, 1e-7) << order;
        EXPECT_NEAR(four.order, order, 1e-5);
    }
}

TEST(Extrapolation, LeavesOutWhatIsMissing) {
    const Extrapolation fit = extrapolate({1, 0.5, 0.3, 0.25}, {2, 1.25, NAN, 1.0625});
    EXPECT_NEAR(fit.limit, 1, 1e-9);
    EXPECT_NEAR(fit.order, 2, 1e-6);
}

TEST(Extrapolation, SaysWhenThePointsShowNoOrder) {
    EXPECT_TRUE(std::isnan(extrapolate({1, 0.5}, {2, 1.25}).limit));
    EXPECT_TRUE(std::isnan(extrapolate({1, 1, 0.5}, {2, 2, 1.25}).limit));
    EXPECT_TRUE(std::isnan(extrapolate({1, 0.5, 0.25}, {0, 1, 3}).limit));  // diverges
}

}  // namespace
}  // namespace hemoflux::apps

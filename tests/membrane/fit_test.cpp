#include "membrane/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exchange/error.hpp"

namespace hemoflux::membrane {
namespace {

constexpr double data[] = {1.1, 1.9, 3.2, 3.9, 5.1, 5.8};

/// y = a + b x at x = 0 .. 5, each with the standard deviation sigma.
std::vector<double> line(const std::vector<double>& p, double sigma) {
    std::vector<double> r;
    for (int x = 0; x < 6; ++x) r.push_back((p[0] + p[1] * x - data[x]) / sigma);
    return r;
}

TEST(Fit, OfALineIsThatOfTheNormalEquations) {
    const FitResult f = fit({{0, -10, 10, 0.01}, {0.5, -3, 3, 0.01}},
                            [](const std::vector<double>& p) { return line(p, 0.2); });
    // by hand: S_xx = 17.5, mean x 2.5, mean y 3.5, S_xy = 16.9
    const double slope = 16.9 / 17.5, intercept = 3.5 - 2.5 * slope;
    EXPECT_NEAR(f.parameters[0], intercept, 1e-5);
    EXPECT_NEAR(f.parameters[1], slope, 1e-5);
    EXPECT_NEAR(f.by_weights[1], 0.2 / std::sqrt(17.5), 1e-6);
    EXPECT_NEAR(f.by_weights[0], 0.2 * std::sqrt(1.0 / 6 + 6.25 / 17.5), 1e-6);
    double squares = 0;
    for (int x = 0; x < 6; ++x) squares += std::pow(intercept + slope * x - data[x], 2);
    EXPECT_NEAR(f.chi2, squares / 0.04, 1e-6);
    EXPECT_NEAR(f.by_scatter[1], std::sqrt(squares / 4 / 17.5), 1e-6);
    EXPECT_NEAR(f.half_95[1], 2.7764451 * f.by_scatter[1], 1e-6);  // Student's t of 4 degrees of freedom
    EXPECT_LT(f.correlation, -0.8);
    EXPECT_EQ(f.at_bound, (std::vector<bool>{false, false}));
}

TEST(Fit, StaysInsideItsBounds) {
    const FitResult f = fit({{0, -10, 10, 0.01}, {0.5, 0, 0.8, 0.01}}, [](const std::vector<double>& p) {
        EXPECT_GE(p[1], 0);
        EXPECT_LE(p[1], 0.8);
        return line(p, 0.2);
    });
    EXPECT_NEAR(f.parameters[1], 0.8, 1e-3);
    EXPECT_TRUE(f.at_bound[1]);
    EXPECT_FALSE(f.at_bound[0]);
}

TEST(Fit, RefusesWhatCannotBeFitted) {
    const auto two = [](const std::vector<double>& p) { return std::vector<double>{p[0], p[1]}; };
    EXPECT_THROW(fit({{0, -1, 1, 0.1}, {0, -1, 1, 0.1}}, two), InputError);
    EXPECT_THROW(fit({{0, 1, 1, 0.1}}, two), InputError);
    EXPECT_THROW(fit({{0, 0, 1, 0}}, two), InputError);
}

}  // namespace
}  // namespace hemoflux::membrane

#include "membrane/arctangent.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "exchange/pack.hpp"

namespace hemoflux::membrane {
namespace {

template <class Value>
double largest_error() {
    constexpr std::size_t n = exchange::lanes<Value>;
    double worst = 0;
    for (int i = -4000; i <= 4000; ++i)
        for (double radius : {1e-9, 1.0, 3e8}) {
            double y[n], x[n], result[n];
            for (std::size_t l = 0; l < n; ++l) {
                const double angle = 3.14159265358979 * (i + static_cast<double>(l) / n) / 4001;
                y[l] = radius * std::sin(angle);
                x[l] = radius * std::cos(angle);
            }
            exchange::store(result, arctangent(exchange::load<Value>(y), exchange::load<Value>(x)));
            for (std::size_t l = 0; l < n; ++l)
                worst = std::max(worst, std::fabs(result[l] - std::atan2(y[l], x[l])) /
                                            std::fabs(std::atan2(y[l], x[l]) + 1e-300));
        }
    return worst;
}

TEST(Arctangent, PackAgreesWithTheStandardOneInAllQuadrants) {
    EXPECT_LT(largest_error<exchange::Pack>(), 5e-16);
}

TEST(Arctangent, DoubleAgreesWithTheStandardOneInAllQuadrants) { EXPECT_LT(largest_error<double>(), 5e-16); }

TEST(Arctangent, KeepsRelativeAccuracyOfSmallAngles) {
    for (double y : {1e-300, 1e-30, -1e-12, 1e-3})
        EXPECT_NEAR(arctangent(y, 1.0) / std::atan2(y, 1.0), 1, 3e-16) << y;
}

TEST(Arctangent, AxesAndOrigin) {
    const double pi = std::acos(-1.0);
    EXPECT_EQ(arctangent(0.0, 2.0), 0);
    EXPECT_DOUBLE_EQ(arctangent(0.0, -2.0), pi);
    EXPECT_DOUBLE_EQ(arctangent(2.0, 0.0), pi / 2);
    EXPECT_DOUBLE_EQ(arctangent(-2.0, 0.0), -pi / 2);
    EXPECT_EQ(arctangent(0.0, 0.0), 0);
}

}  // namespace
}  // namespace hemoflux::membrane

#include "fluid/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hemoflux::fluid {
namespace {

struct Linear final : Probe {
    std::array<double, 4> operator()(const Vec3d& x) const override { return {1, x.x, x.y, x.x + x.y + x.z}; }
};

TEST(Profile, SamplesBothEnds) {
    const Profile p = sample(Linear(), {0, 1, 0}, {1, 3, 4}, 5);
    ASSERT_EQ(p.at.size(), 5u);
    EXPECT_DOUBLE_EQ(p.at.front().y, 1);
    EXPECT_DOUBLE_EQ(p.at.back().z, 4);
    EXPECT_DOUBLE_EQ(p.values[2][3], 0.5 + 2 + 2);
}

TEST(Profile, MinimumOfASineToRoundingOfItsFlatness) {
    const Extremum m = minimum([](double x) { return std::sin(x); }, 0, 6);
    EXPECT_NEAR(m.at, 1.5 * M_PI, 1e-7);
    EXPECT_NEAR(m.value, -1, 1e-14);
}

TEST(Profile, MinimumAtAnEnd) {
    const Extremum m = minimum([](double x) { return x; }, -2, 3, 7);
    EXPECT_NEAR(m.at, -2, 1e-8);
    EXPECT_NEAR(m.value, -2, 1e-8);
}

TEST(Profile, FirstRiseThroughZero) {
    const auto f = [](double x) { return -std::sin(x); };  // falls through 0 at 2 pi, rises at pi and 3 pi
    EXPECT_NEAR(first_rise_through_zero(f, 0.5, 12).value(), M_PI, 1e-14);
    EXPECT_NEAR(first_rise_through_zero(f, 4, 12).value(), 3 * M_PI, 1e-14);
    EXPECT_FALSE(first_rise_through_zero(f, 4, 9).has_value());
}

}  // namespace
}  // namespace hemoflux::fluid

#include "coupling/cell_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>

#include "recorded_motion.hpp"

namespace hemoflux::coupling {
namespace {

constexpr double radian = std::numbers::pi / 180;

/// A history over 60 strain units; the inclination is written as the solver writes it, in (-90, 90].
MotionHistory history(const std::function<double(double)>& alpha,
                      const std::function<double(double)>& theta) {
    MotionHistory h;
    for (int i = 0; i <= 1200; ++i) {
        const double s = 0.05 * i;
        double a = std::remainder(alpha(s), 180);
        if (a <= -90) a += 180;
        h.strain.push_back(s);
        h.inclination_deg.push_back(a);
        h.material_deg.push_back(theta(s));
    }
    return h;
}

TEST(CellMotion, SteadyInclinationWithCirculatingMembraneIsTankTreading) {
    const CellMotion m = classify(
        history([](double s) { return 19 + 0.4 * std::sin(s); }, [](double s) { return -360 * s / 21; }));
    EXPECT_EQ(m.mode, MotionMode::tank_treading);
    EXPECT_EQ(m.flips, 0);
    EXPECT_EQ(m.treads, 5);  // 60 / 10.5
    EXPECT_NEAR(m.period(), 21, 0.1);
    EXPECT_NEAR(m.inclination_deg, 19, 0.02);
    EXPECT_NEAR(m.amplitude_deg, 0.4, 0.01);
}

TEST(CellMotion, SwingAtTwiceTheTankTreadingFrequency) {
    const double turn = 24;
    const auto alpha = [&](double s) { return 15 + 9 * std::sin(4 * std::numbers::pi * s / turn); };
    const CellMotion m = classify(history(alpha, [&](double s) { return -360 * s / turn; }));
    EXPECT_EQ(m.mode, MotionMode::swinging);
    EXPECT_NEAR(m.tank_treading_period, turn, 0.1);
    EXPECT_NEAR(m.swing_period, turn / 2, 0.1);
    EXPECT_NEAR(m.amplitude_deg, 9, 0.02);
}

TEST(CellMotion, JefferyOrbitOfARigidDiscIsTumbling) {
    // tan(alpha) = r tan(-t r/(r^2 + 1)) of a spheroid of aspect r = 1/3, whose axis is that of symmetry
    const double r = 1.0 / 3, rate = r / (r * r + 1);
    const auto alpha = [&](double s) {
        const double p = -rate * s;
        return std::atan2(r * std::sin(p), std::cos(p)) / radian;
    };
    const CellMotion m = classify(history(alpha, [&](double s) {
        return alpha(s) + 20 +
               5 * std::sin(2 * rate * s);  // the material goes with the axis, and a bit back and forth
    }));
    EXPECT_EQ(m.mode, MotionMode::tumbling);
    EXPECT_EQ(m.treads, 0);
    EXPECT_EQ(m.flips, static_cast<int>(60 * rate / std::numbers::pi));
    EXPECT_NEAR(m.period(), 2 * std::numbers::pi / rate, 0.05);
    EXPECT_TRUE(std::isnan(m.amplitude_deg));
}

TEST(CellMotion, BothTurningIsIntermittent) {
    const auto alpha = [](double s) { return s < 30 ? 10.0 : 10 - 180 * std::min((s - 30) / 8, 1.0); };
    const CellMotion m =
        classify(history(alpha, [&](double s) { return s < 30 ? -15 * s : -450 + alpha(s) - 10; }));
    EXPECT_EQ(m.mode, MotionMode::intermittent);
    EXPECT_EQ(m.flips, 1);
    EXPECT_EQ(m.treads, 2);
}

TEST(CellMotion, NothingTurningIsSteady) {
    const CellMotion m = classify(history([](double) { return 5.0; }, [](double) { return 30.0; }));
    EXPECT_EQ(m.mode, MotionMode::steady);
    EXPECT_TRUE(std::isnan(m.period()));
    EXPECT_EQ(classify(MotionHistory{}).mode, MotionMode::steady);
}

TEST(CellMotion, WindowLeavesTheStartOut) {
    const auto alpha = [](double s) {
        return s < 10 ? 90 - 15 * s : -60.0;
    };  // one flip at first, by the start
    MotionHistory all = history(alpha, [](double s) { return -18 * s; });
    all.inclination_deg.front() = 120;  // as far as to be a flip
    EXPECT_EQ(classify(all).mode, MotionMode::intermittent);
    const MotionHistory late = all.window(20, 60);
    EXPECT_EQ(late.strain.size(), 801U);
    EXPECT_EQ(classify(late).mode, MotionMode::tank_treading);
    EXPECT_NEAR(classify(late).period(), 20, 0.05);
}

MotionHistory recorded(const std::vector<test::Record>& records) {
    MotionHistory h;
    for (const test::Record& r : records) {
        h.strain.push_back(r.strain);
        h.inclination_deg.push_back(r.inclination_deg);
        h.material_deg.push_back(r.material_deg);
    }
    return h;
}

TEST(CellMotion, RecordedSwinging) {
    const CellMotion m = classify(recorded(test::prestressed_at_1_6));
    EXPECT_EQ(m.mode, MotionMode::swinging);
    EXPECT_NEAR(m.period(), 20.4, 0.3);
    EXPECT_NEAR(m.inclination_deg, 20.2, 0.2);
    EXPECT_NEAR(m.amplitude_deg, 4.0, 0.3);  // it falls from 6 in the first turn to 3
    EXPECT_NEAR(m.swing_period, 9, 0.5);     // maxima at strain 19, 29, 38, 46, 55
}

TEST(CellMotion, RecordedTumbling) {
    const CellMotion m = classify(recorded(test::stress_free_at_5));
    EXPECT_EQ(m.mode, MotionMode::tumbling);
    EXPECT_EQ(m.treads, 0);
    EXPECT_NEAR(m.period(), 19.9, 0.5);
}

TEST(CellMotion, EveryModeHasItsName) {
    EXPECT_STREQ(name_of(MotionMode::steady), "steady");
    EXPECT_STREQ(name_of(MotionMode::tumbling), "tumbling");
    EXPECT_STREQ(name_of(MotionMode::intermittent), "intermittent");
    EXPECT_STREQ(name_of(MotionMode::swinging), "swinging");
    EXPECT_STREQ(name_of(MotionMode::tank_treading), "tank treading");
}

TEST(CellMotion, ColumnsOfDifferentLengthsAreRefused) {
    EXPECT_THROW(classify({{0, 1}, {0, 1}, {0}}), std::length_error);
}

}  // namespace
}  // namespace hemoflux::coupling

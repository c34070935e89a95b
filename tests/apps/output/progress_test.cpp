#include "apps/output/progress.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hemoflux::output {
namespace {

TEST(ProgressTest, LineTellsStepPositionTimeLeftAndSpeed) {
    const Progress progress(0, 8, "strain", false);
    const std::string line = progress.line({1200, 2, 5e8}, 20);
    EXPECT_EQ(line,
              "[=====               ] strain 2 of 8  step 1200  1 min 00 s left  25.00 M cell residuals/s");
}

TEST(ProgressTest, TimeLeftAfterARestartCountsFromTheRestart) {
    const Progress progress(4, 8, "strain", false);
    EXPECT_NE(progress.line({0, 6, 0}, 10).find("  10 s left  --"), std::string::npos);
    EXPECT_NE(progress.line({0, 4, 0}, 0).find("-- left"), std::string::npos);
}

TEST(ProgressTest, IsSilentWhenStandardErrorIsNotATerminal) {
    testing::internal::CaptureStderr();
    {
        Progress progress(0, 1, "strain", false);
        progress.update({1, 0.5, 1});
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ProgressTest, DurationsForPeople) {
    EXPECT_EQ(duration(0.2), "0 s");
    EXPECT_EQ(duration(59.6), "1 min 00 s");
    EXPECT_EQ(duration(7620), "2 h 07 min");
    EXPECT_EQ(duration(NAN), "--");
    EXPECT_EQ(duration(-1), "--");
}

}  // namespace
}  // namespace hemoflux::output

#include "apps/units.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "exchange/error.hpp"

namespace hemoflux::apps {
namespace {

void expect_refused(const std::string& text, const std::string& unit, const std::string& part) {
    try {
        quantity(text, unit);
        FAIL() << text << " was accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

TEST(Units, ConvertsWhatTheFieldWrites) {
    EXPECT_DOUBLE_EQ(quantity("24 um", "um"), 24);
    EXPECT_DOUBLE_EQ(quantity("24um", "m"), 24e-6);
    EXPECT_DOUBLE_EQ(quantity("22 mPa s", "Pa s"), 0.022);
    EXPECT_DOUBLE_EQ(quantity("160 pN", "pN"), 160);
    EXPECT_DOUBLE_EQ(quantity("160 pN", "N"), 160e-12);
    EXPECT_DOUBLE_EQ(quantity("1.6 1/s", "1/s"), 1.6);
    EXPECT_DOUBLE_EQ(quantity("1.6 s-1", "1/s"), 1.6);
    EXPECT_DOUBLE_EQ(quantity("6.1 uN/m", "N/m"), 6.1e-6);
    EXPECT_DOUBLE_EQ(quantity("1000 kg/m^3", "kg/m^3"), 1000);
    EXPECT_DOUBLE_EQ(quantity("1 g/cm^3", "kg/m^3"), 1000);
    EXPECT_DOUBLE_EQ(quantity("2.5e-19 J", "J"), 2.5e-19);
    EXPECT_DOUBLE_EQ(quantity("-3 mm/s", "um/s"), -3000);
    EXPECT_DOUBLE_EQ(quantity("+1 kN/m^2", "Pa"), 1000);
    EXPECT_DOUBLE_EQ(conversion("mm", "um"), 1000);
}

TEST(Units, KeepsTheTypedNumberToTheLastBit) { EXPECT_EQ(quantity("0.1 um", "um"), 0.1); }

TEST(Units, RefusesOtherDimensions) { expect_refused("24 um", "Pa s", "measures something else"); }
TEST(Units, RefusesUnknownUnits) { expect_refused("24 umm", "um", "\"umm\" is not a unit"); }
TEST(Units, RefusesMissingUnits) { expect_refused("24", "um", "the unit is missing"); }
TEST(Units, RefusesMissingNumbers) {
    expect_refused("um", "um", "does not start with a finite number");
    expect_refused("", "um", "does not start with a finite number");
    expect_refused("nan um", "um", "does not start with a finite number");
    expect_refused("1e300 m", "fm", "not a finite number");
}

TEST(Units, MayBeUsedFromSeveralThreads) {
    std::vector<std::thread> threads;
    std::vector<double> sums(4, 0.0);
    for (std::size_t t = 0; t < sums.size(); ++t) {
        threads.emplace_back([&, t] {
            for (int i = 0; i < 200; ++i) {
                sums[t] += quantity("2 mPa s", "Pa s");
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    for (const double sum : sums) {
        EXPECT_NEAR(sum, 0.4, 1e-12);
    }
}

}  // namespace
}  // namespace hemoflux::apps

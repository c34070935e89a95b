// Cases with many cells and flows driven by a force: what is completed and what is refused.
#include "apps/case_suspension.hpp"

#include <gtest/gtest.h>

#include "apps/case_check.hpp"
#include "exchange/error.hpp"
#include "tests/apps/example_case.hpp"

namespace hemoflux::apps {
namespace {

const std::string channel_case = R"(title = "Channel"
[fluid]
viscosity = "2 mPa s"
[grid]
length = ["20 um", "10 um", "12 um"]
cells = [20, 20, 24]
[boundary]
x = "periodic"
y = { velocity = "no-slip" }
z = "periodic"
[body_force]
acceleration = ["100 m/s^2", "0 m/s^2", "0 m/s^2"]
[[cell]]
nodes = 162
[time]
strain = 2
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST(CaseSuspension, ClockOfAChannelIsTheWallRateOfItsFlow) {
    const Case c = parse_case(channel_case);
    // rho a H/(2 mu) = 1000 * 100 * 1e-5 / (2 * 2e-3) = 250 /s
    EXPECT_NEAR(c.shear_rate.value(), 250, 1e-9);
    EXPECT_EQ(c.fluid.initial, InitialFlow::channel);
    EXPECT_NEAR(flow_reach(c, 0), 2.5, 1e-12);  // H/4
    EXPECT_EQ(parse_case(c.resolved), c);
    const Case duct = parse_case(with(channel_case, "z = \"periodic\"", "z = { velocity = \"no-slip\" }"));
    EXPECT_LT(duct.shear_rate.value(), 250);
    EXPECT_GT(duct.shear_rate.value(), 150);
}

TEST(CaseSuspension, AGivenRateIsTheClock) {
    const Case c = parse_case(channel_case + "[shear]\nrate = \"50 1/s\"\n");
    EXPECT_EQ(c.shear_rate.value(), 50);
    EXPECT_EQ(c.fluid.initial, InitialFlow::shear);
    const Case both = parse_case(with(channel_case, "[grid]", "initial = \"channel\"\n[grid]") +
                                 "[shear]\nrate = \"50 1/s\"\n");
    EXPECT_EQ(both.fluid.initial, InitialFlow::channel);
    EXPECT_NEAR(flow_reach(both, 0), 12.5, 1e-12);
}

TEST(CaseSuspension, RefusesAForceThatNothingHolds) {
    for (const auto& [from, to] : {std::pair{"y = { velocity = \"no-slip\" }", "y = \"periodic\""},
                                   std::pair{"x = \"periodic\"", "x = { velocity = \"zero-gradient\" }"},
                                   std::pair{"\"0 m/s^2\", \"0 m/s^2\"", "\"1 m/s^2\", \"0 m/s^2\""}}) {
        const std::string text = with(channel_case, from, to);
        const std::string message = message_of<InputError>([&] { static_cast<void>(parse_case(text)); });
        EXPECT_NE(message.find("[body_force]"), std::string::npos) << to << ": " << message;
        EXPECT_NE(message.find("[shear]"), std::string::npos) << message;
    }
    const std::string text = example_with("[grid]", "initial = \"channel\"\n[grid]");
    EXPECT_NE(message_of<InputError>([&] { static_cast<void>(parse_case(text)); }).find("fluid.initial"),
              std::string::npos);
}

TEST(CaseSuspension, PacksAsManyCellsAsTheHaematocritSays) {
    const Case c = parse_case(channel_case + "[packing]\nhaematocrit = 0.2\nseed = 3\n");
    EXPECT_EQ(c.cells.size(), 5u);  // 0.2 * 2400 / 93.64 = 5.1
    EXPECT_EQ(c.packing->seed, 3);
    EXPECT_EQ(c.packing->gap, 0.2);
    EXPECT_EQ(parse_case(c.resolved), c);
    EXPECT_TRUE(check_case(c).empty());
    const auto refused = [](const std::string& text) {
        return message_of<InputError>([&] { static_cast<void>(parse_case(text)); });
    };
    EXPECT_NE(refused(channel_case + "[packing]\nhaematocrit = 0.01\n").find("holds 0.26 cells"),
              std::string::npos);
    EXPECT_NE(refused(channel_case + "[packing]\nhaematocrit = 0.9\n").find("haematocrit"),
              std::string::npos);
    EXPECT_NE(refused(channel_case + "[[cell]]\nnodes = 162\n[packing]\nhaematocrit = 0.1\n").find("alike"),
              std::string::npos);
}

TEST(CaseSuspension, ReadsContactInPhysicalUnits) {
    const Case c = parse_case(channel_case +
                              "[contact]\npressure = \"20 Pa\"\nrange = \"400 nm\"\nadhesion = \"1 uJ/m^2\"\n"
                              "adhesion_scale = \"3.84 1/um\"\nwalls = false\n");
    ASSERT_TRUE(c.contact);
    EXPECT_NEAR(c.contact->pressure, 20, 1e-12);
    EXPECT_NEAR(c.contact->range.value(), 0.4, 1e-12);
    EXPECT_NEAR(c.contact->adhesion, 1e-6, 1e-18);
    EXPECT_FALSE(c.contact->adhesion_distance);
    EXPECT_NEAR(c.contact->adhesion_scale, 3.84, 1e-12);
    EXPECT_FALSE(c.contact->walls);
    EXPECT_NE(message_of<InputError>([&] {
                  static_cast<void>(parse_case(channel_case + "[contact]\npressure = \"-1 Pa\"\n"));
              }).find("contact.pressure"),
              std::string::npos);
}

}  // namespace hemoflux::apps

#include "apps/output/child.hpp"

#include <gtest/gtest.h>

namespace hemoflux::output {
namespace {

using End = ChildResult::End;
using std::chrono::seconds;

TEST(ChildTest, PassesInputAndReturnsOutput) {
    const std::string text(200000, 'x');  // more than a pipe holds
    const ChildResult result = run_child({"cat"}, text, seconds(20));
    EXPECT_TRUE(result.ok());
    EXPECT_EQ(result.output, text);
}

TEST(ChildTest, TellsHowItEnded) {
    const ChildResult failed = run_child({"sh", "-c", "echo first; echo why >&2; exit 3"}, "", seconds(20));
    EXPECT_EQ(failed.end, End::exited);
    EXPECT_EQ(failed.why(), "it exited with 3: why");
    const ChildResult killed = run_child({"sh", "-c", "kill -6 $$"}, "", seconds(20));
    EXPECT_EQ(killed.end, End::signalled);
    EXPECT_EQ(killed.code, 6);
    EXPECT_EQ(run_child({"no-such-program-of-hemoflux"}, "", seconds(20)).end, End::not_started);
}

TEST(ChildTest, KillsTheChildAndItsChildrenWhenTheTimeIsUp) {
    const auto start = std::chrono::steady_clock::now();
    const ChildResult result = run_child({"sh", "-c", "sleep 60 & sleep 60"}, "", seconds(1));
    EXPECT_EQ(result.end, End::timed_out);
    EXPECT_LT(std::chrono::steady_clock::now() - start, seconds(20));
}

TEST(ChildTest, FindsProgramsOnThePath) {
    EXPECT_TRUE(find_program("sh").has_value());
    EXPECT_FALSE(find_program("no-such-program-of-hemoflux").has_value());
}

}  // namespace
}  // namespace hemoflux::output

#include "apps/output/convergence_plot.hpp"

#include <gtest/gtest.h>

#include "tests/apps/output/temporary_folder.hpp"

namespace hemoflux::output {
namespace {

class ConvergencePlotTest : public TemporaryFolder {};

TEST_F(ConvergencePlotTest, DrawsEveryResidual) {
    put("history.csv",
        "step,time_s,residual,residual_u\n0,0,nan,1\n1,1,1e-2,0.5\n2,2,1e-3,0.25\n3,3,1e-4,0.1\n");
    const auto message = plot_convergence(folder_ / "history.csv", folder_ / "plot_convergence", "Falling");
    if (message && message->find("gnuplot is missing") != std::string::npos) GTEST_SKIP() << *message;
    EXPECT_FALSE(message) << *message;
    const std::string svg = content("plot_convergence.svg");
    EXPECT_NE(svg.find("residual_u"), std::string::npos);
    EXPECT_NE(svg.find("Falling"), std::string::npos);
}

TEST_F(ConvergencePlotTest, NothingToDrawIsNoFailure) {
    put("history.csv", "step,residual\n0,1\n1,0.1\n");
    EXPECT_FALSE(plot_convergence(folder_ / "history.csv", folder_ / "plot_convergence", ""));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "plot_convergence.png"));
    EXPECT_TRUE(plot_convergence(folder_ / "missing.csv", folder_ / "plot_convergence", ""));
}

}  // namespace
}  // namespace hemoflux::output

#include "fluid/duct.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hemoflux::fluid {

TEST(DuctFlow, BetweenPlatesIsTheParabola) {
    const DuctFlow flow(0, 3, {0, -1, -5}, {7, 4, 10}, {true, false, true});
    EXPECT_DOUBLE_EQ(flow.largest_speed(), 3 * 4.0 / 2);
    EXPECT_DOUBLE_EQ(flow.mean_speed(), 4);
    EXPECT_DOUBLE_EQ(flow.wall_rate(), 6);
    EXPECT_DOUBLE_EQ(flow.speed({2, 0, 3}), 4.5);
    EXPECT_NEAR(flow.speed({2, -1, 3}), 0, 1e-14);
}

TEST(DuctFlow, SolvesThePoissonEquationInARectangle) {
    // along z, 2 x 3 across; negative drive
    const DuctFlow flow(2, -1.7, {0, 1, 0}, {3, 2, 8}, {false, false, true});
    constexpr double h = 1e-3;
    const auto u = [&](double x, double y) { return flow.speed({x, y, 4}); };
    for (const double x : {0.4, 1.5, 2.2})
        for (const double y : {1.3, 2.0, 2.6}) {
            const double laplacian =
                (u(x + h, y) + u(x - h, y) + u(x, y + h) + u(x, y - h) - 4 * u(x, y)) / (h * h);
            EXPECT_NEAR(laplacian, 1.7, 2e-4);
        }
    for (const double s : {0.2, 0.5, 0.8}) {
        EXPECT_NEAR(u(3 * s, 1), 0, 1e-12);
        EXPECT_NEAR(u(0, 1 + 2 * s), 0, 2e-5);
    }
    // the walls of the short side's ends are long: largest rate at y = 1, x = 1.5
    EXPECT_NEAR(flow.wall_rate(), -u(1.5, 1 + h) / h, 2e-3);
    double mean = 0;
    constexpr int n = 200;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) mean += u(3 * (i + 0.5) / n, 1 + 2 * (j + 0.5) / n) / (n * n);
    EXPECT_NEAR(flow.mean_speed(), mean, 1e-4 * std::abs(mean));
}

// Shah and London: f Re = 2 D_h^2 F / mean = 56.91 (Darcy), largest over mean 2.096 in a square duct.
TEST(DuctFlow, HasThePublishedResistanceOfASquareDuct) {
    const DuctFlow flow(0, 1, {0, 0, 0}, {1, 2, 2}, {true, false, false});
    EXPECT_NEAR(2 * 4 / flow.mean_speed(), 56.91, 0.01);
    EXPECT_NEAR(flow.largest_speed() / flow.mean_speed(), 2.096, 1e-3);
}

TEST(DuctFlow, InARoundPipeIsThatOfHagenAndPoiseuille) {
    const DuctFlow flow = DuctFlow::round(0, 3, 2);
    EXPECT_EQ(flow.axis(), 0u);
    EXPECT_NEAR(flow.largest_speed(), 3, 1e-14);
    EXPECT_NEAR(flow.mean_speed(), 1.5, 1e-14);
    EXPECT_NEAR(flow.wall_rate(), 3, 1e-14);
    EXPECT_NEAR(flow.speed({7, 1.2, -1.6}), 0, 1e-14);
    // laplace(u) = -drive
    const auto u = [&](double y, double z) { return flow.speed({0, y, z}); };
    const double h = 1e-3, y = 0.3, z = -0.7;
    EXPECT_NEAR((u(y + h, z) + u(y - h, z) + u(y, z + h) + u(y, z - h) - 4 * u(y, z)) / (h * h), -3, 1e-6);
}

}  // namespace hemoflux::fluid

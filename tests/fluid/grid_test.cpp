#include "fluid/grid.hpp"

#include <gtest/gtest.h>

#include "exchange/error.hpp"

namespace hemoflux::fluid {

// Both operators are exact for linear fields; least squares on a line for quadratics too, Green-Gauss only where the
// neighbours are equally far.
TEST(Grid, GradientOperators) {
    meshing::RectilinearGrid box;
    box.axes.fill(meshing::explicit_axis({0, 1, 1.5, 3, 3.7, 4}));
    for (const GradientMethod method : {GradientMethod::least_squares, GradientMethod::green_gauss}) {
        const Grid grid(box, {false, false, false}, 1e300, method);
        std::vector<double> plus(5), minus(5);
        exchange::copy_to_host(plus.data(), grid.view().axis[1].plus, 5 * sizeof(double));
        exchange::copy_to_host(minus.data(), grid.view().axis[1].minus, 5 * sizeof(double));
        const auto x = box.axes[1].centres();
        double worst = 0;
        for (std::size_t i = 1; i < 4; ++i) {
            EXPECT_NEAR(plus[i] * (x[i + 1] - x[i]) + minus[i] * (x[i] - x[i - 1]), 1, 1e-15);
            const double square = plus[i] * (x[i + 1] * x[i + 1] - x[i] * x[i]) +
                                  minus[i] * (x[i] * x[i] - x[i - 1] * x[i - 1]);
            worst = std::max(worst, std::abs(square - 2 * x[i]));
        }
        if (method == GradientMethod::least_squares)
            EXPECT_LT(worst, 1e-14);
        else
            EXPECT_NEAR(worst, 0.3,
                        1e-14);  // half the difference of the distances, 1.1 - 0.5 at the cell x = 3.35
    }
    EXPECT_THROW(Grid(box, {false, false, false}, 1e300, GradientMethod::hybrid), InputError);
}

}  // namespace hemoflux::fluid

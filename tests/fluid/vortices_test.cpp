#include "fluid/vortices.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hemoflux::fluid {
namespace {

template <class F>
PlaneField field(const meshing::Axis& x, const meshing::Axis& y, const F& f) {
    PlaneField psi{x, y, {}};
    for (const double b : y.centres())
        for (const double a : x.centres()) psi.values.push_back(f(a, b));
    return psi;
}

TEST(Vortices, ExactForAQuadraticOnAStretchedGrid) {
    const auto f = [](double x, double y) {
        const double a = x - 0.617, b = y - 0.734;
        return -0.1034 + 0.4 * a * a + 0.1 * a * b + 0.3 * b * b;
    };
    const auto found =
        find_vortices(field(meshing::chebyshev_axis(0, 1, 21), meshing::plateau_axis(0, 1, 16, 3, 0.5), f));
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].x, 0.617, 1e-12);
    EXPECT_NEAR(found[0].y, 0.734, 1e-12);
    EXPECT_NEAR(found[0].psi, -0.1034, 1e-13);
}

TEST(Vortices, StrongestFirstAndBothSenses) {
    // four cells of sin sin, damped towards x = 1
    const auto f = [](double x, double y) {
        return -std::exp(-x) * std::sin(2 * M_PI * x) * std::sin(2 * M_PI * y);
    };
    const auto found =
        find_vortices(field(meshing::uniform_axis(0, 1, 60), meshing::uniform_axis(0, 1, 60), f));
    ASSERT_EQ(found.size(), 4u);
    const double x = std::atan(2 * M_PI) / (2 * M_PI);  // zero of d/dx e^-x sin(2 pi x)
    const auto lower_left = found[0].y < 0.5 ? found[0] : found[1];
    EXPECT_NEAR(lower_left.x, x, 2e-4);
    EXPECT_NEAR(lower_left.y, 0.25, 2e-4);
    EXPECT_NEAR(lower_left.psi, f(x, 0.25), 1e-4);
    EXPECT_LT(found[0].psi * found[1].psi, 0);
    EXPECT_NEAR(found[2].x, x + 0.5, 2e-4);
}

TEST(Vortices, LeavesOutWhatIsWeakerThanAsked) {
    const auto f = [](double x, double y) {
        return std::sin(M_PI * x) * std::sin(M_PI * y) * (x < 1 ? -1 : 1e-3);
    };
    const auto psi = field(meshing::uniform_axis(0, 2, 40), meshing::uniform_axis(0, 1, 20), f);
    EXPECT_EQ(find_vortices(psi, 1e-2).size(), 1u);
    EXPECT_EQ(find_vortices(psi, 1e-4).size(), 2u);
}

}  // namespace
}  // namespace hemoflux::fluid

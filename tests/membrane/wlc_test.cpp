#include "membrane/wlc.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "exchange/vec3.hpp"

namespace hemoflux::membrane {
namespace {

double energy(const WormLikeChain& chain, double length, double contour) {
    const double l = length / contour;
    return chain.energy(l, 1 / (1 - l), contour);
}

TEST(WormLikeChain, StiffnessOfTheSpecifiedNetwork) {
    // k_s = 1.90889 K_S L_0 at r = 2.6; stiffness = k_s / (r L_0)
    EXPECT_NEAR(WormLikeChain(1.0, 2.6).stiffness * 2.6, 1.90889, 1e-5);
}

TEST(WormLikeChain, EnergyAndForceVanishAtRest) {
    const WormLikeChain chain(0.61, 2.6);
    const double contour = 2.6 * 0.285, l = 1 / 2.6;
    EXPECT_NEAR(chain.energy(l, 1 / (1 - l), contour), 0, 1e-16);
    EXPECT_NEAR(chain.tension(l, 1 / (1 - l), contour), 0, 1e-16);
}

TEST(WormLikeChain, TensionIsTheDerivativeOfTheEnergy) {
    const WormLikeChain chain(0.4, 2.6);
    const double contour = 0.7, h = 1e-5;
    for (double l : {0.1, 0.3, 0.5, 0.8, 0.95}) {
        const double length = l * contour;
        const double slope =
            (energy(chain, length + h, contour) - energy(chain, length - h, contour)) / (2 * h);
        const double tension = chain.tension(l, 1 / (1 - l), contour);
        EXPECT_NEAR(tension, slope, 1e-7 * (1 + std::fabs(tension))) << l;
    }
}

/// Energy per area of a flat hexagonal sheet of springs at rest, under the deformation that maps (X, Y) to
/// (stretch X + shear Y, Y / stretch). A vertex owns three springs and sqrt(3)/2 L_0^2.
double sheet_energy(const WormLikeChain& chain, double shear, double stretch) {
    const double rest = 0.25, contour = 2.6 * rest;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double angle = k * std::acos(-1.0) / 3, x = rest * std::cos(angle), y = rest * std::sin(angle);
        sum += energy(chain, std::hypot(stretch * x + shear * y, y / stretch), contour);
    }
    return sum / (std::sqrt(3.0) / 2 * rest * rest);
}

TEST(WormLikeChain, HexagonalSheetShearsWithTheGivenModulus) {
    for (double modulus : {0.4, 0.61}) {
        const WormLikeChain chain(modulus, 2.6);
        const double h = 1e-3, zero = sheet_energy(chain, 0, 1);
        // E = G gamma^2 / 2 in simple shear, and 2 G e^2 in pure shear of stretch 1 + e.
        const double simple = (sheet_energy(chain, h, 1) - 2 * zero + sheet_energy(chain, -h, 1)) / (h * h);
        const double pure = (sheet_energy(chain, 0, 1 + h) - 2 * zero + sheet_energy(chain, 0, 1 / (1 + h))) /
                            (4 * std::log(1 + h) * std::log(1 + h));
        EXPECT_NEAR(simple / modulus, 1, 1e-4);
        EXPECT_NEAR(pure / modulus, 1, 1e-4);
    }
}

}  // namespace
}  // namespace hemoflux::membrane

#include "membrane/bending.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/membrane/shapes_for_tests.hpp"

namespace hemoflux::membrane {
namespace {

/// Angle of the roof over the edge from the origin to (length, 0, 0) whose two wings drop by `slope` radians.
double roof_angle(double slope, double length) {
    const Vec3d e{length, 0, 0}, left{0.3, std::cos(slope), -std::sin(slope)},
        right{0.4, -std::cos(slope), -std::sin(slope)};
    return edge_angle(length, left, cross(e, left), cross(right, e));
}

TEST(Bending, EdgeAngleIsSignedConvexPositive) {
    for (double slope : {-1.5, -0.3, -1e-6, 0.0, 1e-6, 0.2, 0.8, 1.5}) {
        EXPECT_NEAR(roof_angle(slope, 0.7), 2 * slope, 1e-15) << slope;
        EXPECT_NEAR(roof_angle(slope, 2.5), 2 * slope, 1e-15) << slope;
    }
}

TEST(Bending, TotalCurvatureOfASphere) {
    const auto topology = test::icosphere_topology(4);
    const auto sphere = meshing::icosphere(4, 3.0).vertices;
    Batch batch(topology, {}, reference_from_shape(*topology, sphere));
    batch.set_positions(0, sphere);
    batch.compute_forces();
    EXPECT_NEAR(batch.sums(0).total_curvature / (8 * red_blood_cell::pi * 3.0), 1, 1e-3);
}

/// E_B / (8 pi K_B) of an icosphere with C_0 = 0; the twelve five-fold nodes keep it above 1.
TEST(Bending, EnergyOfTheSphereTendsToEightPiKappa) {
    const std::map<int, double> expected{{2, 1.0073}, {3, 1.0018}, {4, 1.0005}, {5, 1.0001}};
    for (const auto& [level, value] : expected) {
        const auto topology = test::icosphere_topology(level);
        const auto sphere = meshing::icosphere(level, red_blood_cell::radius()).vertices;
        Parameters parameters;
        parameters.bending = {.local = 0.025, .area_difference = 0};
        Batch batch(topology, parameters, reference_from_shape(*topology, sphere, {.reduced_curvature = 0}));
        batch.set_positions(0, sphere);
        batch.compute_forces();
        const double ratio = batch.energies(0).bending / (8 * red_blood_cell::pi * 0.025);
        EXPECT_NEAR(ratio, value, 0.5e-4) << topology->vertices() << " nodes";
        RecordProperty(std::to_string(topology->vertices()), std::to_string(ratio));
    }
}

}  // namespace
}  // namespace hemoflux::membrane

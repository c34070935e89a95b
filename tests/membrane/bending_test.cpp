#include "membrane/bending.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "exchange/error.hpp"
#include "meshing/spheroid.hpp"
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

/// E_B / (8 pi K_B) of a shape with C_0 = 0 and no area-difference term.
double reduced_energy(const meshing::SurfaceMesh& shape, BendingScheme scheme) {
    const auto topology = std::make_shared<const Topology>(shape);
    Parameters parameters;
    parameters.bending = {.local = 0.025, .area_difference = 0, .scheme = scheme};
    parameters.network.shear = 0;
    Batch batch(topology, parameters,
                reference_from_shape(*topology, shape.vertices, {.reduced_curvature = 0}));
    batch.set_positions(0, shape.vertices);
    batch.compute_forces();
    return batch.energies(0).bending / (8 * red_blood_cell::pi * 0.025);
}

/// The twelve five-fold nodes keep Juelicher's energy above 1.
TEST(Bending, EnergyOfTheSphereTendsToEightPiKappaWithEveryScheme) {
    const std::map<BendingScheme, std::map<int, double>> expected{
        {BendingScheme::juelicher, {{2, 1.0073}, {3, 1.0018}, {4, 1.0005}, {5, 1.0001}}},
        {BendingScheme::gompper_kroll, {{2, 0.9812}, {3, 0.9952}, {4, 0.9988}, {5, 0.9997}}}};
    for (const auto& [scheme, line] : expected)
        for (const auto& [level, value] : line) {
            const auto sphere = meshing::icosphere(level, red_blood_cell::radius());
            const double ratio = reduced_energy(sphere, scheme);
            EXPECT_NEAR(ratio, value, 0.5e-4) << sphere.vertices.size() << " nodes";
            RecordProperty(
                std::to_string(static_cast<int>(scheme)) + "_" + std::to_string(sphere.vertices.size()),
                std::to_string(ratio));
        }
}

/// Spheroids of semi-axes (1, 1, q): Simpson quadrature of (K_B/2) int (c_1 + c_2)^2 dA with 8000 points.
TEST(Bending, EnergyOfSpheroidsConvergesWithSecondOrderWithEveryScheme) {
    const std::map<double, double> quadrature{{0.25, 3.283299}, {0.5, 1.345043}, {0.75, 1.048728},
                                              {1.0, 1.0},       {1.5, 1.080562}, {3.0, 1.581074}};
    for (const BendingScheme scheme : {BendingScheme::juelicher, BendingScheme::gompper_kroll})
        for (const auto& [q, exact] : quadrature) {
            std::vector<double> errors;
            for (const int level : {3, 4, 5})
                errors.push_back(std::fabs(
                    reduced_energy(meshing::spheroid(meshing::icosphere(level, 1.0), 1, 1, q), scheme) -
                    exact));
            EXPECT_LT(errors[2], 4e-3 * exact) << q;
            EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.25) << q;
            EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.35) << q;
        }
}

/// C_0 and M_0 enter both schemes alike: of a sphere of radius R, E = 2 pi K_B (2 - C_0 R)^2 + 4 K_ADE ... .
TEST(Bending, SpontaneousCurvatureAndAreaDifferenceWithEveryScheme) {
    const double radius = 2, c0 = 1.7, pi = red_blood_cell::pi;
    const auto sphere = meshing::icosphere(5, radius);
    const auto topology = std::make_shared<const Topology>(sphere);
    for (const BendingScheme scheme : {BendingScheme::juelicher, BendingScheme::gompper_kroll}) {
        Parameters parameters;
        parameters.bending = {.local = 0.02, .area_difference = 0.03, .scheme = scheme};
        Reference reference = reference_from_shape(*topology, sphere.vertices);
        reference.curvature = c0;
        reference.total_curvature = 40;
        Batch batch(topology, parameters, reference);
        batch.set_positions(0, sphere.vertices);
        batch.compute_forces();
        const double helfrich = 2 * pi * 0.02 * (2 - c0 * radius) * (2 - c0 * radius);
        const double difference = 8 * pi * radius - 40;
        EXPECT_NEAR(batch.energies(0).bending, helfrich, 2e-3 * helfrich);
        EXPECT_NEAR(batch.energies(0).area_difference, 0.03 / reference.area * difference * difference,
                    2e-3 * batch.energies(0).area_difference);
    }
}

TEST(Bending, ObtuseTrianglesAreNamedByGompperKroll) {
    const auto sphere = meshing::icosphere(1, 1.0).vertices;
    const auto topology = test::icosphere_topology(1);
    Parameters parameters;
    parameters.bending.scheme = BendingScheme::gompper_kroll;
    Batch batch(topology, parameters, reference_from_shape(*topology, sphere));
    auto moved = sphere;  // vertex 0 almost onto the opposite edge of its first triangle
    const auto ring = topology->neighbours(0);
    const Vec3d middle =
        0.5 * (sphere[static_cast<std::size_t>(ring[0])] + sphere[static_cast<std::size_t>(ring[1])]);
    moved[0] = middle + 0.03 * (sphere[0] - middle);
    batch.set_positions(0, moved);
    try {
        batch.compute_forces();
        FAIL() << "accepted";
    } catch (const NumericalError& error) {
        EXPECT_NE(std::string(error.what()).find("Voronoi area"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace hemoflux::membrane

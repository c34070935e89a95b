#include "membrane/reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "tests/membrane/shapes_for_tests.hpp"

namespace hemoflux::membrane {
namespace {

TEST(Parameters, TablesInInternalUnits) {
    const Parameters free = stress_free_parameters(), pre = pre_stressed_parameters();
    // Units: tension 1e-5 N/m, pressure 10 N/m^2, energy 1e-17 J, surface viscosity 1e-10 Pa s m.
    EXPECT_DOUBLE_EQ(free.constraint.volume * 10, 1000);
    EXPECT_DOUBLE_EQ(free.constraint.area * 1e-5, 1e-3);
    EXPECT_DOUBLE_EQ(free.constraint.local_area * 1e-5, 1e-4);
    EXPECT_DOUBLE_EQ(free.bending.local * 1e-17, 2.5e-19);
    EXPECT_DOUBLE_EQ(free.bending.area_difference * 1e-17, 2.5e-19);
    EXPECT_DOUBLE_EQ(free.network.shear * 1e-5, 4e-6);
    EXPECT_DOUBLE_EQ(pre.network.shear * 1e-5, 6.1e-6);
    EXPECT_DOUBLE_EQ(free.network.viscosity * 1e-10, 0.7e-6);
    EXPECT_NEAR(red_blood_cell::radius(), 3.2655, 5e-5);
}

TEST(Parameters, RefuseNegativeAndInfiniteModuli) {
    Parameters p;
    p.network.shear = -0.1;
    EXPECT_THROW(p.check(), InputError);
    p = {};
    p.constraint.local_area = std::nan("");
    EXPECT_THROW(p.check(), InputError);
    p = {};
    p.bending.area_difference = INFINITY;
    EXPECT_THROW(p.check(), InputError);
}

TEST(Reference, ReadsAreasLengthsAndCurvaturesOfAShape) {
    const auto topology = test::icosphere_topology(3);
    const auto sphere = meshing::icosphere(3, red_blood_cell::radius());
    const Reference r = reference_from_shape(*topology, sphere.vertices);
    EXPECT_NEAR(std::accumulate(r.triangle_areas.begin(), r.triangle_areas.end(), 0.0), meshing::area(sphere),
                1e-10);
    EXPECT_DOUBLE_EQ(r.curvature, 6 / red_blood_cell::radius());
    EXPECT_DOUBLE_EQ(r.total_curvature, 8 * std::acos(-1.0) * red_blood_cell::radius());
    EXPECT_EQ(r.area, 134);
    EXPECT_EQ(r.volume, 93.64);
    EXPECT_EQ(r.stretch_ratio, 2.6);
    const meshing::SurfaceQuality quality = meshing::quality(sphere);
    const auto [shortest, longest] = std::minmax_element(r.edge_lengths.begin(), r.edge_lengths.end());
    EXPECT_NEAR(*shortest, quality.shortest_edge, 1e-12);
    EXPECT_NEAR(*longest, quality.longest_edge, 1e-12);
}

TEST(Reference, UniformLengthScalesWithTheMesh) {
    const auto topology = test::icosphere_topology(2);
    const auto disc = meshing::evans_fung(meshing::icosphere(2, 1.0));
    const Reference scaled = uniform_length_reference(*topology, disc.vertices);
    for (double length : scaled.edge_lengths) EXPECT_EQ(length, 1.16 * mean_edge(*topology, disc.vertices));
    // On a sphere, whose triangles are all but equilateral, both means agree.
    const auto sphere = meshing::icosphere(2, 1.0);
    EXPECT_NEAR(mean_edge(*topology, sphere.vertices) / meshing::quality(sphere).mean_edge, 1, 3e-3);
    EXPECT_EQ(uniform_length_reference(*topology, disc.vertices, 0.285).edge_lengths.back(), 0.285);
    const double mean_area = meshing::area(disc) / static_cast<double>(disc.triangles.size());
    for (const double a : scaled.triangle_areas) EXPECT_NEAR(a, mean_area, 1e-12);
}

TEST(Reference, CoarseGrainedLengthIsThatOfTheSpectrinNetworkOnFewerVertices) {
    EXPECT_DOUBLE_EQ(coarse_grained_length(27344), 0.075);
    EXPECT_NEAR(coarse_grained_length(2562), 0.2451, 1e-4);
    EXPECT_NEAR(coarse_grained_length(2562, 4 * red_blood_cell::area), 2 * 0.2451, 2e-4);
}

TEST(Reference, TakesTheValuesOfTheWholeCellFromTheRestState) {
    const auto topology = test::icosphere_topology(1);
    const RestState rest{.area = 100, .volume = 50, .reduced_curvature = 3, .area_difference = 2};
    const Reference r = reference_from_shape(*topology, meshing::icosphere(1, 1.0).vertices, rest);
    EXPECT_EQ(r.area, 100);
    EXPECT_EQ(r.volume, 50);
    EXPECT_DOUBLE_EQ(r.curvature * rest.radius(), 3);
    EXPECT_DOUBLE_EQ(r.total_curvature, 16 * red_blood_cell::pi * rest.radius());
}

}  // namespace
}  // namespace hemoflux::membrane

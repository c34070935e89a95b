#include "apps/cell_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "membrane/diagnostics.hpp"
#include "tests/apps/example_case.hpp"

namespace hemoflux::apps {
namespace {

CellInput cell_with(const std::vector<std::string>& sets) {
    std::vector<std::string> all{"cell.0.nodes=642", "cell.0.spring_length=auto"};
    all.insert(all.end(), sets.begin(), sets.end());
    return parse_case(example_case, "case", "/", all).cells[0];
}

TEST(CellBuilder, ModuliInInternalUnits) {
    const membrane::Parameters p =
        membrane_parameters(cell_with({"cell.0.membrane_viscosity=0.7e-6 Pa s m"}));
    EXPECT_DOUBLE_EQ(p.constraint.volume, 100);  // Table 6.1 in internal units
    EXPECT_NEAR(p.constraint.area, 100, 1e-12);
    EXPECT_NEAR(p.constraint.local_area, 10, 1e-12);
    EXPECT_NEAR(p.bending.local, 0.025, 1e-15);
    EXPECT_NEAR(p.bending.area_difference, 0.025, 1e-15);
    EXPECT_NEAR(p.network.shear, 0.61, 1e-14);
    EXPECT_NEAR(p.network.viscosity, 7000, 1e-9);
}

TEST(CellBuilder, DefaultsAreTheCellOfTheMembraneRoom) {
    const membrane::Cell ours = build_cell(cell_with({}));
    membrane::ShapeOptions options;
    options.parameters = membrane_parameters(cell_with({}));
    options.reference = membrane::ReferenceKind::uniform_length;
    const membrane::Cell theirs = membrane::make_discocyte(3, options);
    EXPECT_NEAR(ours.reference.edge_lengths[0], theirs.reference.edge_lengths[0], 1e-4);
    EXPECT_NEAR(ours.reference.total_curvature, theirs.reference.total_curvature, 1e-12);
    EXPECT_NEAR(ours.relaxation.energy, theirs.relaxation.energy, 1e-3 * theirs.relaxation.energy);
}

TEST(CellBuilder, UniformSpringsFollowInputOrMesh) {
    const membrane::Cell given =
        build_cell(cell_with({"cell.0.spring_length=0.58 um", "cell.0.shape=evans-fung"}));
    EXPECT_EQ(given.reference.edge_lengths.front(), 0.58);
    EXPECT_EQ(given.reference.edge_lengths.back(), 0.58);
    const membrane::Cell chosen = build_cell(cell_with({"cell.0.shape=evans-fung"}));
    EXPECT_NEAR(chosen.reference.edge_lengths.front(),
                1.16 * membrane::mean_edge(*chosen.topology, chosen.positions), 1e-12);
    // table 6.2: 0.285 um at 2562 nodes
    const membrane::Cell fine = build_cell(cell_with({"cell.0.nodes=2562", "cell.0.shape=evans-fung"}));
    EXPECT_NEAR(fine.reference.edge_lengths.front(), 0.285, 0.002);
}

TEST(CellBuilder, ReferenceTakesItsConstantsFromTheInput) {
    const membrane::Cell cell =
        build_cell(cell_with({"cell.0.shape=sphere", "cell.0.reference=stress-free",
                              "cell.0.spontaneous_curvature=3", "cell.0.relaxed_area_difference=2",
                              "cell.0.area=100 um^2", "cell.0.volume=80 um^3", "cell.0.spring_ratio=3"}));
    const double radius = std::sqrt(100 / (4 * M_PI));
    EXPECT_DOUBLE_EQ(cell.reference.area, 100);
    EXPECT_DOUBLE_EQ(cell.reference.volume, 80);
    EXPECT_DOUBLE_EQ(cell.reference.curvature, 3 / radius);
    EXPECT_DOUBLE_EQ(cell.reference.total_curvature, 16 * M_PI * radius);
    EXPECT_DOUBLE_EQ(cell.reference.stretch_ratio, 3);
    EXPECT_NEAR(norm(cell.positions[17]), radius, 1e-12);
}

TEST(CellBuilder, DiscOfTheSpheroidReference) {
    // an independent implementation of the same method: 7.73, 0.89, 2.58 um at 2562 nodes
    const membrane::Cell cell = build_cell(
        cell_with({"cell.0.nodes=2562", "cell.0.reference=spheroid", "cell.0.shear_modulus=4 uN/m"}));
    const auto disc = membrane::disc_measures(cell.topology->triangles(), cell.positions);
    EXPECT_NEAR(disc.diameter, 7.73, 0.05);
    EXPECT_NEAR(disc.centre_thickness, 0.89, 0.05);
    EXPECT_NEAR(disc.greatest_thickness, 2.58, 0.05);
}

}  // namespace
}  // namespace hemoflux::apps

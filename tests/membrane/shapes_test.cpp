#include "membrane/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "exchange/error.hpp"
#include "membrane/batch.hpp"
#include "membrane/diagnostics.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/spheroid.hpp"

namespace hemoflux::membrane {
namespace {

/// Published state of a relaxed disc of 2562 nodes: energies +-0.5 %, lengths +-0.05 um.
struct Disc {
    double diameter, centre, greatest;
};
constexpr double length_tolerance = 0.05;

DiscMeasures measures(const Cell& cell) { return disc_measures(cell.topology->triangles(), cell.positions); }

void expect_disc(const Cell& cell, const Disc& disc, double tolerance = length_tolerance) {
    const DiscMeasures d = measures(cell);
    EXPECT_NEAR(d.diameter, disc.diameter, tolerance);
    EXPECT_NEAR(d.centre_thickness, disc.centre, tolerance);
    EXPECT_NEAR(d.greatest_thickness, disc.greatest, tolerance);
}

Cell cell_of(int level, ReferenceKind kind, Route route, const Parameters& parameters = {}) {
    return make_discocyte(level, {.reference = kind, .parameters = parameters, .route = route});
}

/// The discocyte of the spheroid reference by its two routes: the same disc, centred, its axis along z, with
/// the specified offsets of area and volume from A_0 and V_0.
Cell discocyte_by_both_routes(int level) {
    const Cell disc = cell_of(level, ReferenceKind::spheroid, Route::evans_fung);
    const Cell deflated = cell_of(level, ReferenceKind::spheroid, Route::deflation);
    EXPECT_NEAR(disc.relaxation.energy, deflated.relaxation.energy, 1e-4);
    const DiscMeasures d = measures(deflated);
    expect_disc(disc, {d.diameter, d.centre_thickness, d.greatest_thickness}, 5e-3);
    const ShapeMoments m = shape_moments(disc.topology->triangles(), disc.positions);
    EXPECT_NEAR(m.area / red_blood_cell::area - 1, -0.06e-2, 0.05e-2);
    EXPECT_NEAR(m.volume / red_blood_cell::volume - 1, 0.02e-2, 0.01e-2);
    EXPECT_LT(norm(m.centroid), 1e-12);
    EXPECT_NEAR(std::fabs(m.axes[2].z), 1, 1e-6);
    return disc;
}

TEST(Discocyte, BothRoutesReachTheSameDiscAt642Nodes) {
    const DiscMeasures d = measures(discocyte_by_both_routes(3));
    EXPECT_NEAR(d.diameter, 7.73, length_tolerance);
    EXPECT_NEAR(d.centre_thickness, 0.89, length_tolerance);
}

TEST(Discocyte, StressFreeSpringsCarryNoForceOnTheirDisc) {
    const Cell cell = cell_of(2, ReferenceKind::stress_free, Route::evans_fung);
    Batch batch(cell.topology, cell.parameters, cell.reference);
    batch.set_positions(0, cell.positions);
    batch.compute_forces();
    // L_0 and A_k0 are those of the disc before its last relaxation, which moved it a little.
    EXPECT_LT(batch.energies(0).shear, 0.05 * batch.energies(0).total());
    EXPECT_NEAR(batch.energies(0).total(), cell.relaxation.energy, 1e-9);
}

TEST(Discocyte, UniformSpringsAreCompressedAndTheCellIsBiconcave) {
    const Cell cell = cell_of(3, ReferenceKind::uniform_length, Route::evans_fung, pre_stressed_parameters());
    const auto lengths = edge_lengths(*cell.topology, cell.positions);
    const double mean =
        std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
    EXPECT_LT(mean, 0.95 * cell.reference.edge_lengths[0]);
    const DiscMeasures d = measures(cell);
    EXPECT_LT(d.centre_thickness, 0.5 * d.greatest_thickness);
    ShapeOptions options{.reference = ReferenceKind::uniform_length, .spring_length = 0.6};
    EXPECT_EQ(make_discocyte(2, options).reference.edge_lengths[7], 0.6);
}

TEST(Discocyte, TakesItsRestLengthsFromAGivenShape) {
    const auto sphere = meshing::icosphere(2, 1.0);
    ShapeOptions options{.reference = ReferenceKind::given};
    options.reference_shape = meshing::spheroid(sphere, 3.5, 3.5, 2.9).vertices;
    const Cell cell = make_discocyte(2, options);
    EXPECT_EQ(cell.reference.edge_lengths, edge_lengths(*cell.topology, options.reference_shape));
    options.reference_shape.pop_back();
    EXPECT_THROW(make_discocyte(2, options), InputError);
}

TEST(Cell, OfAnImportedShapeStartsAsItIs) {
    meshing::SurfaceMesh platelet = meshing::spheroid(meshing::icosphere(2, 1.0), 1.8, 1.8, 0.5);
    const auto before = platelet.vertices;
    meshing::translate(platelet, {1, 2, 3});
    ShapeOptions options;
    options.rest = {.area = meshing::area(platelet), .volume = meshing::volume(platelet)};
    const Cell cell = make_cell(platelet, options);
    for (std::size_t v = 0; v < before.size(); ++v) EXPECT_LT(norm(cell.positions[v] - before[v]), 1e-12);
    Batch batch(cell.topology, cell.parameters, cell.reference);
    batch.set_positions(0, cell.positions);
    batch.compute_forces();
    EXPECT_LT(batch.energies(0).shear + batch.energies(0).local_area + batch.energies(0).volume, 1e-12);
    options.reference = ReferenceKind::coarse_grained;
    EXPECT_EQ(make_cell(platelet, options).reference.edge_lengths[3],
              coarse_grained_length(162, options.rest.area));
}

TEST(ValidationDiscocyte, BothRoutesReachTheSpecifiedDiscAt2562Nodes) {
    const Cell disc = discocyte_by_both_routes(4);
    expect_disc(disc, {7.73, 0.89, 2.58});
    EXPECT_NEAR(disc.relaxation.energy / 3.187, 1, 0.5e-2);
}

TEST(ValidationDiscocyte, StressFreeDiscsAt2562Nodes) {
    expect_disc(cell_of(4, ReferenceKind::stress_free, Route::evans_fung), {7.95, 1.00, 2.38});
    expect_disc(cell_of(4, ReferenceKind::stress_free, Route::evans_fung, pre_stressed_parameters()),
                {7.83, 0.87, 2.49});
}

TEST(ValidationDiscocyte, UniformLengthOfThePreStressedCellIs285NanometresAt2562Nodes) {
    const Cell cell = cell_of(4, ReferenceKind::uniform_length, Route::evans_fung, pre_stressed_parameters());
    EXPECT_NEAR(cell.reference.edge_lengths[0], 0.285, 1e-3);
}

}  // namespace
}  // namespace hemoflux::membrane

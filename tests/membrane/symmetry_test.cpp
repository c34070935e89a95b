#include "membrane/symmetry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "exchange/error.hpp"
#include "membrane/diagnostics.hpp"
#include "membrane/shapes.hpp"
#include "tests/membrane/shapes_for_tests.hpp"

namespace hemoflux::membrane {
namespace {

std::size_t index(int v) { return static_cast<std::size_t>(v); }

Cell pre_stressed(int level, double camber = 0) {
    return make_discocyte(level, {.reference = ReferenceKind::uniform_length,
                                  .parameters = pre_stressed_parameters(),
                                  .camber = camber});
}

Batch batch_of(const Cell& cell) {
    Batch batch(cell.topology, cell.parameters, cell.reference);
    batch.set_positions(0, cell.positions);
    batch.compute_forces();
    return batch;
}

double largest_force(const Batch& batch) {
    double most = 0;
    for (const Vec3d& f : batch.forces(0)) most = std::max(most, norm(f));
    return most;
}

/// Largest distance between a vertex's image and the vertex it goes to, over all symmetries, um.
double asymmetry(const std::vector<Vec3d>& r, const std::vector<Symmetry>& symmetries) {
    double most = 0;
    for (const Symmetry& s : symmetries)
        for (std::size_t v = 0; v < r.size(); ++v)
            most = std::max(most, norm(s(r[v]) - r[index(s.image[v])]));
    return most;
}

double asymmetry(const Cell& cell, int level) {
    return asymmetry(cell.positions, symmetries(meshing::icosphere(level, 1.0)));
}

TEST(Symmetries, OfAnIcosphereAreAllSeven) {
    const meshing::SurfaceMesh sphere = meshing::icosphere(3, 2.0);
    const auto all = symmetries(sphere);
    ASSERT_EQ(all.size(), 7u);
    EXPECT_LT(asymmetry(sphere.vertices, all), 1e-12);
    for (const Symmetry& s : all) {
        EXPECT_LT(s.sign.x + s.sign.y + s.sign.z, 3);
        for (std::size_t v = 0; v < s.image.size(); ++v) EXPECT_EQ(index(s.image[index(s.image[v])]), v);
    }
}

TEST(Symmetries, OfAnEggAreThoseThatKeepItsEnds) {
    meshing::SurfaceMesh egg = meshing::icosphere(2, 1.0);
    for (Vec3d& r : egg.vertices) r.z += 0.2 * r.z * r.z;
    const auto all = symmetries(egg);
    EXPECT_EQ(all.size(), 3u);
    for (const Symmetry& s : all) EXPECT_EQ(s.sign.z, 1);
}

TEST(Symmetries, NoneWhereVerticesOrTrianglesHaveNoImage) {
    meshing::SurfaceMesh moved = meshing::icosphere(2, 1.0);
    moved.vertices[40] += {1e-6, 2e-6, 3e-6};
    EXPECT_TRUE(symmetries(moved).empty());

    // two triangles get the other diagonal: every vertex keeps its images, these two triangles have none
    meshing::SurfaceMesh turned = meshing::icosphere(2, 1.0);
    const Topology topology(turned);
    const Edge e = topology.edges()[100];
    turned.triangles[index(e.a)] = {e.v3, e.v4, e.v2};
    turned.triangles[index(e.b)] = {e.v4, e.v3, e.v1};
    EXPECT_NO_THROW(Topology{turned});
    EXPECT_TRUE(symmetries(turned).empty());
}

TEST(IsSymmetric, LooksAtEveryLengthAndArea) {
    const Topology topology(meshing::icosphere(2, 1.0));
    const auto spheroid = meshing::spheroid(meshing::icosphere(2, 1.0), 3, 2.5, 2);
    for (const Symmetry& s : symmetries(meshing::icosphere(2, 1.0))) {
        Reference r = reference_from_shape(topology, spheroid.vertices);
        EXPECT_TRUE(is_symmetric(topology, r, s));
        std::size_t e = 0;  // an edge that goes to another one
        while (s.image[index(topology.edges()[e].v1)] == topology.edges()[e].v1 ||
               s.image[index(topology.edges()[e].v1)] == topology.edges()[e].v2)
            ++e;
        r.edge_lengths[e] *= 1 + 1e-6;
        EXPECT_FALSE(is_symmetric(topology, r, s));
        r = reference_from_shape(topology, spheroid.vertices);
        r.triangle_areas[300] *= 1 + 1e-6;
        EXPECT_FALSE(is_symmetric(topology, r, s));
    }
}

TEST(RelaxSymmetric, RefusesSymmetriesOfAnotherMesh) {
    Batch batch = test::rough_batch(2);
    EXPECT_THROW(relax_symmetric(batch, symmetries(meshing::icosphere(1, 1.0))), InputError);
}

TEST(RelaxSymmetric, EndsInTheMinimumThatTheFreeRelaxationFinds) {
    const auto all = symmetries(meshing::icosphere(2, 1.0));
    Batch held = test::rough_batch(2), free = test::rough_batch(2);
    const RelaxResult result = relax_symmetric(held, all);
    EXPECT_NEAR(result.energy, relax(free).energy, 1e-6 * result.energy);
    EXPECT_LT(asymmetry(held.positions(0), all), 1e-12);
    held.compute_forces();
    EXPECT_LE(largest_force(held), 2e-5);
    EXPECT_DOUBLE_EQ(result.largest_force, largest_force(held));
}

TEST(RelaxSymmetric, LeavesAReferenceWithoutSymmetriesFree) {
    const auto topology = test::icosphere_topology(2);
    Batch held(topology, {}, reference_from_shape(*topology, test::rough_disc(2))),
        free(topology, {}, held.reference());
    for (Batch* b : {&held, &free}) b->set_positions(0, test::rough_disc(2));
    relax_symmetric(held, symmetries(meshing::icosphere(2, 1.0)));
    relax(free);
    for (std::size_t v = 0; v < free.vertices(); ++v)
        EXPECT_EQ(norm(held.positions(0)[v] - free.positions(0)[v]), 0);
}

/// Biconcave, symmetric, and at rest by the force of the membrane itself, though it is a saddle of the energy.
void expect_biconcave_disc_at_rest(int level) {
    const Cell cell = pre_stressed(level);
    const DiscMeasures d = disc_measures(cell.topology->triangles(), cell.positions);
    EXPECT_LT(d.centre_thickness, 0.3 * d.greatest_thickness);
    for (const ThicknessSample& s : thickness_profile(cell.topology->triangles(), cell.positions, 9, 36))
        EXPECT_TRUE(s.radius == 0 || s.radius > 2 || s.least > d.centre_thickness) << s.radius;
    EXPECT_LT(asymmetry(cell, level), 1e-12);
    const Batch batch = batch_of(cell);
    EXPECT_LE(largest_force(batch), 2e-5);
    EXPECT_NEAR(batch.energies(0).total(), cell.relaxation.energy, 1e-9);
}

TEST(PreStressedCell, IsABiconcaveDiscAtRest) { expect_biconcave_disc_at_rest(3); }

TEST(ValidationPreStressedCell, IsABiconcaveDiscAtRestAt2562Nodes) { expect_biconcave_disc_at_rest(4); }

/// However small the tolerance the relaxation stays at the disc, and the energy does not change to first order
/// along any displacement, those that break the symmetry among them.
TEST(PreStressedCell, DiscIsAnEquilibriumAgainstEveryDisplacement) {
    const Cell cell = make_discocyte(3, {.reference = ReferenceKind::uniform_length,
                                         .parameters = pre_stressed_parameters(),
                                         .relaxation = {.tolerance = 2e-7}});
    EXPECT_NEAR(cell.relaxation.energy, pre_stressed(3).relaxation.energy, 1e-4);
    Batch batch = batch_of(cell);
    EXPECT_LE(largest_force(batch), 2.1e-7);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int k = 0; k < 3; ++k) {
        constexpr double step = 1e-4;  // um
        double energy[2];
        std::vector<Vec3d> way;
        for (std::size_t v = 0; v < cell.positions.size(); ++v)
            way.push_back({uniform(random), uniform(random), uniform(random)});
        for (int side = 0; side < 2; ++side) {
            std::vector<Vec3d> r = cell.positions;
            for (std::size_t v = 0; v < r.size(); ++v) r[v] += (side == 0 ? -step : step) * way[v];
            batch.set_positions(0, r);
            batch.compute_forces();
            energy[side] = batch.energies(0).total();
        }
        EXPECT_NEAR((energy[1] - energy[0]) / (2 * step), 0, 1e-4);
    }
}

/// The free relaxation of a bent disc slides off the saddle to a cup of less energy; the symmetric one does not.
TEST(PreStressedCell, BentDiscBecomesACupUnlessHeld) {
    const Cell disc = pre_stressed(3);
    std::vector<Vec3d> bent = disc.positions;
    for (Vec3d& r : bent) r.z += 0.5 * (1 - (r.x * r.x + r.y * r.y) / 16);
    const auto all = symmetries(meshing::icosphere(3, 1.0));
    Batch free(disc.topology, disc.parameters, disc.reference),
        held(disc.topology, disc.parameters, disc.reference);
    for (Batch* b : {&free, &held}) b->set_positions(0, bent);
    EXPECT_LT(relax(free).energy, 0.98 * disc.relaxation.energy);
    EXPECT_GT(asymmetry(free.positions(0), all), 1);
    EXPECT_NEAR(relax_symmetric(held, all).energy, disc.relaxation.energy, 1e-4);
}

}  // namespace
}  // namespace hemoflux::membrane

#include "membrane/point_symmetry.hpp"

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

/// Largest distance of an image under the sign changes `image` from the nearest vertex, um.
double asymmetry(const std::vector<Vec3d>& r, const Vec3d& image) {
    double most = 0;
    for (const Vec3d& p : r) {
        const Vec3d q{image.x * p.x, image.y * p.y, image.z * p.z};
        double nearest = 1e9;
        for (const Vec3d& other : r) nearest = std::min(nearest, norm(other - q));
        most = std::max(most, nearest);
    }
    return most;
}

TEST(Antipodes, OfAnIcosphereWhereverItLies) {
    meshing::SurfaceMesh sphere = meshing::icosphere(3, 2.0);
    const auto r = sphere.vertices;
    meshing::translate(sphere, {3, -1, 2});
    const std::vector<int> antipode = antipodes(sphere);
    ASSERT_EQ(antipode.size(), r.size());
    for (std::size_t v = 0; v < r.size(); ++v) {
        EXPECT_LT(norm(r[v] + r[index(antipode[v])]), 1e-12);
        EXPECT_EQ(index(antipode[index(antipode[v])]), v);
    }
}

TEST(Antipodes, NoneWhereVerticesOrTrianglesHaveNoImage) {
    meshing::SurfaceMesh moved = meshing::icosphere(2, 1.0);
    moved.vertices[40].x += 1e-6;
    EXPECT_TRUE(antipodes(moved).empty());

    // the two triangles beside one edge get the other diagonal: all vertices have images, these two triangles not
    meshing::SurfaceMesh turned = meshing::icosphere(2, 1.0);
    const Topology topology(turned);
    const Edge e = topology.edges()[100];
    turned.triangles[index(e.a)] = {e.v3, e.v4, e.v2};
    turned.triangles[index(e.b)] = {e.v4, e.v3, e.v1};
    EXPECT_NO_THROW(Topology{turned});
    EXPECT_TRUE(antipodes(turned).empty());
}

TEST(PointSymmetric, LooksAtEveryLengthAndArea) {
    const meshing::SurfaceMesh sphere = meshing::icosphere(2, 1.0);
    const Topology topology(sphere);
    const auto antipode = antipodes(sphere);
    Reference r = reference_from_shape(topology, test::reference_spheroid(2).vertices);
    EXPECT_TRUE(point_symmetric(topology, antipode, r));
    r.edge_lengths[17] *= 1 + 1e-6;
    EXPECT_FALSE(point_symmetric(topology, antipode, r));
    r = reference_from_shape(topology, test::reference_spheroid(2).vertices);
    r.triangle_areas[300] *= 1 + 1e-6;
    EXPECT_FALSE(point_symmetric(topology, antipode, r));
    EXPECT_FALSE(point_symmetric(topology, antipode, reference_from_shape(topology, test::rough_disc(2))));
}

TEST(RelaxSymmetric, RefusesAntipodesOfAnotherMesh) {
    Batch batch = test::rough_batch(2);
    EXPECT_THROW(relax_symmetric(batch, antipodes(meshing::icosphere(1, 1.0))), InputError);
}

/// The disc is a minimum here, whichever way it is reached.
TEST(RelaxSymmetric, EndsInTheMinimumThatTheFreeRelaxationFinds) {
    Batch held = test::rough_batch(2), free = test::rough_batch(2);
    const RelaxResult result = relax_symmetric(held, antipodes(meshing::icosphere(2, 1.0)));
    EXPECT_NEAR(result.energy, relax(free).energy, 1e-6 * result.energy);
    held.compute_forces();
    EXPECT_LE(largest_force(held), 2e-5);
    EXPECT_DOUBLE_EQ(result.largest_force, largest_force(held));
}

/// Biconcave, symmetric, and at rest by the force of the membrane itself, though it is a saddle of the energy.
TEST(PreStressedCell, IsABiconcaveDiscAtRest) {
    const Cell cell = pre_stressed(3);
    const DiscMeasures d = disc_measures(cell.topology->triangles(), cell.positions);
    EXPECT_LT(d.centre_thickness, 0.5 * d.greatest_thickness);
    EXPECT_LT(asymmetry(cell.positions, {-1, -1, -1}), 1e-12);
    EXPECT_LT(asymmetry(cell.positions, {1, 1, -1}), 1e-4);
    EXPECT_LE(largest_force(batch_of(cell)), 2e-5);
    EXPECT_DOUBLE_EQ(batch_of(cell).energies(0).total(), cell.relaxation.energy);
}

/// With a smaller tolerance the whole force goes to zero, and the energy does not change to first order along
/// any displacement, those that break the symmetry among them.
TEST(PreStressedCell, DiscIsAnEquilibriumAgainstEveryDisplacement) {
    const Cell cell = make_discocyte(3, {.reference = ReferenceKind::uniform_length,
                                         .parameters = pre_stressed_parameters(),
                                         .relaxation = {.tolerance = 1e-8}});
    Batch batch = batch_of(cell);
    EXPECT_LE(largest_force(batch), 1.1e-8);
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
        EXPECT_NEAR((energy[1] - energy[0]) / (2 * step), 0, 1e-5);
    }
}

/// A start that is bent, however little, is let go.
TEST(PreStressedCell, BentStartFindsTheCupBelowTheDisc) {
    const Cell disc = pre_stressed(3), cup = pre_stressed(3, 0.05);
    EXPECT_LT(cup.relaxation.energy, 0.99 * disc.relaxation.energy);
    EXPECT_GT(asymmetry(cup.positions, {1, 1, -1}), 0.1);
}

TEST(PreStressedCell, IsNotHeldOnAMeshWithoutPairs) {
    meshing::SurfaceMesh sphere = meshing::icosphere(2, 1.0);
    sphere.vertices[40] += {0.01, 0, 0};
    const ShapeOptions options{.reference = ReferenceKind::uniform_length};
    const Cell cell = make_discocyte(sphere, options);
    EXPECT_LE(largest_force(batch_of(cell)), 2e-5);
}

TEST(ValidationPreStressedCell, IsABiconcaveDiscAt2562Nodes) {
    const Cell cell = pre_stressed(4);
    const DiscMeasures d = disc_measures(cell.topology->triangles(), cell.positions);
    EXPECT_LT(d.centre_thickness, 0.5 * d.greatest_thickness);
    EXPECT_LT(asymmetry(cell.positions, {1, 1, -1}), 1e-4);
    EXPECT_LE(largest_force(batch_of(cell)), 2e-5);
}

}  // namespace
}  // namespace hemoflux::membrane

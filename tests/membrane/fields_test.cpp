#include "membrane/fields.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "membrane/sheet.hpp"
#include "tests/membrane/shapes_for_tests.hpp"

namespace hemoflux::membrane {
namespace {

Batch deformed_sheet(InPlaneLaw law, double a, double b, double g) {
    Parameters p;
    p.network = {.shear = 0.6, .law = law, .skalak_ratio = 2};
    p.constraint.local_area = 3;
    Batch batch = flat_sheet(p, 2, 0.25);
    auto r = batch.positions(0);
    for (Vec3d& q : r) q = {a * q.x + g * q.y, b * q.y, 0};
    batch.set_positions(0, r);
    batch.compute_forces();
    return batch;
}

TEST(TriangleFields, PrincipalStretchesOfAnAffineMap) {
    // F = ((1.3, 0.4), (0, 0.8)): J = 1.04, I = 1.69 + 0.16 + 0.64
    const TriangleFields f = triangle_fields(deformed_sheet(InPlaneLaw::wlc, 1.3, 0.8, 0.4), 0);
    const double i = 2.49, j = 1.04, root = std::sqrt(i * i - 4 * j * j);
    for (std::size_t k = 0; k < f.major_stretch.size(); ++k) {
        EXPECT_NEAR(f.major_stretch[k], std::sqrt(0.5 * (i + root)), 1e-12);
        EXPECT_NEAR(f.minor_stretch[k], std::sqrt(0.5 * (i - root)), 1e-12);
        EXPECT_NEAR(f.area_strain[k], 0.04, 1e-12);
        EXPECT_NEAR(f.area_tension[k], 3 * 0.04, 1e-12);
    }
}

/// The tensions in the triangles are those of the nodal forces, T_ij = -sum F_i r_j / A, with every law.
TEST(TriangleFields, TensionsAgreeWithTheForces) {
    for (const InPlaneLaw law : {InPlaneLaw::wlc, InPlaneLaw::wlc_power, InPlaneLaw::wlc_hydrostatic,
                                 InPlaneLaw::neo_hookean, InPlaneLaw::skalak}) {
        const Batch batch = deformed_sheet(law, 1.3, 0.8, 0.4);
        const auto r = batch.positions(0), force = batch.forces(0);
        double xx = 0, yy = 0, xy = 0;
        for (std::size_t v = 0; v < r.size(); ++v) {
            xx -= force[v].x * r[v].x / batch.sums(0).area;
            yy -= force[v].y * r[v].y / batch.sums(0).area;
            xy -= force[v].x * r[v].y / batch.sums(0).area;
        }
        const double mean = 0.5 * (xx + yy), deviation = std::hypot(0.5 * (xx - yy), xy);
        const TriangleFields f = triangle_fields(batch, 0);
        for (std::size_t k = 0; k < f.major_tension.size(); ++k) {
            EXPECT_NEAR(f.major_tension[k] + f.area_tension[k], mean + deviation, 1e-12);
            EXPECT_NEAR(f.minor_tension[k] + f.area_tension[k], mean - deviation, 1e-12);
        }
    }
}

TEST(TriangleFields, LengthsThatMakeNoTriangleHaveNoStretch) {
    Batch batch = test::rough_batch(1);
    Reference reference = batch.reference();
    reference.edge_lengths[0] *= 4;
    batch.set_reference(reference);
    const TriangleFields f = triangle_fields(batch, 0);
    EXPECT_EQ(f.major_stretch[static_cast<std::size_t>(batch.topology().edges()[0].a)], 0);
}

TEST(VertexFields, CurvatureOfASphereAndItsEnergy) {
    const auto sphere = meshing::icosphere(4, 2.0);
    const auto topology = std::make_shared<const Topology>(sphere);
    Parameters parameters;
    Reference reference = reference_from_shape(*topology, sphere.vertices, {.reduced_curvature = 0});
    Batch batch(topology, parameters, reference);
    auto larger = sphere.vertices;
    for (Vec3d& r : larger) r = 1.1 * r;
    batch.set_positions(0, larger);
    batch.compute_forces();
    const VertexFields f = vertex_fields(batch, 0);
    double mean = 0, energy = 0;
    const auto areas = triangle_areas(*topology, larger);
    std::vector<double> node(larger.size(), 0.0);
    for (std::size_t k = 0; k < areas.size(); ++k)
        for (const int v : topology->triangles()[k]) node[static_cast<std::size_t>(v)] += areas[k] / 3;
    for (std::size_t v = 0; v < node.size(); ++v) {
        mean += f.curvature[v] / static_cast<double>(node.size());
        energy += 0.5 * parameters.bending.local * node[v] * f.curvature[v] * f.curvature[v];
        EXPECT_NEAR(f.area_strain[v], 0.21, 1e-12);
    }
    EXPECT_NEAR(mean, 2 / 2.2, 2e-3);
    EXPECT_NEAR(energy, batch.energies(0).bending, 1e-12);
}

}  // namespace
}  // namespace hemoflux::membrane

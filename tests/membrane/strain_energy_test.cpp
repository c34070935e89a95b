#include "membrane/strain_energy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "exchange/error.hpp"
#include "membrane/sheet.hpp"
#include "tests/membrane/shapes_for_tests.hpp"

namespace hemoflux::membrane {
namespace {

Parameters continuum(InPlaneLaw law, double ratio = 1) {
    Parameters p;
    p.network = {.shear = 0.6, .law = law, .skalak_ratio = ratio};
    p.constraint.local_area = 0;
    return p;
}

/// Mean Cauchy tensions of a patch under the map (x, y) -> (a x + g y, b y), from its nodal forces alone:
/// T_ij = -sum F_i r_j / A.
struct Tensions {
    double xx, yy, xy;
    double area, energy;
};

Tensions response(const Parameters& parameters, double a, double b, double g = 0) {
    Batch batch = flat_sheet(parameters, 3, 0.25);
    auto r = batch.positions(0);
    for (Vec3d& p : r) p = {a * p.x + g * p.y, b * p.y, 0};
    batch.set_positions(0, r);
    batch.compute_forces();
    const auto f = batch.forces(0);
    Tensions t{0, 0, 0, batch.sums(0).area, batch.energies(0).total()};
    for (std::size_t v = 0; v < r.size(); ++v) {
        t.xx -= f[v].x * r[v].x / t.area;
        t.yy -= f[v].y * r[v].y / t.area;
        t.xy -= f[v].x * r[v].y / t.area;
    }
    return t;
}

TEST(NeoHookean, UniaxialTensionInClosedForm) {
    const Parameters p = continuum(InPlaneLaw::neo_hookean);
    for (const double stretch : {0.7, 1.0, 1.2, 2.0, 3.0}) {
        // l_2 = l_1^{-1/2}, T_1 = G (l^{3/2} - l^{-3/2})
        const Tensions t = response(p, stretch, 1 / std::sqrt(stretch));
        EXPECT_NEAR(t.xx, 0.6 * (std::pow(stretch, 1.5) - std::pow(stretch, -1.5)), 1e-12) << stretch;
        EXPECT_NEAR(t.yy, 0, 1e-12) << stretch;
        EXPECT_NEAR(t.xy, 0, 1e-12) << stretch;
    }
}

TEST(NeoHookean, SimpleShearInClosedForm) {
    const Parameters p = continuum(InPlaneLaw::neo_hookean);
    for (const double g : {0.1, 0.5, 1.5}) {
        // J = 1, B = F F^T: T = G (B - 1)
        const Tensions t = response(p, 1, 1, g);
        EXPECT_NEAR(t.xy, 0.6 * g, 1e-12);
        EXPECT_NEAR(t.xx, 0.6 * g * g, 1e-12);
        EXPECT_NEAR(t.yy, 0, 1e-12);
        EXPECT_NEAR(t.energy / t.area, 0.3 * g * g, 1e-12);
    }
}

TEST(Skalak, UniaxialTensionInClosedForm) {
    for (const double c : {0.5, 1.0, 10.0})
        for (const double stretch : {0.8, 1.3, 1.8}) {
            // T_2 = 0: l_2^2 = (1 + C l_1^2)/(1 + C l_1^4);  T_1 = G l_1/l_2 [l_1^2 - 1 + C l_2^2 (J^2 - 1)]
            const double s2 = stretch * stretch, lateral2 = (1 + c * s2) / (1 + c * s2 * s2);
            const Tensions t = response(continuum(InPlaneLaw::skalak, c), stretch, std::sqrt(lateral2));
            const double expected =
                0.6 * stretch / std::sqrt(lateral2) * (s2 - 1 + c * lateral2 * (s2 * lateral2 - 1));
            EXPECT_NEAR(t.yy, 0, 1e-12 * c) << c << " " << stretch;
            EXPECT_NEAR(t.xx, expected, 1e-12 * (1 + c)) << c << " " << stretch;
        }
}

TEST(Skalak, SimpleShearInClosedForm) {
    for (const double g : {0.1, 0.5, 1.5}) {
        // J = 1: T = G [(I - 1) B - 1], I = 2 + g^2, whatever C
        const Tensions t = response(continuum(InPlaneLaw::skalak, 7), 1, 1, g);
        EXPECT_NEAR(t.xy, 0.6 * (1 + g * g) * g, 1e-11);
        EXPECT_NEAR(t.xx, 0.6 * ((1 + g * g) * (1 + g * g) - 1), 1e-11);
        EXPECT_NEAR(t.yy, 0.6 * g * g, 1e-11);
    }
}

/// A sphere blown up by l in radius: T = G (1 - l^-6), and T = G (l^2 - 1)(1 + C l^2 (l^2 + 1)); here from the
/// nodal forces, 2 T A = -sum F.r.
TEST(ContinuumLaws, InflationOfASphereInClosedForm) {
    const auto sphere = meshing::icosphere(2, 2.0).vertices;
    const auto topology = test::icosphere_topology(2);
    for (const InPlaneLaw law : {InPlaneLaw::neo_hookean, InPlaneLaw::skalak})
        for (const double l : {0.9, 1.1, 1.5}) {
            Parameters p = continuum(law, 3);
            p.constraint = {.volume = 0, .area = 0, .local_area = 0};
            p.bending = {.local = 0, .area_difference = 0};
            Batch batch(topology, p, reference_from_shape(*topology, sphere));
            auto r = sphere;
            for (Vec3d& q : r) q = l * q;
            batch.set_positions(0, r);
            batch.compute_forces();
            double sum = 0;
            for (std::size_t v = 0; v < r.size(); ++v) sum -= dot(batch.forces(0)[v], r[v]);
            const double expected = law == InPlaneLaw::neo_hookean
                                        ? 0.6 * (1 - std::pow(l, -6))
                                        : 0.6 * (l * l - 1) * (1 + 3 * l * l * (l * l + 1));
            EXPECT_NEAR(sum / (2 * batch.sums(0).area), expected, 1e-11) << l;
        }
}

/// The law sees the rest triangle and no more: a patch of irregular triangles under an affine map has the same
/// energy per rest area as the regular one.
TEST(ContinuumLaws, DoNotDependOnTheShapeOfTheTriangles) {
    for (const InPlaneLaw law : {InPlaneLaw::neo_hookean, InPlaneLaw::skalak}) {
        const Parameters p = continuum(law);
        Batch regular = flat_sheet(p, 4, 0.25);
        auto rest = regular.positions(0);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> shift(-0.04, 0.04);
        for (Vec3d& r : rest) r += Vec3d{shift(random), shift(random), 0};
        Reference reference = regular.reference();
        reference.edge_lengths = edge_lengths(regular.topology(), rest);
        reference.triangle_areas = triangle_areas(regular.topology(), rest);
        Batch irregular(regular.shared_topology(), regular.parameters(), reference);
        double area = 0;
        for (const double a : reference.triangle_areas) area += a;
        for (Vec3d& r : rest) r = {1.3 * r.x + 0.4 * r.y, 0.9 * r.y, 0};
        irregular.set_positions(0, rest);
        irregular.compute_forces();
        const Tensions t = response(p, 1.3, 0.9, 0.4);
        EXPECT_NEAR(irregular.energies(0).total() / area, t.energy / t.area * 1.3 * 0.9, 1e-12);
    }
}

TEST(ContinuumLaws, RefuseReferenceLengthsThatMakeNoTriangle) {
    const auto topology = test::icosphere_topology(1);
    Reference reference = reference_from_shape(*topology, meshing::icosphere(1, 1.0).vertices);
    reference.edge_lengths[5] *= 3;
    Parameters parameters;
    EXPECT_NO_THROW(Batch(topology, parameters, reference));
    parameters.network.law = InPlaneLaw::skalak;
    try {
        Batch(topology, parameters, reference);
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("make no triangle"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace hemoflux::membrane

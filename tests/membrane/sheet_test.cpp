#include "membrane/sheet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "exchange/error.hpp"
#include "tests/membrane/shapes_for_tests.hpp"

namespace hemoflux::membrane {
namespace {

Parameters sheet_of(InPlaneLaw law, double shear, double local_area, double ratio = 1) {
    Parameters p;
    p.network = {.shear = shear, .law = law, .skalak_ratio = ratio};
    p.constraint.local_area = local_area;
    return p;
}

struct LawCase {
    const char* name;
    InPlaneLaw law;
    double ratio, area_over_shear, young_over_shear;
};

class FlatSheet : public ::testing::TestWithParam<LawCase> {};

/// The moduli put in come out, whatever the size of the mesh and the stretch ratio, and with K_A,k added.
TEST_P(FlatSheet, HasTheModuliOfItsLaw) {
    const LawCase& c = GetParam();
    for (const double shear : {0.4, 0.61})
        for (const double edge : {0.1, 0.25, 0.5})
            for (const double r : {1.8, 2.6, 3.2}) {
                const SheetModuli m = measured_moduli(sheet_of(c.law, shear, 0, c.ratio), 2, edge, r);
                EXPECT_NEAR(m.shear / shear, 1, 1e-4) << edge << " " << r;
                EXPECT_NEAR(m.area / shear, c.area_over_shear, 1e-4 * c.area_over_shear) << edge << " " << r;
                EXPECT_NEAR(m.young / shear, c.young_over_shear, 1e-4 * c.young_over_shear);
            }
    const Parameters stiffened = sheet_of(c.law, 0.4, 10, c.ratio);
    const SheetModuli expected = sheet_moduli(stiffened), found = measured_moduli(stiffened);
    EXPECT_NEAR(expected.area, c.area_over_shear * 0.4 + 10, 1e-12);
    EXPECT_NEAR(found.shear, expected.shear, 1e-4 * expected.shear);
    EXPECT_NEAR(found.area, expected.area, 1e-4 * expected.area);
    EXPECT_NEAR(found.young, expected.young, 1e-4 * expected.young);
    EXPECT_NEAR(found.poisson, expected.poisson, 1e-4);
    RecordProperty("shear_error", std::to_string(1e6 * (found.shear / expected.shear - 1)) + "e-6");
}

TEST_P(FlatSheet, AtRestBearsNoForceAndNoEnergy) {
    const LawCase& c = GetParam();
    Batch batch = flat_sheet(sheet_of(c.law, 0.4, 10, c.ratio), 3, 0.25);
    batch.compute_forces();
    EXPECT_NEAR(batch.energies(0).total(), 0, 1e-14);
    for (const Vec3d& f : batch.forces(0)) EXPECT_LT(norm(f), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Membrane, FlatSheet,
                         ::testing::Values(LawCase{"wlc", InPlaneLaw::wlc, 1, 2, 8.0 / 3},
                                           LawCase{"wlc_power", InPlaneLaw::wlc_power, 1, 2, 8.0 / 3},
                                           LawCase{"wlc_hydrostatic", InPlaneLaw::wlc_hydrostatic, 1, 2,
                                                   8.0 / 3},
                                           LawCase{"neo_hookean", InPlaneLaw::neo_hookean, 1, 3, 3},
                                           LawCase{"skalak", InPlaneLaw::skalak, 1, 3, 3},
                                           LawCase{"stiff_skalak", InPlaneLaw::skalak, 10, 21, 42.0 / 11}),
                         [](const auto& test_info) { return std::string(test_info.param.name); });

TEST(FlatPillow, IsAClosedSurfaceOfEqualTriangles) {
    const auto mesh = flat_pillow(3, 0.5);
    const Topology topology(mesh);
    EXPECT_EQ(topology.triangles().size(), 2u * 6 * 9);
    EXPECT_EQ(topology.vertices(), 2u * 37 - 18);
    for (const double length : edge_lengths(topology, mesh.vertices)) EXPECT_NEAR(length, 0.5, 1e-14);
    EXPECT_THROW(flat_pillow(0, 1), InputError);
}

}  // namespace
}  // namespace hemoflux::membrane

#include "membrane/forces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "membrane/wlc.hpp"
#include "tests/membrane/shapes_for_tests.hpp"

namespace hemoflux::membrane {
namespace {

/// All moduli zero but those of one term.
Parameters only(const std::string& term) {
    const Parameters full;
    Parameters p;
    p.constraint = {.volume = 0, .area = 0, .local_area = 0};
    p.bending = {.local = 0, .area_difference = 0};
    p.network = {.shear = 0, .viscosity = 0};
    if (term == "volume") p.constraint.volume = full.constraint.volume;
    if (term == "area") p.constraint.area = full.constraint.area;
    if (term == "local_area") p.constraint.local_area = full.constraint.local_area;
    if (term == "bending") p.bending.local = full.bending.local;
    if (term == "area_difference") p.bending.area_difference = full.bending.area_difference;
    if (term == "shear") p.network.shear = full.network.shear;
    const std::map<std::string, InPlaneLaw> laws{{"wlc_power", InPlaneLaw::wlc_power},
                                                 {"wlc_hydrostatic", InPlaneLaw::wlc_hydrostatic},
                                                 {"neo_hookean", InPlaneLaw::neo_hookean},
                                                 {"skalak", InPlaneLaw::skalak}};
    if (laws.contains(term))
        p.network = {.shear = full.network.shear, .law = laws.at(term), .skalak_ratio = 3};
    if (term == "gompper_kroll")
        p.bending = {
            .local = full.bending.local, .area_difference = 0.04, .scheme = BendingScheme::gompper_kroll};
    if (term == "all") return full;
    return p;
}

double largest(const std::vector<Vec3d>& forces) {
    double most = 0;
    for (const Vec3d& f : forces) most = std::max(most, norm(f));
    return most;
}

class ForceOfTerm : public ::testing::TestWithParam<std::string> {};

/// Fourth-order central differences of the total energy, every component of every vertex.
TEST_P(ForceOfTerm, IsMinusTheGradientOfTheEnergy) {
    Batch batch = test::rough_batch(2);
    batch.set_parameters(only(GetParam()));
    const auto rest = batch.positions(0);
    batch.compute_forces();
    auto forces = batch.forces(0);
    const double scale = largest(forces), h = 2e-4;
    ASSERT_GT(scale, 1e-6);
    double worst = 0;
    auto moved = rest;
    const auto energy_at = [&](std::size_t v, std::size_t axis, double shift) {
        moved[v] = rest[v];
        component(moved[v], axis) += shift;
        batch.set_positions(0, moved);
        batch.compute_forces();
        moved[v] = rest[v];
        return batch.energies(0).total();
    };
    for (std::size_t v = 0; v < rest.size(); ++v)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double near = energy_at(v, axis, h) - energy_at(v, axis, -h);
            const double far = energy_at(v, axis, 2 * h) - energy_at(v, axis, -2 * h);
            const double slope = (8 * near - far) / (12 * h);
            worst = std::max(worst, std::fabs(component(forces[v], axis) + slope));
        }
    RecordProperty("largest_error", std::to_string(worst / scale * 1e9) + "e-9");
    EXPECT_LT(worst, 1e-7 * scale);
}

TEST_P(ForceOfTerm, HasNoNetForceAndNoTorque) {
    Batch batch = test::rough_batch(3);
    batch.set_parameters(only(GetParam()));
    batch.compute_forces();
    const auto r = batch.positions(0), f = batch.forces(0);
    Vec3d net{0, 0, 0}, torque{0, 0, 0};
    double sum = 0;
    for (std::size_t v = 0; v < r.size(); ++v) {
        net += f[v];
        torque += cross(r[v], f[v]);
        sum += norm(f[v]);
    }
    EXPECT_LT(norm(net), 1e-12 * sum);
    EXPECT_LT(norm(torque), 1e-12 * sum);
}

INSTANTIATE_TEST_SUITE_P(Membrane, ForceOfTerm,
                         ::testing::Values("volume", "area", "local_area", "bending", "area_difference",
                                           "shear", "wlc_power", "wlc_hydrostatic", "neo_hookean", "skalak",
                                           "gompper_kroll", "all"),
                         [](const auto& test_info) { return test_info.param; });

TEST(Forces, RoughShapeHasConcaveEdgesAndRingsOfEveryDegree) {
    Batch batch = test::rough_batch(2);
    const auto r = batch.positions(0);
    std::size_t concave = 0;
    for (const Edge& e : batch.topology().edges()) {
        const auto at = [&r](int v) { return r[static_cast<std::size_t>(v)]; };
        const Vec3d xi = cross(at(e.v2) - at(e.v1), at(e.v3) - at(e.v1));
        concave += dot(at(e.v4) - at(e.v1), xi) > 0;
    }
    EXPECT_GT(concave, batch.topology().edges().size() / 10);
}

/// Energies against a direct sum over triangles, edges and vertices with the standard functions.
TEST(Forces, EnergiesAgreeWithDirectSums) {
    Batch batch = test::rough_batch(3);
    batch.compute_forces();
    const Topology& t = batch.topology();
    const Reference& ref = batch.reference();
    const Parameters& p = batch.parameters();
    const auto r = batch.positions(0);
    const auto at = [&r](int v) { return r[static_cast<std::size_t>(v)]; };
    const auto areas = triangle_areas(t, r), lengths = edge_lengths(t, r);
    double volume = 0, area = 0, local = 0, shear = 0, total_curvature = 0, bending = 0;
    std::vector<double> s(t.vertices(), 0.0), a(t.vertices(), 0.0);
    for (std::size_t k = 0; k < areas.size(); ++k) {
        const auto& c = t.triangles()[k];
        volume += dot(at(c[0]), cross(at(c[1]), at(c[2]))) / 6;
        area += areas[k];
        local += 0.5 * p.constraint.local_area * std::pow(areas[k] - ref.triangle_areas[k], 2) /
                 ref.triangle_areas[k];
        for (int v : c) a[static_cast<std::size_t>(v)] += areas[k] / 3;
    }
    for (std::size_t k = 0; k < lengths.size(); ++k) {
        const Edge& e = t.edges()[k];
        const Vec3d along = at(e.v2) - at(e.v1);
        const Vec3d xi_a = cross(along, at(e.v3) - at(e.v1)), xi_b = cross(at(e.v4) - at(e.v1), along);
        const double theta = std::atan2(dot(cross(xi_a, xi_b), along) / lengths[k], dot(xi_a, xi_b));
        total_curvature += theta * lengths[k];
        for (int v : {e.v1, e.v2}) s[static_cast<std::size_t>(v)] += 0.5 * theta * lengths[k];
        const double contour = ref.stretch_ratio * ref.edge_lengths[k], l = lengths[k] / contour;
        shear += WormLikeChain(p.network.shear, ref.stretch_ratio).energy(l, 1 / (1 - l), contour);
    }
    for (std::size_t v = 0; v < a.size(); ++v)
        bending += 0.5 * p.bending.local * a[v] * std::pow(s[v] / a[v] - ref.curvature, 2);
    const Energies e = batch.energies(0);
    EXPECT_NEAR(batch.sums(0).volume, volume, 1e-12 * volume);
    EXPECT_NEAR(batch.sums(0).area, area, 1e-12 * area);
    EXPECT_NEAR(batch.sums(0).total_curvature, total_curvature, 1e-12 * std::fabs(total_curvature));
    EXPECT_NEAR(e.volume, 0.5 * p.constraint.volume * std::pow(volume - ref.volume, 2) / ref.volume,
                1e-9 * e.volume);
    EXPECT_NEAR(e.area, 0.5 * p.constraint.area * std::pow(area - ref.area, 2) / ref.area, 1e-9 * e.area);
    EXPECT_NEAR(e.local_area, local, 1e-12 * local);
    EXPECT_NEAR(e.bending, bending, 1e-12 * bending);
    EXPECT_NEAR(e.area_difference,
                p.bending.area_difference * std::pow(total_curvature - ref.total_curvature, 2) / ref.area,
                1e-9 * e.area_difference);
    EXPECT_NEAR(e.shear, shear, 1e-12 * shear);
}

TEST(Forces, DoNotChangeWithThePlaceOfTheCell) {
    Batch batch = test::rough_batch(3);
    batch.compute_forces();
    const auto here = batch.forces(0);
    auto r = batch.positions(0);
    for (Vec3d& p : r) p += Vec3d{8, 16, -4};
    batch.set_positions(0, r);
    batch.compute_forces();
    const auto there = batch.forces(0);
    for (std::size_t v = 0; v < here.size(); ++v) EXPECT_LT(norm(here[v] - there[v]), 1e-10 * largest(here));
}

}  // namespace
}  // namespace hemoflux::membrane

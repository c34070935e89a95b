#include "membrane/diagnostics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "exchange/error.hpp"
#include "meshing/evans_fung.hpp"
#include "meshing/icosphere.hpp"
#include "meshing/spheroid.hpp"

namespace hemoflux::membrane {
namespace {

constexpr double pi = std::numbers::pi;

/// A closed box of the given sides with one corner at the origin.
meshing::SurfaceMesh box(double a, double b, double c) {
    meshing::SurfaceMesh mesh;
    for (int i = 0; i < 8; ++i) mesh.vertices.push_back({i & 1 ? a : 0, i & 2 ? b : 0, i & 4 ? c : 0});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

/// The mesh turned by an angle (radians) about z, then moved.
meshing::SurfaceMesh turned(meshing::SurfaceMesh mesh, double angle, const Vec3d& shift = {0, 0, 0}) {
    for (Vec3d& r : mesh.vertices)
        r = Vec3d{std::cos(angle) * r.x - std::sin(angle) * r.y,
                  std::sin(angle) * r.x + std::cos(angle) * r.y, r.z} +
            shift;
    return mesh;
}

ShapeMoments moments(const meshing::SurfaceMesh& mesh) {
    return shape_moments(mesh.triangles, mesh.vertices);
}

TEST(ShapeMoments, OfABoxAreExact) {
    const double a = 4, b = 2, c = 1, faces = a * b + b * c + c * a;
    const ShapeMoments s = moments(turned(box(a, b, c), 0.3, {10, -7, 3}));
    EXPECT_NEAR(s.volume, a * b * c, 1e-12);
    EXPECT_NEAR(s.area, 2 * faces, 1e-12);
    EXPECT_NEAR(s.centroid.z, 3.5, 1e-12);
    EXPECT_NEAR(s.centroid.x, 10 + std::cos(0.3) * 2 - std::sin(0.3), 1e-12);
    // Two faces at +-a/2, four that extend evenly over a.
    EXPECT_NEAR(s.moments[0], a * a * (b * c / 4 + (a * b + a * c) / 12) / faces, 1e-12);
    EXPECT_NEAR(s.moments[1], b * b * (a * c / 4 + (a * b + b * c) / 12) / faces, 1e-12);
    EXPECT_NEAR(s.moments[2], c * c * (a * b / 4 + (a * c + b * c) / 12) / faces, 1e-12);
    EXPECT_NEAR(std::fabs(s.axes[0].x), std::cos(0.3), 1e-12);
    EXPECT_NEAR(std::fabs(s.axes[2].z), 1, 1e-12);
    EXPECT_NEAR(s.volume_moments[0], a * a / 12, 1e-12);
    EXPECT_NEAR(s.volume_moments[1], b * b / 12, 1e-12);
    EXPECT_NEAR(s.volume_moments[2], c * c / 12, 1e-12);
}

TEST(ShapeMoments, ReducedVolumeOfTheSphereIsOne) {
    EXPECT_NEAR(moments(meshing::icosphere(5, 2.0)).reduced_volume, 1, 1e-3);
}

TEST(EllipsoidMoments, SphereAndFlatDiscInClosedForm) {
    for (double m : ellipsoid_moments({2, 2, 2})) EXPECT_NEAR(m, 4.0 / 3, 1e-12);
    const auto disc = ellipsoid_moments({2, 2, 1e-9});  // two flat discs: R^2/4
    EXPECT_NEAR(disc[0], 1, 1e-6);
    EXPECT_NEAR(disc[1], 1, 1e-6);
}

TEST(EllipsoidMoments, HalfAxesAreRecovered) {
    for (const std::array<double, 3>& axes :
         {std::array<double, 3>{1, 1, 1}, {3, 2, 1}, {4, 4, 1.3}, {7, 2, 1.9}, {5, 4.9, 0.5}}) {
        const auto found = ellipsoid_half_axes(ellipsoid_moments(axes));
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], axes[i], 1e-11 * axes[0]);
    }
}

TEST(EllipsoidMoments, HalfAxesOfATriangulatedEllipsoid) {
    const auto s = moments(meshing::spheroid(meshing::icosphere(5, 1.0), 3, 2, 1.5));
    const auto axes = ellipsoid_half_axes(s.moments);
    EXPECT_NEAR(axes[0], 3, 3e-3);
    EXPECT_NEAR(axes[1], 2, 3e-3);
    EXPECT_NEAR(axes[2], 1.5, 3e-3);
    EXPECT_NEAR(taylor_deformation(s), 1.0 / 3, 1e-3);
    const auto inertia = inertia_half_axes(s);
    EXPECT_NEAR(inertia[0], 3, 3e-3);
    EXPECT_NEAR(inertia[1], 2, 3e-3);
    EXPECT_NEAR(inertia[2], 1.5, 3e-3);
}

TEST(TaylorDeformation, ItsThreeMeasuresAgreeOnAnEllipsoidAnywhere) {
    const auto mesh = turned(meshing::spheroid(meshing::icosphere(5, 1.0), 3, 2, 1.5), 0.7, {40, -9, 2});
    const auto s = moments(mesh);
    EXPECT_NEAR(taylor_deformation_volume(s), 1.0 / 3, 1e-3);
    EXPECT_NEAR(taylor_deformation_extent(mesh.vertices, s.centroid), 1.0 / 3, 1e-3);
    const auto sphere = meshing::icosphere(3, 2.0);
    EXPECT_NEAR(taylor_deformation_volume(moments(sphere)), 0, 1e-12);
    EXPECT_NEAR(taylor_deformation_extent(sphere.vertices, {0, 0, 0}), 0, 1e-12);
}

TEST(TaylorDeformation, DrawnOutEndsCountMostInTheDistancesAndLeastInTheVolume) {
    auto mesh = meshing::icosphere(5, 1.0);
    for (Vec3d& r : mesh.vertices) r.x *= 1 + 0.6 * r.x * r.x * r.x * r.x;
    const auto s = moments(mesh);
    const double extent = taylor_deformation_extent(mesh.vertices, s.centroid);
    EXPECT_NEAR(extent, 0.6 / 2.6, 2e-3);
    EXPECT_GT(extent, taylor_deformation(s) + 0.01);
    EXPECT_GT(taylor_deformation(s), taylor_deformation_volume(s) + 0.01);
}

TEST(Inclination, FollowsTheLongAxis) {
    const auto ellipsoid = meshing::spheroid(meshing::icosphere(3, 1.0), 3, 1, 2);
    for (double degrees : {-89.0, -60.0, -0.5, 0.0, 19.5, 45.0, 89.0})
        EXPECT_NEAR(inclination(moments(turned(ellipsoid, degrees * pi / 180, {6, 6, 6}))), degrees, 1e-9);
    EXPECT_NEAR(inclination(moments(turned(ellipsoid, 100 * pi / 180))), -80, 1e-9);
    EXPECT_NEAR(std::fabs(inclination(moments(turned(ellipsoid, pi / 2)))), 90, 1e-9);
}

TEST(Inclination, OfADiscSeenEdgeOnIsThatOfItsPlane) {
    for (double along_z : {2.9999, 3.0, 3.0001}) {
        const auto disc = meshing::spheroid(meshing::icosphere(3, 1.0), 3, 1, along_z);
        EXPECT_NEAR(inclination(moments(turned(disc, 0.4))), 0.4 * 180 / pi, 1e-6) << along_z;
    }
}

TEST(TankTreading, AngleAboutTheCentroid) {
    EXPECT_DOUBLE_EQ(angle_about({6, 7, 1}, {6, 6, 6}), pi / 2);
    EXPECT_DOUBLE_EQ(angle_about({5, 5, 1}, {6, 6, 6}), -3 * pi / 4);
}

/// A spheroid whose vertices have rolled by an angle (rad, against the clock) along its outline, then bent into a
/// banana, turned about z as a whole, and moved.
std::vector<Vec3d> rolled(double roll, double bend, double turn, const std::vector<Vec3d>& sphere) {
    std::vector<Vec3d> at;
    for (const Vec3d& r : sphere) {
        const double c = std::cos(roll), s = std::sin(roll);
        const double x = 4 * (c * r.x - s * r.y), y = s * r.x + c * r.y + bend * x * x;
        at.push_back(
            {std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y, 2 * r.z});
    }
    return at;
}

std::vector<double> labels_of(const std::vector<Vec3d>& sphere) {
    std::vector<double> labels;
    for (const Vec3d& r : sphere) labels.push_back(angle_about(r, {0, 0, 0}));
    return labels;
}

TEST(TankTreading, TurnsWithTheCellAndRollsWithTheMembrane) {
    const auto sphere = meshing::icosphere(3, 1.0).vertices;
    const auto labels = labels_of(sphere);
    for (const double turn : {0.0, 0.3, -1.2})
        for (const double roll : {0.0, 0.2, 1.0, -2.0, 3.0}) {
            const auto at = rolled(roll, 0, turn, sphere);
            const double expected = std::remainder(turn + roll, 2 * pi);
            EXPECT_NEAR(std::remainder(membrane_turn(at, labels, {0, 0, 0}, turn) - expected, 2 * pi), 0,
                        0.03);
            EXPECT_NEAR(std::remainder(membrane_turn(at, labels, {0, 0, 0}, turn + pi) - expected, 2 * pi), 0,
                        0.03);
        }
}

// A point of a folded cell does not go round the centroid, which lies outside.
TEST(TankTreading, CountsTheTurnsOfACellFoldedOverItsCentroid) {
    const auto mesh = meshing::icosphere(3, 1.0);
    const auto labels = labels_of(mesh.vertices);
    const double inclination_rad = 0.3;
    double turned = 0, angle = 0;
    for (int step = 0; step <= 100; ++step) {
        auto now = mesh;
        now.vertices = rolled(-2 * pi * step / 100, 0.25, inclination_rad, mesh.vertices);
        const Vec3d centroid = moments(now).centroid;
        const double turn = membrane_turn(now.vertices, labels, centroid, inclination_rad);
        const double of_point = angle_about(now.vertices[0], centroid);
        if (step == 0) turned = turn, angle = of_point;
        turned += std::remainder(turn - turned, 2 * pi);
        angle += std::remainder(of_point - angle, 2 * pi);
    }
    EXPECT_NEAR(turned, inclination_rad - 2 * pi, 0.05);
    EXPECT_GT(angle, -pi);
}

TEST(Diameters, AreTwiceTheGreatestDistances) {
    const Diameters d = stretch_diameters({{4, 1, 1}, {-2, 1, 1}, {1, 3, 1}, {1, 1, -2}}, {1, 1, 1});
    EXPECT_DOUBLE_EQ(d.axial, 6);
    EXPECT_DOUBLE_EQ(d.transverse, 6);
}

TEST(DiscMeasures, OfTheEvansFungDiscInAnyOrientation) {
    meshing::SurfaceMesh mesh = meshing::evans_fung(meshing::icosphere(5, 1.0));
    double greatest = 0;
    for (int i = 0; i < 1000; ++i) greatest = std::max(greatest, meshing::evans_fung_thickness(0.00391 * i));
    for (Vec3d& r : mesh.vertices) r = {r.z + 3, 0.6 * r.x - 0.8 * r.y, 0.8 * r.x + 0.6 * r.y};
    const DiscMeasures d = disc_measures(mesh.triangles, mesh.vertices);
    EXPECT_NEAR(d.diameter, 7.82, 5e-3);
    EXPECT_NEAR(d.centre_thickness, meshing::evans_fung_thickness(0), 5e-3);
    EXPECT_NEAR(d.greatest_thickness, greatest, 5e-3);
}

TEST(MinimumRectangle, OfATurnedBoxIsTheBox) {
    for (const double degrees : {-80.0, -30.0, 0.0, 12.0, 45.0, 89.0}) {
        const auto r = minimum_rectangle(turned(box(4, 1, 2), degrees * pi / 180, {3, -8, 0}).vertices);
        EXPECT_NEAR(r.length, 4, 1e-12);
        EXPECT_NEAR(r.width, 1, 1e-12);
        EXPECT_NEAR(r.angle_deg, degrees, 1e-9);
        EXPECT_NEAR(r.deformation_index(), 0.6, 1e-12);
    }
    EXPECT_THROW(minimum_rectangle({{0, 0, 0}, {1, 1, 5}, {2, 2, 1}}), InputError);
}

TEST(ShadowEllipse, OfATurnedBoxHasItsMoments) {
    for (const double degrees : {-80.0, 0.0, 12.0, 45.0}) {
        const auto e = shadow_ellipse(turned(box(4, 1, 2), degrees * pi / 180, {3, -8, 0}).vertices);
        EXPECT_NEAR(e.longest, 4 / std::sqrt(3.0), 1e-12);  // 2 (4^2/12)^{1/2}
        EXPECT_NEAR(e.shortest, 1 / std::sqrt(3.0), 1e-12);
        EXPECT_NEAR(e.deformation_index(), 0.6, 1e-12);
    }
    EXPECT_THROW(shadow_ellipse({{0, 0, 0}, {1, 1, 5}, {2, 2, 1}}), InputError);
}

TEST(ShadowEllipse, OfANearlyRoundShadowDoesNotDependOnItsAngle) {
    const auto ellipsoid = meshing::spheroid(meshing::icosphere(3, 1.0), 1.05, 0.95, 0.4);
    for (double angle = 0; angle < pi; angle += 0.1) {
        const auto e = shadow_ellipse(turned(ellipsoid, angle).vertices);
        EXPECT_NEAR(e.deformation_index(), 0.05, 1e-3) << angle;
    }
}

TEST(MinimumRectangle, OfAnEllipsoidHasItsAxes) {
    const auto ellipsoid = meshing::spheroid(meshing::icosphere(4, 1.0), 3, 2, 1);
    const auto r = minimum_rectangle(turned(ellipsoid, 0.4).vertices);
    EXPECT_NEAR(r.length, 6, 0.02);
    EXPECT_NEAR(r.width, 4, 0.02);
    EXPECT_NEAR(r.angle_deg, 0.4 * 180 / pi, 1.5);
}

TEST(ThicknessProfile, OfTheEvansFungDiscFollowsItsFormula) {
    const auto disc = meshing::evans_fung(meshing::icosphere(5, 1.0));
    const auto profile = thickness_profile(disc.triangles, disc.vertices, 21, 12);
    const DiscMeasures d = disc_measures(disc.triangles, disc.vertices);
    EXPECT_NEAR(profile.front().mean, d.centre_thickness, 1e-12);
    EXPECT_NEAR(2 * profile.back().radius, d.diameter, 0.02);
    const double diameter = 7.82;  // (6.44)
    for (std::size_t i = 0; i + 3 < profile.size(); ++i) {
        const double q = std::pow(profile[i].radius / diameter, 2);
        const double expected = 2 * diameter * std::sqrt(1 - 4 * q) * (0.0518 + 2.0026 * q - 4.491 * q * q);
        EXPECT_NEAR(profile[i].mean, expected, 0.02) << profile[i].radius;
        EXPECT_LE(profile[i].least, profile[i].mean + 1e-12);
        EXPECT_GE(profile[i].greatest, profile[i].mean - 1e-12);
    }
    EXPECT_THROW(thickness_profile(disc.triangles, disc.vertices, 1), InputError);
}

}  // namespace
}  // namespace hemoflux::membrane

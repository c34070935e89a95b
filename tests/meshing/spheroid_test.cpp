#include "meshing/spheroid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "exchange/error.hpp"
#include "meshing/icosphere.hpp"

namespace hemoflux::meshing {
namespace {

constexpr double pi = std::numbers::pi;

// Area of the surface of revolution by Simpson's rule in the polar angle: an independent quadrature.
double area_by_quadrature(double a, double c) {
    const int n = 20000;
    double sum = 0;
    for (int i = 0; i <= n; ++i) {
        const double t = pi * i / n, weight = i == 0 || i == n ? 1 : (i % 2 ? 4 : 2);
        sum += weight * 2 * pi * a * std::sin(t) * std::hypot(a * std::cos(t), c * std::sin(t));
    }
    return sum * pi / n / 3;
}

TEST(Spheroid, ClosedFormsAgreeWithQuadrature) {
    for (const auto& [a, c] :
         {std::pair{1.0, 1.0}, {3.0, 1.0}, {1.0, 3.0}, {2.0, 1.999999}, {2.0, 2.000001}, {5.0, 0.1}})
        EXPECT_NEAR(area(SpheroidAxes{a, c}) / area_by_quadrature(a, c), 1, 1e-11) << a << " " << c;
    EXPECT_NEAR(volume(SpheroidAxes{2, 3}), 16 * pi, 1e-13);
    EXPECT_NEAR(reduced_volume(SpheroidAxes{2, 2}), 1, 1e-14);
}

// Semi-axes 1.13360 R0 (1, 1, 0.65214), as quoted for the reference of a red blood cell, have the area of the
// sphere of radius R0 and 0.950002 of its volume; 0.95 exactly moves their last digit by one.
TEST(Spheroid, OblateAxesOfTheReferenceSpheroid) {
    EXPECT_NEAR(reduced_volume(SpheroidAxes{1.13360, 1.13360 * 0.65214}), 0.950002, 5e-7);
    const SpheroidAxes axes = oblate_axes(4 * pi, 0.95);
    EXPECT_NEAR(axes.equatorial, 1.133606, 5e-7);
    EXPECT_NEAR(axes.polar / axes.equatorial, 0.652135, 5e-7);
}

TEST(Spheroid, OblateAxesKeepAreaAndReducedVolume) {
    for (const double v : {0.05, 0.3, 0.644, 0.95, 0.995, 1.0}) {
        const SpheroidAxes axes = oblate_axes(134, v);
        EXPECT_NEAR(area(axes), 134, 1e-10);
        EXPECT_NEAR(reduced_volume(axes), v, 1e-12);
        EXPECT_LE(axes.polar, axes.equatorial);
    }
}

TEST(Spheroid, MeshConvergesToTheClosedForms) {
    for (const SpheroidAxes axes : {SpheroidAxes{3.7, 2.4}, SpheroidAxes{1.5, 4}}) {
        double area_before = 0, volume_before = 0;
        for (int level = 3; level <= 5; ++level) {
            const SurfaceMesh mesh = spheroid(icosphere(level, 1), axes);
            const double area_error = 1 - area(mesh) / area(axes),
                         volume_error = 1 - volume(mesh) / volume(axes);
            if (level > 3) {
                EXPECT_NEAR(std::log2(area_before / area_error), 2, 0.05);
                EXPECT_NEAR(std::log2(volume_before / volume_error), 2, 0.05);
            }
            area_before = area_error, volume_before = volume_error;
        }
        EXPECT_LT(area_before, 1e-3);
        EXPECT_LT(volume_before, 1e-3);
    }
}

TEST(Spheroid, EllipsoidVerticesLieOnTheSurface) {
    const SurfaceMesh mesh = spheroid(icosphere(2, 7), 1, 2, 3);
    for (const Vec3d& p : mesh.vertices) EXPECT_NEAR(p.x * p.x + p.y * p.y / 4 + p.z * p.z / 9, 1, 1e-14);
}

TEST(Spheroid, BadInputIsRefused) {
    EXPECT_THROW(oblate_axes(0, 0.95), InputError);
    EXPECT_THROW(oblate_axes(134, 1.01), InputError);
    EXPECT_THROW(oblate_axes(134, 0.01), InputError);
    EXPECT_THROW(oblate_axes(134, std::nan("")), InputError);
    EXPECT_THROW(spheroid(icosphere(1, 1), 1, 0, 1), InputError);
}

}  // namespace
}  // namespace hemoflux::meshing

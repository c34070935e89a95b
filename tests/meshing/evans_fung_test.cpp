#include "meshing/evans_fung.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "exchange/error.hpp"
#include "meshing/icosphere.hpp"

namespace hemoflux::meshing {
namespace {

// Area and volume of (6.44) with these coefficients by Simpson's rule (20000 points).
constexpr double exact_area = 134.0932, exact_volume = 94.0984;

TEST(EvansFung, AreaAndVolumeConvergeAtSecondOrder) {
    double area_before = 0, volume_before = 0;
    for (int level = 3; level <= icosphere_max_level; ++level) {
        const SurfaceMesh disc = evans_fung(icosphere(level, 1));
        const double area_error = 1 - area(disc) / exact_area, volume_error = 1 - volume(disc) / exact_volume;
        if (level > 3)
            std::printf("level %d  area %.4f order %.3f  volume %.4f order %.3f\n", level, area(disc),
                        std::log2(area_before / area_error), volume(disc),
                        std::log2(volume_before / volume_error));
        if (level > 3 && level < 6) {  // the last error is close to the digits of the reference
            EXPECT_NEAR(std::log2(area_before / area_error), 2, 0.15);
            EXPECT_NEAR(std::log2(volume_before / volume_error), 2, 0.15);
        }
        area_before = area_error, volume_before = volume_error;
    }
    const SurfaceMesh disc = evans_fung(icosphere(6, 1));
    EXPECT_NEAR(area(disc), 134.1, 0.05);
    EXPECT_NEAR(volume(disc), 94.1, 0.05);
    EXPECT_NEAR(reduced_volume(disc), 0.644463, 2e-4);
}

TEST(EvansFung, Thickness) {
    EXPECT_NEAR(evans_fung_thickness(0), 0.8102, 1e-4);
    double greatest = 0, at = 0;
    for (double rho = 0; rho < 3.91; rho += 1e-4)
        if (evans_fung_thickness(rho) > greatest) greatest = evans_fung_thickness(rho), at = rho;
    EXPECT_NEAR(greatest, 2.5658, 1e-4);
    EXPECT_NEAR(at, 2.7375, 1e-3);
    EXPECT_EQ(evans_fung_thickness(4), 0);
    EXPECT_NEAR(evans_fung_thickness(0, 2 * 7.82), 2 * 0.8102, 2e-4);
}

TEST(EvansFung, VerticesLieOnTheSurface) {
    const SurfaceMesh sphere = icosphere(4, 2.5), disc = evans_fung(sphere);
    EXPECT_EQ(disc.triangles, sphere.triangles);
    double reach = 0;
    for (std::size_t v = 0; v < disc.vertices.size(); ++v) {
        const Vec3d p = disc.vertices[v];
        const double rho = std::hypot(p.x, p.y);
        EXPECT_NEAR(2 * std::abs(p.z), evans_fung_thickness(rho), 1e-7);  // the rim is steep in rho
        EXPECT_GE(p.z * sphere.vertices[v].z, 0);
        reach = std::max(reach, rho);
    }
    EXPECT_NEAR(reach, 3.91, 1e-12);
    EXPECT_NEAR(norm(centroid(disc)), 0, 1e-13);
}

TEST(EvansFung, BadDiameterIsRefused) {
    EXPECT_THROW(evans_fung(icosphere(1, 1), 0), InputError);
    EXPECT_THROW(evans_fung(icosphere(1, 1), -7.82), InputError);
}

}  // namespace
}  // namespace hemoflux::meshing

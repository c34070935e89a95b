#include "meshing/icosphere.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>

#include "exchange/error.hpp"

namespace hemoflux::meshing {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Icosphere, CountsAndValencesAtEveryLevel) {
    const int nodes[] = {12, 42, 162, 642, 2562, 10242, 40962};
    for (int level = 0; level <= icosphere_max_level; ++level) {
        const SurfaceMesh mesh = icosphere(level, 1);
        const int n = nodes[level];
        EXPECT_EQ(static_cast<int>(mesh.vertices.size()), n);
        EXPECT_EQ(static_cast<int>(mesh.triangles.size()), 2 * n - 4);
        const SurfaceQuality q = quality(mesh);
        EXPECT_EQ(q.edges, static_cast<std::size_t>(3 * n - 6));
        EXPECT_EQ(q.euler_characteristic, 2);
        const std::map<int, int> expected =
            n == 12 ? std::map<int, int>{{5, 12}} : std::map<int, int>{{5, 12}, {6, n - 12}};
        EXPECT_EQ(q.valences, expected);
        if (level > 0) {
            EXPECT_EQ(icosphere_level(n), level);
        }
    }
}

TEST(Icosphere, VerticesLieOnTheSphereAndTrianglesFaceOutward) {
    const SurfaceMesh mesh = icosphere(4, 3.27);
    for (const Vec3d& p : mesh.vertices) EXPECT_NEAR(norm(p), 3.27, 1e-14);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        EXPECT_GT(dot(area_vector(mesh, t), mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][0])]),
                  0);
    const Vec3d c = centroid(mesh);
    // a sum over 5120 triangles of terms as large as the radius, each rounded: about 70 times 3.27 eps
    EXPECT_NEAR(norm(c), 0, 5e-14);
}

// The icosahedron of circumradius 1 has edge 1 / sin(2 pi / 5).
TEST(Icosphere, LevelZeroIsTheIcosahedron) {
    const SurfaceMesh mesh = icosphere(0, 1);
    const double edge = 1 / std::sin(0.4 * pi);
    EXPECT_NEAR(area(mesh), 5 * std::sqrt(3.0) * edge * edge, 1e-14);
    EXPECT_NEAR(volume(mesh), 5.0 / 12 * (3 + std::sqrt(5.0)) * edge * edge * edge, 1e-14);
}

TEST(Icosphere, AreaAndVolumeConvergeAtSecondOrder) {
    double area_before = 0, volume_before = 0;
    for (int level = 2; level <= icosphere_max_level; ++level) {
        const SurfaceMesh mesh = icosphere(level, 2);
        const double area_error = 1 - area(mesh) / (16 * pi), volume_error = 1 - volume(mesh) / (32 * pi / 3);
        EXPECT_GT(area_error, 0);
        if (level > 2) {
            const double area_order = std::log2(area_before / area_error);
            const double volume_order = std::log2(volume_before / volume_error);
            std::printf("level %d  area error %.3e order %.4f  volume error %.3e order %.4f\n", level,
                        area_error, area_order, volume_error, volume_order);
            EXPECT_NEAR(area_order, 2, 0.03);
            EXPECT_NEAR(volume_order, 2, 0.03);
        }
        area_before = area_error, volume_before = volume_error;
    }
}

// Dividing flat faces and projecting once leaves triangles of different size: a midpoint of the flat
// triangle's edge a quarter along it lies at the direction 3/4 p + 1/4 q, which projection at every level
// would move.
TEST(Icosphere, IsProjectedOnce) {
    const SurfaceMesh mesh = icosphere(2, 1);
    const Edge edge = edges(icosphere(0, 1)).front();
    const Vec3d p = mesh.vertices[static_cast<std::size_t>(edge[0])],
                q = mesh.vertices[static_cast<std::size_t>(edge[1])];
    const Vec3d flat = 0.75 * p + 0.25 * q;
    const Vec3d expected = (1 / norm(flat)) * flat;
    double nearest = 1;
    for (const Vec3d& v : mesh.vertices) nearest = std::min(nearest, norm(v - expected));
    EXPECT_LT(nearest, 1e-14);
}

TEST(Icosphere, VerticesKeepTheirNumbers) {
    const SurfaceMesh coarse = icosphere(2, 1), fine = icosphere(3, 1);
    for (std::size_t v = 0; v < coarse.vertices.size(); ++v)
        EXPECT_LT(norm(coarse.vertices[v] - fine.vertices[v]), 1e-15);
    EXPECT_EQ(icosphere(3, 1).triangles, fine.triangles);
}

TEST(Icosphere, BadInputIsRefused) {
    EXPECT_THROW(icosphere(-1, 1), InputError);
    EXPECT_THROW(icosphere(7, 1), InputError);
    EXPECT_THROW(icosphere(2, 0), InputError);
    EXPECT_THROW(icosphere(2, std::nan("")), InputError);
    for (const int nodes : {12, 2561, 0, 163842}) {
        try {
            icosphere_level(nodes);
            ADD_FAILURE() << nodes;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("42, 162, 642, 2562, 10242 or 40962"),
                      std::string::npos);
        }
    }
    SurfaceMesh mesh = icosphere(0, 1);
    mesh.vertices[3] = {0, 0, 0};
    EXPECT_THROW(directions(mesh), InputError);
}

}  // namespace
}  // namespace hemoflux::meshing

#include "meshing/surface_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace hemoflux::meshing {
namespace {

// A tetrahedron at three corners of a box of edges 1, 2, 3, far from the origin.
SurfaceMesh tetrahedron(double shift) {
    SurfaceMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}},
                     {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    translate(mesh, {shift, shift, shift});
    return mesh;
}

TEST(SurfaceMesh, AreaVolumeAndCentroidOfATetrahedron) {
    const SurfaceMesh mesh = tetrahedron(0);
    EXPECT_NEAR(volume(mesh), 1, 1e-15);
    EXPECT_NEAR(area(mesh), 0.5 * (2 + 3 + 6 + 7), 1e-14);  // the slanted face has |(6, 3, 2)| / 2
    EXPECT_NEAR(centroid(mesh).x, 0.25, 1e-15);
    EXPECT_NEAR(centroid(mesh).y, 0.5, 1e-15);
    EXPECT_NEAR(centroid(mesh).z, 0.75, 1e-15);
    EXPECT_NEAR(reduced_volume(mesh), 6 * std::sqrt(std::numbers::pi) / 27, 1e-15);
    EXPECT_NEAR(area_vector(mesh, 3).x, 3, 1e-15);
    EXPECT_NEAR(area_vector(mesh, 3).y, 1.5, 1e-15);
    EXPECT_NEAR(area_vector(mesh, 3).z, 1, 1e-15);
}

TEST(SurfaceMesh, PlaceDoesNotMatter) {
    const double shift = 4096;
    const SurfaceMesh mesh = tetrahedron(shift);
    EXPECT_NEAR(volume(mesh), 1, 1e-14);
    EXPECT_NEAR(centroid(mesh).x - shift, 0.25, 1e-12);
    EXPECT_NEAR(centroid(mesh).z - shift, 0.75, 1e-12);
}

TEST(SurfaceMesh, InwardTrianglesHaveANegativeVolume) {
    SurfaceMesh mesh = tetrahedron(0);
    for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
    EXPECT_NEAR(volume(mesh), -1, 1e-15);
}

TEST(SurfaceMesh, EdgesAndQuality) {
    const SurfaceMesh mesh = tetrahedron(0);
    const std::vector<Edge> expected{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
    EXPECT_EQ(edges(mesh), expected);
    const SurfaceQuality q = quality(mesh);
    EXPECT_EQ(q.edges, 6U);
    EXPECT_EQ(q.euler_characteristic, 2);
    EXPECT_NEAR(q.shortest_edge, 1, 1e-15);
    EXPECT_NEAR(q.longest_edge, std::sqrt(13.0), 1e-15);
    EXPECT_NEAR(q.mean_edge, (6 + std::sqrt(5.0) + std::sqrt(10.0) + std::sqrt(13.0)) / 6, 1e-15);
    EXPECT_NEAR(q.smallest_angle, std::atan(1.0 / 3) * 180 / std::numbers::pi, 1e-12);
    EXPECT_EQ(q.valences, (std::map<int, int>{{3, 4}}));
}

}  // namespace
}  // namespace hemoflux::meshing
